"""Room for the steps of implicit methods: kernels allocate nothing."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .compiler import inner
from .hermite import Ends, make_ends
from .linear import Places
from .motion import Floats
from .stages import Stages, make_stages


class ImplicitRoom(NamedTuple):
    """The state at both ends of a step, digits below its rounding, and room for stages and error estimate."""

    p: Floats
    new_p: Floats
    lost: Floats  # of q, then p, then the work
    new_lost: Floats
    rate: Floats  # ṗ at the start
    ends: Ends
    stages: Stages
    error: Floats
    error_matrix: Floats
    error_places: Places
    state: Floats
    slope: Floats


def make_implicit_room(state: Floats, n: int, count: int) -> ImplicitRoom:
    line, wide = np.zeros(n), np.zeros(state.size)
    return ImplicitRoom(
        line.copy(),
        line.copy(),
        wide.copy(),
        wide.copy(),
        line.copy(),
        make_ends(state),
        make_stages(count, n),
        wide.copy(),
        np.zeros((n, n)),
        np.zeros(n, dtype=np.int64),
        wide.copy(),
        wide.copy(),
    )


@inner
def add(old: float, change: float, d: int, room: ImplicitRoom) -> float:
    """old + change, with compensation."""
    change += room.lost[d]
    new = old + change
    room.new_lost[d] = change - (new - old)
    return new


@inner
def take(room: ImplicitRoom) -> None:
    """The new state becomes the old one."""
    for d in range(room.p.size):
        room.p[d] = room.new_p[d]
    for d in range(room.ends.old.size):
        room.ends.old[d] = room.ends.new[d]
        room.lost[d] = room.new_lost[d]
