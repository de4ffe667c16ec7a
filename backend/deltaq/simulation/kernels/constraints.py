"""Motions with constraints: M q̈ = f + Aᵀλ and A q̈ = γ solved for q̈ and λ.

To the stepping loops a model with constraints is one like any other, with M = 1 and f = q̈: what they call is a function
made here around the compiled model. So λ is a function of the state (index 1), and every method can be used.
Source: Hairer, Wanner, Solving Ordinary Differential Equations II, 2nd ed., VII.1.
"""

from __future__ import annotations

import numpy as np

from .compiler import callback, inline, subroutine
from .motion import FINE, LOCKED, NOT_FINITE, SINGULAR, SMALLEST_PIVOT, Floats, factor, solve
from .pointer import call, doubles_at, prevent_vectorization
from .ranked import factor_ranked, solve_ranked
from .system import (
    COUNT,
    DEGREES,
    LOCKS,
    MOTION,
    MOTION_DATA,
    PHASE,
    PHASE_DATA,
    POWERED,
    RANK,
    SIGNS,
    System,
    block_at,
    place_of_rows,
    take_inputs,
)


@inline
def add_rows(system: System) -> float:
    """M + c AᵀA and f + c Aᵀγ in place of M and f, c such that both parts count alike; returns c.

    With A q̈ = γ the motion and λ are the same, and coordinates without mass have accelerations where constraints hold
    them.
    Source: Bertsekas, Constrained Optimization and Lagrange Multiplier Methods, ch. 2.
    """
    n, m, outputs, rows = system.head[DEGREES], system.head[COUNT], system.outputs, place_of_rows(system)
    trace, square = 0.0, 0.0
    for i in range(n):
        trace += outputs[i * (i + 1) // 2 + i]
    for k in range(m * n):
        square += outputs[rows + k] ** 2
    weight = trace / square if square > 0.0 else 0.0
    for k in range(m):
        for i in range(n):
            part = weight * outputs[rows + k * n + i]
            for j in range(i + 1):
                outputs[i * (i + 1) // 2 + j] += part * outputs[rows + k * n + j]
            outputs[n * (n + 1) // 2 + i] += part * outputs[rows + m * n + k]
    return weight


@inline
def factor_mass(system: System) -> float:
    """The factors of M in place, or, where it has no inverse, of what stands for it; the smallest ratio as there."""
    n, outputs = system.head[DEGREES], system.outputs
    call(system.head[MOTION], system.head[MOTION_DATA], outputs, system.inputs)
    ratio = factor(outputs, n)
    if not ratio > SMALLEST_PIVOT and not np.isnan(ratio):
        call(system.head[MOTION], system.head[MOTION_DATA], outputs, system.inputs)
        add_rows(system)
        ratio = factor(outputs, n)
    return float(ratio)


@inline
def scale(own: float) -> float:
    """What brings an entry of a diagonal to 1; 0 where it is 0, or has lost its sign."""
    return 1.0 / np.sqrt(own) if own > 0.0 else (0.0 if own <= 0.0 else np.nan)


@inline
def respond(system: System) -> int:
    """M factored, q̈ = M⁻¹f without reactions into `accelerations`, AM⁻¹ and the scaled AM⁻¹Aᵀ; returns the outcome."""
    n, m, outputs = system.head[DEGREES], system.head[COUNT], system.outputs
    ratio, force, rows = factor_mass(system), n * (n + 1) // 2, place_of_rows(system)
    if not ratio > SMALLEST_PIVOT:
        return NOT_FINITE if np.isnan(ratio) else SINGULAR
    system.conditioning[0] = min(system.conditioning[0], ratio)
    solve(outputs, n)
    for i in range(n):
        system.accelerations[i] = outputs[force + i]
    for k in range(m):
        for i in range(n):
            outputs[force + i] = outputs[rows + k * n + i]
        solve(outputs, n)
        for i in range(n):
            system.responses[k * n + i] = outputs[force + i]
        square = 0.0
        for i in range(n):
            square += outputs[rows + k * n + i] * system.responses[k * n + i]
        system.scales[k] = scale(square)
    return FINE


@inline
def schur_complement(system: System, count: int, matrix: Floats) -> None:
    """AM⁻¹Aᵀ of the first `count` constraints, scaled, into `matrix`, shape (≥ count²,), by rows."""
    n, rows = system.head[DEGREES], place_of_rows(system)
    for k in range(count):
        for j in range(k + 1):
            total = 0.0
            for i in range(n):
                total += system.outputs[rows + k * n + i] * system.responses[j * n + i]
            matrix[k * count + j] = matrix[j * count + k] = total * system.scales[k] * system.scales[j]


@inline
def solve_accelerations(system: System) -> int:
    """q̈ and λ at the state that stands in `inputs`, into `accelerations` and `multipliers`; returns the outcome.

    LOCKED if the constraints are not as many independent ones as at the start.
    """
    n, m, rows = system.head[DEGREES], system.head[COUNT], place_of_rows(system)
    outcome = respond(system)
    if outcome != FINE:
        return outcome
    schur_complement(system, m, system.schur)
    rank, smallest = factor_ranked(system.schur, system.order, m)
    if rank != system.head[RANK]:
        return NOT_FINITE if rank < 0 else LOCKED
    system.conditioning[0] = min(system.conditioning[0], smallest)
    for k in range(m):
        total = system.outputs[rows + m * n + k]
        for i in range(n):
            total -= system.outputs[rows + k * n + i] * system.accelerations[i]
        system.multipliers[k] = total
    solve_ranked(system.schur, system.order, m, rank, system.scales, system.multipliers)
    for k in range(m):
        for i in range(n):
            system.accelerations[i] += system.multipliers[k] * system.responses[k * n + i]
    return FINE


@subroutine
def accelerate(system: System) -> int:
    """`solve_accelerations` as a call, for all that is not on the way of every right-hand side."""
    prevent_vectorization()
    return solve_accelerations(system)


@inline
def power_of(system: System) -> float:
    """P = P₀ + p₁·q̈ − λ·b"""
    n, m = system.head[DEGREES], system.head[COUNT]
    place, drives = n * (n + 1) // 2 + n, place_of_rows(system) + m * n + m
    power = system.outputs[place]
    for i in range(n):
        power += system.outputs[place + 1 + i] * system.accelerations[i]
    for k in range(m):
        power -= system.multipliers[k] * system.outputs[drives + k]
    return float(power)


@inline
def as_free(system: System, out: Floats) -> None:
    """What a model without constraints would say that moves alike: M = 1, f = q̈, P; where q̈ has no value, M says so.

    `out` has shape (n (n + 1)/2 + n,) or, where power is fed in, n + 1 more.
    """
    n, outcome = system.head[DEGREES], solve_accelerations(system)
    good = 1.0 if outcome == FINE else (np.nan if outcome == NOT_FINITE else 0.0)
    system.head[LOCKS] = 1 if outcome == LOCKED else 0
    for i in range(n):
        row = i * (i + 1) // 2
        for j in range(i):
            out[row + j] = 0.0
        out[row + i] = good
        out[n * (n + 1) // 2 + i] = system.accelerations[i]
    if system.head[POWERED]:
        place = n * (n + 1) // 2 + n
        out[place] = power_of(system)
        for i in range(n):
            out[place + 1 + i] = 0.0


@subroutine
def phase_as_free(system: System, out: Floats) -> None:
    """M, p and ṗ = ∂E/∂q + Q + Aᵀλ; `out` has shape (n (n + 1)/2 + 2n,)."""
    n, m, rows = system.head[DEGREES], system.head[COUNT], place_of_rows(system)
    call(system.head[PHASE], system.head[PHASE_DATA], system.phase, system.inputs)
    outcome = accelerate(system)
    system.head[LOCKS] = 1 if outcome == LOCKED else 0
    first = n * (n + 1) // 2 + n
    for i in range(first + n):
        out[i] = system.phase[i]
    for i in range(n):
        for k in range(m):
            out[first + i] += system.multipliers[k] * system.outputs[rows + k * n + i]
        if outcome != FINE:
            out[first + i] = np.nan


@callback("void(int64, int64, int64)")
def constrained_motion(out: int, given: int, data: int) -> None:
    """`as_free` as a compiled model: its address stands for that of a model without constraints.

    There is room for A, γ and b behind what is written; the signs of a solution stand there.
    """
    prevent_vectorization()
    system = block_at(data)
    signs = place_of_rows(system)
    outputs = doubles_at(out, signs + SIGNS)
    take_inputs(system, given)
    as_free(system, outputs)
    for k in range(SIGNS):
        outputs[signs + k] = 1.0


@callback("void(int64, int64, int64)")
def constrained_phase(out: int, given: int, data: int) -> None:
    """`phase_as_free` as a compiled function of phase space."""
    system = block_at(data)
    n = system.head[DEGREES]
    take_inputs(system, given)
    phase_as_free(system, doubles_at(out, n * (n + 1) // 2 + 2 * n))
