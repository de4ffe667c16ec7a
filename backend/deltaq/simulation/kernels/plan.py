"""Where steps end and how long they may be, piece by piece of the span; and a record of where they ended.

Forces that change fast at known times need short steps there, and a force that jumps needs a step that ends before the
jump and one that begins behind it.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .compiler import inline
from .motion import Floats

CAPACITY = 1 << 15  # recorded steps, an even number; a longer run keeps every second, every fourth … of its steps
COUNT, STRIDE, SKIPPED = 0, 1, 2
ROUNDED = 4e-15  # of a time, as sums of steps and the room before a jump are; so close before the end is at the end


class Plan(NamedTuple):
    """Pieces of the span, and the mesh that a run leaves.

    Piece k goes up to ends[k] (the last may have no end) with steps of sizes[k], adaptive ones up to that: `ends` and
    `sizes` have shape (pieces,), in seconds. Size 0 marks a jump: the piece has no length but the distance of two
    neighbouring numbers, and forces differ at its ends. `times`, shape (capacity,), and `states`, shape (capacity, 2n),
    receive the ends of steps; `progress`, shape (3,), how many, every how many, and those since.
    """

    ends: Floats
    sizes: Floats
    times: Floats
    states: Floats
    progress: NDArray[np.int64]


def make_plan(ends: Floats, sizes: Floats, width: int, capacity: int = 0) -> Plan:
    """A plan that records up to `capacity` steps of states with `width` components.

    `ends` and `sizes` of its pieces have shape (pieces,).
    """
    progress = np.array([0, 1, 0], dtype=np.int64)
    return Plan(ends, sizes, np.empty(capacity), np.empty((capacity, width)), progress)


@inline
def enter_piece(plan: Plan, piece: int, t: float) -> tuple[int, float, bool]:
    """The piece in which a step from t begins, the time it begins at, and whether a jump was crossed to get there."""
    if t < plan.ends[piece]:
        return piece, t, False
    if plan.sizes[piece + 1] == 0.0:
        return piece + 2, plan.ends[piece + 1], True
    return piece + 1, t, False


@inline
def comes_to(end: float, reached: float) -> bool:
    """Whether a step that ends at `reached` has come to the end of the samples, but for rounding."""
    return reached >= end * (1.0 - ROUNDED)


@inline
def fit_step(plan: Plan, piece: int, t: float, wanted: float) -> tuple[float, bool]:
    """The step wanted, no longer than the piece allows, and whether it ends the piece."""
    left, h = plan.ends[piece] - t, min(wanted, plan.sizes[piece])
    return (h, False) if h * (1.0 + 1e-9) < left else (left, True)


@inline
def start_record(progress: NDArray[np.int64]) -> None:
    """Nothing is recorded yet: `progress` has shape (3,)."""
    progress[COUNT], progress[STRIDE], progress[SKIPPED] = 0, 1, 0


@inline
def record(plan: Plan, t: float, state: Floats) -> None:
    """Records the end of a step, a state of shape (≥ 2n,)."""
    record_row(plan.times, plan.states, plan.progress, t, state)


@inline
def record_row(times: Floats, states: Floats, progress: NDArray[np.int64], t: float, state: Floats) -> None:
    """Records the end of a step in a mesh (see `Plan`); when it is full, every second entry is dropped.

    `times` has shape (capacity,), `states` (capacity, 2n), `progress` (3,), and `state` (≥ 2n,).
    """
    if times.size == 0:
        return
    progress[SKIPPED] += 1
    if progress[SKIPPED] < progress[STRIDE] and progress[COUNT] > 0:
        return
    progress[SKIPPED] = 0
    if progress[COUNT] == times.size:
        progress[COUNT] //= 2
        progress[STRIDE] *= 2
        for k in range(progress[COUNT]):
            times[k] = times[2 * k]
            for d in range(states.shape[1]):
                states[k, d] = states[2 * k, d]
    place = progress[COUNT]
    times[place] = t
    for d in range(states.shape[1]):
        states[place, d] = state[d]
    progress[COUNT] += 1
