"""The end of a step projected by what was solved for in symbols; by numbers where that does not hold.

Source: Hairer, Wanner, Solving Ordinary Differential Equations II, 2nd ed., VII.2.
"""

from __future__ import annotations

from .compiler import callback, inline
from .motion import FINE, Floats, holds
from .pointer import call, doubles_at, prevent_vectorization
from .projection import CLOSE, Ends, finish_step, keep_rows, take_state, turning
from .system import (
    CORRECTED,
    CORRECTED_DATA,
    COUNT,
    DEGREES,
    HOLONOMIC,
    IS_UNDER_WAY,
    POWERED,
    SOLVED,
    SOLVED_DATA,
    System,
    block_at,
    place_of_rows,
)

MOST_CORRECTIONS, SURE = 8, 2  # Newton's corrections; behind so many, one that is small in itself is the last


@inline
def correct_solved(system: System, multiples: int, count: int, at: int, h: float, rates: Floats) -> tuple[bool, bool]:
    """Takes multiples of the responses from q (at = 0) or q̇ (at = n): whether hardly anything changed.

    Once relative to each coordinate or to how far it moves in h seconds, once relative to it or 1. `multiples` is where
    the first of `count` stands in the corrections; `rates` are d/dt of (q, q̇) nearby, shape (≥ 2n,).
    """
    n, is_close, is_small = system.head[DEGREES], True, True
    responses = system.head[COUNT] * n
    for i in range(n):
        change = 0.0
        for k in range(count):
            change += system.corrections[multiples + k] * system.corrections[responses + k * n + i]
        system.inputs[at + i] -= change
        size, change = abs(system.inputs[at + i]), abs(change)
        if not change <= CLOSE * max(size, abs(h * rates[at + i])):
            is_close = False
            if not change <= CLOSE * max(1.0, size):
                is_small = False
    return is_close, is_small


@inline
def project_solved(system: System, h: float, rates: Floats) -> bool:
    """Moves the state in `inputs` onto g = 0 and w = 0, in the metric of M; whether that was possible.

    Each correction is one of Newton's own, with A and M where it is made: they converge quadratically. `rates` are d/dt
    of (q, q̇) nearby, shape (≥ 2n,).
    """
    n, m, holonomic = system.head[DEGREES], system.head[COUNT], system.head[HOLONOMIC]
    first = 2 * m * n
    for tries in range(MOST_CORRECTIONS):
        call(system.head[CORRECTED], system.head[CORRECTED_DATA], system.corrections, system.inputs)
        if not holds(system.corrections, first, holonomic + m, first + holonomic + m):
            return False
        is_close, is_small = correct_solved(system, first, holonomic, 0, h, rates)
        rates_close, rates_small = correct_solved(system, first + holonomic, m, n, h, rates)
        if (is_close and rates_close) or (tries >= SURE and is_small and rates_small):
            return True
    return False


@inline
def finish_solved(system: System, t: float, h: float, ends: Ends) -> bool:
    """The new state of a step projected, and its derivative; False if this is left to be done by numbers.

    That is so, too, where constraints may have lost their independence on the way.
    """
    _, new, rates, derivative = ends
    n, size, rows = system.head[DEGREES], system.head[COUNT] * system.head[DEGREES], place_of_rows(system)
    force = n * (n + 1) // 2
    take_state(system, t + h, new)
    if not project_solved(system, h, rates):
        return False
    for i in range(size):
        system.responses[i] = system.corrections[size + i]
    call(system.head[SOLVED], system.head[SOLVED_DATA], system.outputs, system.inputs)
    if not (holds(system.outputs, force, n, rows) and turning(system) > 0.0):
        return False
    for d in range(n):
        new[d], new[n + d] = system.inputs[d], system.inputs[n + d]
        derivative[d], derivative[n + d] = system.inputs[n + d], system.outputs[force + d]
    if system.head[POWERED]:
        derivative[2 * n] = system.outputs[force + n]
    for i in range(size):
        system.outputs[rows + i] = system.corrections[i]
    keep_rows(system)
    return True


@callback("int64(int64, float64, float64, int64, int64, int64, int64)")
def constrained_finish(
    data: int, t: float, h: float, old: int, new: int, old_derivative: int, new_derivative: int
) -> int:
    """`finish_solved`, or else `finish_step`, for stepping loops, which know the block's address alone."""
    prevent_vectorization()
    system = block_at(data)
    width = 2 * system.head[DEGREES] + system.head[POWERED]
    ends = (
        doubles_at(old, width),
        doubles_at(new, width),
        doubles_at(old_derivative, width),
        doubles_at(new_derivative, width),
    )
    if system.head[SOLVED] != 0 and system.head[IS_UNDER_WAY] != 0 and finish_solved(system, t, h, ends):
        return FINE
    return finish_step(system, t, h, ends)
