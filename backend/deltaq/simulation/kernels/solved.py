"""The end of a step projected by what was solved for in symbols; by numbers where that does not hold.

Source: Hairer, Wanner, Solving Ordinary Differential Equations II, 2nd ed., VII.2.
"""

from __future__ import annotations

from .compiler import callback, inline, subroutine
from .motion import FINE, Floats, has_signs, holds
from .pointer import call, doubles_at, prevent_vectorization
from .projection import CLOSE, Ends, finish_step, take_state
from .system import (
    DEGREES,
    IS_UNDER_WAY,
    POWERED,
    PROJECTED,
    PROJECTED_DATA,
    SOLVED,
    SOLVED_DATA,
    TELLS_END,
    System,
    block_at,
    place_of_rows,
)

MOST_CORRECTIONS, SURE = 8, 2  # Newton's corrections; behind so many, one that is small in itself is the last


@inline
def take_projected(system: System, h: float, rates: Floats) -> tuple[bool, bool]:
    """What was projected becomes the state in `inputs`: whether hardly anything changed.

    Once relative to each coordinate or rate, or to how far it moves in h seconds, once relative to it or 1. `rates` are
    d/dt of (q, q̇) nearby, shape (≥ 2n,).
    """
    is_close, is_small = True, True
    for i in range(2 * system.head[DEGREES]):
        value = system.projected[i]
        size, change = abs(value), abs(system.inputs[i] - value)
        system.inputs[i] = value
        if not change <= CLOSE * max(size, abs(h * rates[i])):
            is_close = False
            if not change <= CLOSE * max(1.0, size):
                is_small = False
    return is_close, is_small


@inline
def project_solved(system: System, h: float, rates: Floats) -> bool:
    """Moves the state in `inputs` onto g = 0 and w = 0, in the metric of M; whether that was possible.

    Each correction is one of Newton's own, with A and M where it is made: they converge quadratically. Numbers that are
    not finite never do. Where constraints may have lost their independence since A `before` the step, it was not.
    `rates` are d/dt of (q, q̇) nearby, shape (≥ 2n,).
    """
    for tries in range(MOST_CORRECTIONS):
        call(system.head[PROJECTED], system.head[PROJECTED_DATA], system.projected, system.inputs)
        if not has_signs(system.signs, 1):
            return False
        is_close, is_small = take_projected(system, h, rates)
        if is_close or (tries >= SURE and is_small):
            return bool(system.signs[0] > 0.0)
    return False


@inline
def finish_solved(system: System, t: float, h: float, ends: Ends) -> bool:
    """The new state of a step projected, and its derivative if asked for; False if this is left to be done by numbers.

    That is so, too, where constraints may have lost their independence on the way.
    """
    _, new, rates, derivative = ends
    n, rows = system.head[DEGREES], place_of_rows(system)
    force = n * (n + 1) // 2
    take_state(system, t + h, new)
    if not project_solved(system, h, rates):
        return False
    tells_end = system.head[TELLS_END] != 0
    if tells_end:
        call(system.head[SOLVED], system.head[SOLVED_DATA], system.outputs, system.inputs)
        if not holds(system.outputs, force, n, rows):
            return False
    for d in range(2 * n):
        new[d] = system.inputs[d]
    for d in range(n if tells_end else 0):
        derivative[d], derivative[n + d] = new[n + d], system.outputs[force + d]
    if tells_end and system.head[POWERED]:
        derivative[2 * n] = system.outputs[force + n]
    for i in range(system.before.size):
        system.before[i] = system.rows[i]
    return True


@subroutine
def finish_by_numbers(data: int, t: float, h: float, old: int, new: int, derivatives: tuple[int, int]) -> int:
    """`finish_step` with the block at an address: nothing of it is on the way of who needs no numbers."""
    prevent_vectorization()
    system = block_at(data)
    width = 2 * system.head[DEGREES] + system.head[POWERED]
    before, behind = derivatives
    ends = (doubles_at(old, width), doubles_at(new, width), doubles_at(before, width), doubles_at(behind, width))
    return int(finish_step(system, t, h, ends))


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
    return int(finish_by_numbers(data, t, h, old, new, (old_derivative, new_derivative)))
