"""The end of a step projected by what was solved for in symbols; by numbers where that does not hold.

Source: Hairer, Wanner, Solving Ordinary Differential Equations II, 2nd ed., VII.2.
"""

from __future__ import annotations

import numpy as np

from .compiler import callback, inline, subroutine
from .motion import FINE, Floats, has_signs, holds
from .pointer import call, doubles_at, prevent_vectorization
from .projection import CLOSE, Ends, finish_step, read_gaps, take_state
from .system import (
    COUNT,
    DEGREES,
    HOLONOMIC,
    IS_UNDER_WAY,
    LANDED,
    LANDED_DATA,
    PLACED,
    PLACED_DATA,
    POWERED,
    PROJECTED,
    PROJECTED_DATA,
    SIGNS,
    SOLVED,
    SOLVED_DATA,
    TELLS_END,
    System,
    block_at,
    place_of_rows,
)

MOST_CORRECTIONS, SURE = 8, 2  # Newton's corrections; behind so many, one that is small in itself is the last
# Of a scaled pivot of AM⁻¹Aᵀ, and of the square of a row of A, of the largest: with less, rounding may count in rates.
INDEPENDENT, SMALL_ROW = 1e-6, 1e-4
NEGLIGIBLE, SMALL, LARGE = 0, 1, 2  # size classes of a correction
CLOSER = 2.3e-11  # ε^⅔: a second correction by the same A that is this small leaves its power 3/2


@inline
def size_class(value: float, change: float, part: float, reach: float) -> int:
    """NEGLIGIBLE up to a `part` of the value or of its `reach`, SMALL up to that part of 1, else LARGE, NaN as well."""
    size, change = abs(value), abs(change)
    if change <= part * max(size, reach):
        return NEGLIGIBLE
    return SMALL if change <= part * max(1.0, size) else LARGE


@inline
def is_settled(largest: int, tries: int) -> bool:
    """Whether a correction whose largest change is of this size class is the last one, `tries` having come before."""
    return largest == NEGLIGIBLE or (largest == SMALL and tries >= SURE)


@inline
def take_projected(system: System, h: float, rates: Floats) -> int:
    """What was projected becomes the state in `inputs`; the size class of the largest change, for a part CLOSE.

    A coordinate or rate reaches as far as it moves in h seconds. `rates` are d/dt of (q, q̇) nearby, shape (≥ 2n,).
    """
    largest = NEGLIGIBLE
    for i in range(2 * system.head[DEGREES]):
        value = system.projected[i]
        change = system.inputs[i] - value
        system.inputs[i] = value
        largest = max(largest, size_class(value, change, CLOSE, abs(h * rates[i])))
    return largest


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
        if is_settled(take_projected(system, h, rates), tries):
            return bool(system.signs[0] > 0.0)
    return False


@inline
def take_placed(system: System, part: float, h: float, rates: Floats) -> int:
    """Takes from q in `inputs` what it is off by; the size class of the largest change, for this `part`.

    `rates` are d/dt of (q, q̇) nearby, shape (≥ 2n,).
    """
    largest = NEGLIGIBLE
    for i in range(system.head[DEGREES]):
        change = system.placed[i]
        value = system.inputs[i] - change
        system.inputs[i] = value
        largest = max(largest, size_class(value, change, part, abs(h * rates[i])))
    return largest


@inline
def place_again(system: System) -> None:
    """What q in `inputs` is off by now, by A and M of the correction before."""
    n, holonomic = system.head[DEGREES], system.head[HOLONOMIC]
    read_gaps(system)
    for i in range(n):
        change = 0.0
        for k in range(holonomic):
            change += system.gaps[k] * system.placed[n + k * n + i]
        system.placed[i] = change


@inline
def place_solved(system: System, h: float, rates: Floats) -> bool:
    """Moves q in `inputs` onto g = 0, in the metric of M; whether that was possible.

    `rates` are d/dt of (q, q̇) nearby, shape (≥ 2n,). Numbers that are not finite never get close.
    """
    for tries in range(MOST_CORRECTIONS):
        call(system.head[PLACED], system.head[PLACED_DATA], system.placed, system.inputs)
        if is_settled(take_placed(system, CLOSE, h, rates), tries):
            return True
        place_again(system)
        if is_settled(take_placed(system, CLOSER, h, rates), tries):
            return True
    return False


@inline
def is_sure(system: System) -> bool:
    """Whether A is far from losing a row: none is much smaller than it was, nor depends on the others.

    Where one does, as next to a fork, what rounding leaves in q is magnified twice in the rates.
    """
    sure = system.signs[2] > INDEPENDENT
    for k in range(system.head[COUNT]):
        square, largest = system.squares[k], system.sizes[k]
        if square > largest:
            system.sizes[k] = square
        elif not square > SMALL_ROW * largest:
            sure = False
    return bool(sure)


@inline
def land_solved(system: System, h: float, rates: Floats) -> bool:
    """Moves q in `inputs` onto g = 0 and q̇ onto w = 0, q̈ with that stands in `projected`; whether that was possible.

    It is not where A may lose a row. `rates` are d/dt of (q, q̇) nearby, shape (≥ 2n,).
    """
    if system.head[PLACED] != 0 and not place_solved(system, h, rates):
        return False
    call(system.head[LANDED], system.head[LANDED_DATA], system.projected, system.inputs)
    if not (has_signs(system.signs, 1) and system.signs[0] > 0.0 and is_sure(system)):
        return False
    n, total = system.head[DEGREES], 0.0
    for i in range(n):
        system.inputs[n + i] -= system.projected[i]
        total += abs(system.inputs[n + i]) + abs(system.projected[n + i])
    return bool(total < np.inf)


@inline
def finish_landed(system: System, t: float, h: float, ends: Ends) -> bool:
    """The new state of a step projected, and its derivative, by one A and M; False if this is not sure enough."""
    _, new, rates, derivative = ends
    n = system.head[DEGREES]
    take_state(system, t + h, new)
    if not land_solved(system, h, rates):
        return False
    for d in range(n):
        new[d] = system.inputs[d]
        new[n + d] = derivative[d] = system.inputs[n + d]
        derivative[n + d] = system.projected[n + d]
    if system.head[POWERED]:
        derivative[2 * n] = system.signs[1 + SIGNS]
    return True


@inline
def finish_projected(system: System, t: float, h: float, ends: Ends) -> bool:
    """The new state of a step projected by corrections until nothing changes, each by its own A and M.

    And its derivative, if asked for. A step of several stages spends little of its time on its end, so that there is no
    code for both at once, as `finish_landed` calls it. False where constraints may have lost their independence.
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
    return True


@inline
def finish_solved(system: System, t: float, h: float, ends: Ends) -> bool:
    """The new state of a step projected, and its derivative if asked for; False if this is left to be done by numbers.

    That is so, too, where constraints may have lost their independence on the way.
    """
    lands = system.head[LANDED] != 0
    if not (finish_landed(system, t, h, ends) if lands else finish_projected(system, t, h, ends)):
        return False
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
