"""The right-hand side: M q̈ = f solved by Cholesky for what a compiled model says of M and f."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .compiler import kernel
from .pointer import call

Floats = NDArray[np.float64]

# How a computation ended; `outcome.py` gives each its name.
FINE, STEP_LIMIT, SINGULAR, NOT_FINITE, TOO_LARGE, STEP_UNDERFLOW, CANCELLED = 0, 1, 2, 3, 4, 5, 6

# A pivot smaller than this part of the largest mass is rounding error: M has no inverse there.
SMALLEST_PIVOT = 1e-14


class Motion(NamedTuple):
    """A compiled model with room for its numbers.

    `inputs` holds q, q̇, t and the parameters; `outputs` receives the lower triangle of M by rows, f and the power.
    `conditioning[0]` keeps the smallest ratio of a pivot to the largest diagonal entry of M that was met.
    """

    address: int
    data: int
    degrees: int
    is_powered: bool
    inputs: Floats
    outputs: Floats
    conditioning: Floats


@kernel
def factor(m: Floats, n: int) -> float:
    """Cholesky factor of the packed lower triangle m in place; returns smallest pivot / largest diagonal entry.

    The result is at most SMALLEST_PIVOT if M is singular or indefinite, and NaN if it is not finite.
    """
    largest = 0.0
    for i in range(n):
        largest = max(largest, m[i * (i + 1) // 2 + i])
    smallest = largest
    for i in range(n):
        row = i * (i + 1) // 2
        for j in range(i):
            column = j * (j + 1) // 2
            for k in range(j):
                m[row + j] -= m[row + k] * m[column + k]
            m[row + j] /= m[column + j]
        pivot = m[row + i]
        for k in range(i):
            pivot -= m[row + k] * m[row + k]
        if not pivot > SMALLEST_PIVOT * largest:
            return pivot if np.isnan(pivot) else 0.0
        smallest = min(smallest, pivot)
        m[row + i] = np.sqrt(pivot)
    return smallest / largest


@kernel
def solve(m: Floats, n: int) -> None:
    """Solves L Lᵀ x = f in place for the packed factor L at the start of m and f right behind it."""
    x = n * (n + 1) // 2
    for i in range(n):
        for k in range(i):
            m[x + i] -= m[i * (i + 1) // 2 + k] * m[x + k]
        m[x + i] /= m[i * (i + 1) // 2 + i]
    for i in range(n - 1, -1, -1):
        for k in range(i + 1, n):
            m[x + i] -= m[k * (k + 1) // 2 + i] * m[x + k]
        m[x + i] /= m[i * (i + 1) // 2 + i]


@kernel
def slope(motion: Motion, t: float, state: Floats, out: Floats) -> int:
    """d/dt of the state (q, q̇, ∫P dt) into `out`; returns FINE, SINGULAR or NOT_FINITE."""
    n = motion.degrees
    for i in range(2 * n):
        motion.inputs[i] = state[i]
    motion.inputs[2 * n] = t
    call(motion.address, motion.data, motion.outputs, motion.inputs)
    first = n * (n + 1) // 2
    ratio = factor(motion.outputs, n)
    if not ratio > SMALLEST_PIVOT:
        return NOT_FINITE if np.isnan(ratio) else SINGULAR
    motion.conditioning[0] = min(motion.conditioning[0], ratio)
    solve(motion.outputs, n)
    for i in range(n):
        out[i] = state[n + i]
        out[n + i] = motion.outputs[first + i]
    if motion.is_powered:
        power = motion.outputs[first + n]
        for i in range(n):
            power += motion.outputs[first + n + 1 + i] * motion.outputs[first + i]
        out[2 * n] = power
    return FINE
