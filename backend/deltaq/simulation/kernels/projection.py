"""States brought back onto the constraints, g = 0 and w = 0, at the end of every step and at samples.

The integrated equations keep g̈ = 0 only, so that rounding and errors of the method would add up in g.
Source: Hairer, Wanner, Solving Ordinary Differential Equations II, 2nd ed., VII.2.
"""

from __future__ import annotations

import numpy as np

from .compiler import inline, kernel, subroutine
from .constraints import accelerate, power_of, schur_complement
from .motion import FINE, LOCKED, NEWTON_FAILED, NOT_FINITE, Floats
from .pointer import call, prevent_vectorization
from .ranked import determinant, factor_ranked, solve_ranked
from .system import (
    COUNT,
    DEGREES,
    GAPS,
    GAPS_DATA,
    HOLONOMIC,
    IS_UNDER_WAY,
    POWERED,
    RANK,
    TURNS,
    System,
    block_at,
    place_of_rows,
)

CORRECTIONS, CLOSE = 12, 1e-9  # Newton's corrections of a state; behind one this small, relative to it, comes rounding
MOST_CORRECTIONS = 40  # of a state that is close, of which rounding takes up to half of each
SOON = 4  # Newton's corrections that come down to rounding, where they converge
GRAIN = 2.0**-52  # of the first correction: a coordinate that is zero on the constraints gets no nearer
STALLED = 0.5  # corrections that are no smaller than this part of the one before are rounding errors, if they are small
HALVINGS = 26  # of a step in which the constraints seem to turn round

Ends = tuple[Floats, Floats, Floats, Floats]  # states at both ends of a step, then their derivatives: shape (width,)


@inline
def read_gaps(system: System) -> None:
    """g and w at the state that stands in `inputs`."""
    call(system.head[GAPS], system.head[GAPS_DATA], system.gaps, system.inputs)


@inline
def correct(system: System, first: int, at: int, h: float) -> tuple[float, float]:
    """Takes the `right` multiples of the responses from q (at = 0) or q̇ (at = n); the largest part of them that is.

    Once relative to each or to how far it moves in h seconds, once relative to it or 1. `first` is one behind the last
    constraint that has a part in it.
    """
    n, relative, absolute = system.head[DEGREES], 0.0, 0.0
    for i in range(n):
        change = 0.0
        for k in range(first):
            change += system.right[k] * system.responses[k * n + i]
        system.inputs[at + i] -= change
        rate = system.inputs[n + i] if at == 0 else system.accelerations[i]
        size, change = abs(system.inputs[at + i]), abs(change)
        reach = max(size, abs(h * rate))
        if change != 0.0:
            part = change / reach if reach > 0.0 else np.inf
            relative = part if not part <= relative else relative
            part = change / max(1.0, size)
            absolute = part if not part <= absolute else absolute
    return relative, absolute


@subroutine
def project(system: System, h: float) -> int:
    """Moves q in `inputs` onto g = 0 and q̇ onto w = 0, in the metric of M; returns the outcome.

    `accelerate` comes before, and its factors serve all of Newton's corrections, which converge fast from near.
    """
    prevent_vectorization()
    n, m, holonomic = system.head[DEGREES], system.head[COUNT], system.head[HOLONOMIC]
    rank, gap_schur, gap_order = system.head[RANK], system.schur, system.order
    gap_rank = rank
    if 0 < holonomic < m:
        gap_schur, gap_order = system.gap_schur, system.gap_order
        schur_complement(system, holonomic, gap_schur)
        gap_rank, _ = factor_ranked(gap_schur, gap_order, holonomic)
    before, first, is_settled = np.inf, 0.0, False
    for tries in range(MOST_CORRECTIONS):
        read_gaps(system)
        relative, absolute = 0.0, 0.0
        if holonomic > 0:
            for k in range(holonomic):
                system.right[k] = system.gaps[k]
            solve_ranked(gap_schur, gap_order, holonomic, gap_rank, system.scales, system.right)
            relative, absolute = correct(system, holonomic, 0, h)
        for k in range(m):
            system.right[k] = system.gaps[holonomic + k]
        solve_ranked(system.schur, system.order, m, rank, system.scales, system.right)
        of_rates, at_least = correct(system, m, n, h)
        relative, absolute = max(relative, of_rates), max(absolute, at_least)
        if not absolute < np.inf:
            return NOT_FINITE
        first = max(first, absolute)
        if relative <= CLOSE or (absolute >= STALLED * before and absolute <= CLOSE) or absolute <= GRAIN * first:
            return FINE
        if tries + 1 >= CORRECTIONS and absolute > CLOSE:
            return NEWTON_FAILED
        # What converges so fast is on the constraints; halving what is left of rates that are but rounding takes longer
        # than there are tries. Next to a fork all corrections are halved, from the first on.
        is_settled = is_settled or (tries < SOON and absolute <= GRAIN)
        before = absolute
    return FINE if is_settled else NEWTON_FAILED


@inline
def turning(system: System, responses: Floats) -> float:
    """det(A₀ M⁻¹A₁ᵀ) over the independent constraints, A₀ from before the step, A₁ M⁻¹ the `responses`, shape (m n,).

    These are `system.responses` where `accelerate` saw the state. It changes its sign where the constraints lose their
    independence on the way from A₀ to A₁, or where that turns by more than a right angle.
    """
    n, rank, minor = system.head[DEGREES], system.head[RANK], system.minor
    for k in range(rank):
        for j in range(rank):
            total, a, b = 0.0, system.order[k], system.order[j]
            for i in range(n):
                total += system.before[a * n + i] * responses[b * n + i]
            minor[k * rank + j] = total
    return determinant(minor, rank)


@inline
def keep_rows(system: System) -> None:
    """A, as it stands in the outputs, becomes that `before` the next step."""
    size, rows = system.head[DEGREES] * system.head[COUNT], place_of_rows(system)
    for i in range(size):
        system.before[i] = system.outputs[rows + i]


@inline
def place_between(system: System, x: float, t: float, h: float, ends: Ends) -> None:
    """The state at t + xh of the cubic through q and q̇ at both ends, into `inputs`."""
    old, new, _, _ = ends
    n = system.head[DEGREES]
    for d in range(n):
        q0, q1, v0, v1 = old[d], new[d], h * old[n + d], h * new[n + d]
        c2, c3 = 3.0 * (q1 - q0) - 2.0 * v0 - v1, v0 + v1 - 2.0 * (q1 - q0)
        system.inputs[d] = q0 + x * (v0 + x * (c2 + x * c3))
        system.inputs[n + d] = (v0 + x * (2.0 * c2 + 3.0 * x * c3)) / h
    system.inputs[2 * n] = t + x * h


@inline
def settle(system: System, h: float) -> int:
    """Projects the state that stands in `inputs`, and computes q̈ and λ there; returns the outcome."""
    outcome = accelerate(system)
    if outcome == FINE:
        outcome = project(system, h)
    return accelerate(system) if outcome == FINE else outcome


@inline
def see_between(system: System, x: float, t: float, h: float, ends: Ends) -> int:
    """`accelerate` at the state t + xh of the cubic, on the constraints where it can be moved there; the outcome.

    Close to a fork the rows of A are so small that those of a state off the constraints point anywhere.
    """
    place_between(system, x, t, h, ends)
    outcome = settle(system, h)
    if outcome in (FINE, LOCKED):
        return outcome
    place_between(system, x, t, h, ends)
    return accelerate(system)


@subroutine
def is_locked_between(system: System, t: float, h: float, ends: Ends) -> bool:
    """Whether the constraints lose their independence within a step, at whose ends they look turned round.

    Halving the step tells: where they have only turned far, both halves show them turned less.
    """
    low, high = 0.0, 1.0
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if see_between(system, middle, t, h, ends) != FINE:
            return True
        first = turning(system, system.responses)
        if first <= 0.0:
            high = middle
            continue
        keep_rows(system)
        if see_between(system, high, t, h, ends) != FINE:
            return True
        if turning(system, system.responses) > 0.0:
            return False
        low = middle
    return True


@inline
def take_state(system: System, t: float, state: Floats) -> None:
    """The state at t, shape (≥ 2n,), becomes that which `accelerate` sees."""
    n = system.head[DEGREES]
    for d in range(2 * n):
        system.inputs[d] = state[d]
    system.inputs[2 * n] = t


@inline
def begin_way(system: System, t: float, state: Floats) -> int:
    """A at the start of a run, shape (≥ 2n,) its state; returns the outcome."""
    if system.head[IS_UNDER_WAY] != 0:
        return FINE
    take_state(system, t, state)
    outcome = accelerate(system)
    keep_rows(system)
    system.head[IS_UNDER_WAY] = 1
    return outcome


@subroutine
def finish_step(system: System, t: float, h: float, ends: Ends) -> int:
    """The new state of a step projected, and its derivative; returns the outcome.

    LOCKED if the constraints lost their independence on the way.
    """
    prevent_vectorization()
    old, new, _, new_derivative = ends
    n, outcome = system.head[DEGREES], begin_way(system, t, old)
    if outcome == FINE:
        take_state(system, t + h, new)
        outcome = settle(system, h)
    if outcome != FINE:
        return outcome
    for d in range(2 * n):
        new[d] = system.inputs[d]
    for d in range(n):
        new_derivative[d], new_derivative[n + d] = new[n + d], system.accelerations[d]
    if system.head[POWERED]:
        new_derivative[2 * n] = power_of(system)
    if not turning(system, system.responses) > 0.0:
        system.head[TURNS] += 1
        if is_locked_between(system, t, h, ends):
            return LOCKED
        take_state(system, t + h, new)
        accelerate(system)
    keep_rows(system)
    return FINE


@kernel
def settle_samples(block: int, times: Floats, states: Floats, multipliers: Floats, gaps: Floats) -> int:
    """Projects all states, and tells λ and how far g is from 0 there; returns how many are good.

    `times` has shape (samples,), `states`, shape (samples, ≥ 2n), `multipliers`, shape (samples, m), and `gaps`, shape
    (samples,), are written; `block` is the address of the memory.
    """
    system = block_at(block)
    n, m, holonomic = system.head[DEGREES], system.head[COUNT], system.head[HOLONOMIC]
    for row in range(times.size):
        take_state(system, times[row], states[row])
        if settle(system, 0.0) != FINE:
            return row
        for d in range(2 * n):
            states[row, d] = system.inputs[d]
        for k in range(m):
            multipliers[row, k] = system.multipliers[k]
        read_gaps(system)
        gaps[row] = 0.0
        for k in range(holonomic):
            gaps[row] = max(gaps[row], abs(system.gaps[k]))
    return times.size
