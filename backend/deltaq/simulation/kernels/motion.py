"""The right-hand side: M q̈ = f solved by Cholesky for what a compiled model says of M and f."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .compiler import inline
from .pointer import call, call_finish, prevent_vectorization

Floats = NDArray[np.float64]

# How a computation ended; `outcome.py` gives each its name.
FINE, STEP_LIMIT, SINGULAR, NOT_FINITE, TOO_LARGE, STEP_UNDERFLOW, CANCELLED = 0, 1, 2, 3, 4, 5, 6
NEWTON_FAILED, STIFF, EVENT, HELD, LOCKED = 7, 8, 9, 10, 11
MANY_EVENTS, UNSETTLED = 12, 13  # of runs that go on behind events

ROUNDING = 2.3e-16  # of a number in double precision, relative to it
# A pivot smaller than this part of what it is left of is rounding error: M has no inverse there.
SMALLEST_PIVOT = 1e-14
SMALLEST_SCHUR_PIVOT = 1e-11  # of a scaled pivot of AM⁻¹Aᵀ; a constraint that has less depends on the others


class Motion(NamedTuple):
    """A compiled model with the arrays that it reads and writes.

    `inputs` holds q, q̇, t and the parameters, shape (2n + 1 + parameters,). `outputs` receives the packed lower
    triangle of M, f and, where power is fed in, P₀ and p₁, shape (n (n + 1)/2 + n,) or n + 1 more. `conditioning`,
    shape (1,), keeps the smallest ratio of a pivot to the diagonal entry of M that it is left of. No change of units
    changes that ratio; its inverse is about the condition of M scaled to a unit diagonal.

    Of a model with constraints the function gives M = 1, f = q̈ and behind P and p₁ the signs of a solution in symbols
    (see `model.solved`). Where these say that it does not hold, `general` is the address of a function made around the
    model (see `constraints`), `finish` that of what projects the end of a step, else both are 0; `memory`, shape
    (size,), at the address `block`, keeps what these read and write.
    """

    address: int
    data: int
    degrees: int
    is_powered: bool
    inputs: Floats
    outputs: Floats
    conditioning: Floats
    general: int
    finish: int
    block: int
    memory: Floats


@inline
def has_signs(out: Floats, signs: int) -> bool:
    """Whether the signs of a solution in symbols, at that place of `out`, shape (≥ signs + 3,), say that it is one."""
    return bool(out[signs] > SMALLEST_PIVOT and out[signs + 1] > SMALLEST_SCHUR_PIVOT and out[signs + 2] > 0.0)


@inline
def holds(out: Floats, first: int, count: int, signs: int) -> bool:
    """Whether a solution in symbols is one: by its signs, and by whether `count` of its numbers are finite.

    `out` has shape (≥ signs + 3,).
    """
    if not has_signs(out, signs):
        return False
    total = 0.0
    for i in range(first, first + count):
        total += abs(out[i])
    return bool(total < np.inf)


@inline
def factor(m: Floats, n: int) -> float:
    """Cholesky factors L D Lᵀ of M in place, 1/D on the diagonal.

    `m`, shape (≥ n (n + 1)/2,), begins with the packed lower triangle. Without square roots, since those and divisions
    cost more than all the rest for a small matrix. Returns the smallest ratio of a pivot to its diagonal entry: at most
    SMALLEST_PIVOT if M is singular or indefinite, NaN if it is not finite. The rounding error of a pivot is a few units
    in the last place of that entry.
    Sources: Golub, Van Loan, Matrix Computations, 4th ed., §4.1; Higham, Accuracy and Stability of Numerical
    Algorithms, 2nd ed., §10.1.
    """
    smallest = 1.0
    for i in range(n):
        row = i * (i + 1) // 2
        pivot = diagonal = m[row + i]
        for j in range(i):
            column = j * (j + 1) // 2
            scaled = m[row + j]  # L times D, until its column is done
            for k in range(j):
                scaled -= m[row + k] * m[column + k]
            m[row + j] = scaled
        for j in range(i):
            scaled = m[row + j]
            m[row + j] = scaled * m[j * (j + 1) // 2 + j]
            pivot -= scaled * m[row + j]
        if not pivot > SMALLEST_PIVOT * diagonal:
            return pivot if np.isnan(pivot) else 0.0
        smallest = min(smallest, pivot / diagonal)
        m[row + i] = 1.0 / pivot
    return smallest


@inline
def solve(m: Floats, n: int) -> None:
    """Solves L D Lᵀ x = f in place; `m`, shape (n (n + 1)/2 + n,), holds the factors and then f, which becomes x."""
    x = n * (n + 1) // 2
    for i in range(n):
        for k in range(i):
            m[x + i] -= m[i * (i + 1) // 2 + k] * m[x + k]
    for i in range(n - 1, -1, -1):
        m[x + i] *= m[i * (i + 1) // 2 + i]
        for k in range(i + 1, n):
            m[x + i] -= m[k * (k + 1) // 2 + i] * m[x + k]


@inline
def solve_small(m: Floats, n: int, known: float, out: Floats) -> float:
    """`factor` and `solve` for one or two coordinates, with as few divisions as can be.

    `m`, shape (n (n + 1)/2 + n,), holds the triangle and f; q̈ goes behind q̇ into `out`, shape (≥ 2n,). `known` is the
    smallest ratio so far, and what is returned if this one is not smaller.
    """
    if n == 1:
        first = m[0]
        out[1] = m[1] / first
        return 1.0 if first > 0.0 else (first if np.isnan(first) else 0.0)
    a, b, c, f, g = m[0], m[1], m[2], m[3], m[4]
    determinant, largest = a * c - b * b, a * c
    inverse = 1.0 / determinant
    out[2], out[3] = (c * f - b * g) * inverse, (a * g - b * f) * inverse
    if determinant >= known * largest and determinant > 0.0 and a > 0.0:  # the second pivot is determinant / a
        return known
    ratio = determinant / largest
    if np.isnan(ratio) and not (a == 0.0 or c == 0.0):
        return float(ratio)
    return float(ratio) if a > 0.0 and c > 0.0 else 0.0


@inline
def solve_large(m: Floats, n: int, out: Floats) -> float:
    """The same for any number of coordinates, by `factor` and `solve`, for arrays as there.

    `m` has shape (n (n + 1)/2 + n,), `out` shape (≥ 2n,).
    """
    ratio = factor(m, n)
    if ratio > SMALLEST_PIVOT:
        solve(m, n)
        for i in range(n):
            out[n + i] = m[n * (n + 1) // 2 + i]
    return float(ratio)


@inline
def evaluate(motion: Motion) -> float:
    """M and f at what stands in the inputs; of a model with constraints the smallest ratio of a pivot, else 1."""
    call(motion.address, motion.data, motion.outputs, motion.inputs)
    if motion.finish == 0:
        return 1.0
    n, outputs = motion.degrees, motion.outputs
    force = n * (n + 1) // 2
    signs = force + n + (n + 1 if motion.is_powered else 0)
    if not holds(outputs, force, n, signs):
        call(motion.general, motion.block, outputs, motion.inputs)
        return float(outputs[0])
    return float(min(outputs[signs], outputs[signs + 1]))


@inline
def take_solved(m: Floats, n: int, out: Floats) -> None:
    """q̈ behind q̇ into `out`, shape (≥ 2n,), where M = 1 and f is q̈; `m` has shape (n (n + 1)/2 + n,)."""
    for i in range(n):
        out[n + i] = m[n * (n + 1) // 2 + i]


@inline
def rhs(motion: Motion, t: float, state: Floats, out: Floats) -> int:
    """The right-hand side: d/dt of (q, q̇, ∫P dt), with q̈ from M q̈ = f; returns FINE, SINGULAR or NOT_FINITE.

    `state` and `out`, which is written, have shape (width,).
    """
    prevent_vectorization()
    for i in range(2 * motion.degrees):
        motion.inputs[i] = state[i]
    return rhs_at_inputs(motion, t, out)


@inline
def rhs_at_inputs(motion: Motion, t: float, out: Floats) -> int:
    """`rhs` at the state that stands in the inputs already; `out` has shape (width,)."""
    prevent_vectorization()
    n, inputs, outputs = motion.degrees, motion.inputs, motion.outputs
    inputs[2 * n] = t
    ratio = evaluate(motion)
    if motion.finish != 0:
        take_solved(outputs, n, out)
    else:
        ratio = solve_small(outputs, n, motion.conditioning[0], out) if n <= 2 else solve_large(outputs, n, out)
    if not ratio > SMALLEST_PIVOT:
        return NOT_FINITE if np.isnan(ratio) else SINGULAR
    motion.conditioning[0] = min(motion.conditioning[0], ratio)
    for i in range(n):
        out[i] = inputs[n + i]
    if motion.is_powered:
        place = n * (n + 1) // 2 + n
        power = outputs[place]
        for i in range(n):
            power += outputs[place + 1 + i] * out[n + i]
        out[2 * n] = power
    return FINE


@inline
def finish_constrained(
    motion: Motion, t: float, h: float, old: Floats, new: Floats, old_derivative: Floats, new_derivative: Floats
) -> int:
    """Where there are constraints, projects the new state of a step onto them; its derivative is taken anew.

    The states at both ends of the step from t and their derivatives have shape (width,). Returns the outcome.
    """
    if motion.finish == 0:
        return FINE
    return int(call_finish(motion.finish, motion.block, t, h, old, new, old_derivative, new_derivative))
