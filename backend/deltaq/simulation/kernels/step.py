"""One step of an explicit Runge–Kutta method: its stages, and the new state by compensated (Kahan) summation."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .compiler import inner, variable
from .motion import FINE, NOT_FINITE, TOO_LARGE, Floats, Motion, slope, slope_here
from .pointer import one_by_one

LARGEST_VALUE = 1e15  # beyond, nothing in a mechanical scene has a meaning


class Weights(NamedTuple):
    """A tableau as arrays (see `method.Tableau`); `a` and `c` begin with the second stage."""

    a: Floats
    b: Floats
    c: Floats
    error: Floats
    dense: Floats
    extra_a: Floats
    extra_c: Floats


class Room(NamedTuple):
    """Arrays to work in. Kernels allocate nothing, so that Numba counts no references in the inner loop."""

    slopes: Floats  # of all stages
    stage: Floats  # the state of one stage
    old: Floats
    new: Floats
    lost: Floats  # digits of the old state below its rounding
    new_lost: Floats
    extension: Floats


def make_room(state: Floats, weights: Weights) -> Room:
    width, slopes = state.size, weights.b.size + 1 + weights.extra_c.size
    line = np.zeros(width)
    return Room(
        np.zeros((slopes, width)),
        line.copy(),
        state.copy(),
        line.copy(),
        line.copy(),
        line.copy(),
        np.zeros((3 + weights.dense.shape[0], width)),
    )


@inner
def stages(motion: Motion, a: Floats, c: Floats, first: int, t: float, h: float, room: Room) -> int:
    """Slopes number `first` and on, one for each row of a; returns how it went."""
    n, old, stage, slopes, inputs = motion.degrees, room.old, room.stage, room.slopes, motion.inputs
    for s in range(c.size):
        for d in range(n):  # no slope depends on ∫P dt
            value, rate = 0.0, 0.0
            for j in range(first + s):
                value += a[s, j] * slopes[j, d]
                rate += a[s, j] * slopes[j, n + d]
            stage[d] = inputs[d] = old[d] + h * value
            stage[n + d] = inputs[n + d] = old[n + d] + h * rate
        outcome = slope_here(motion, t + c[s] * h, room.slopes[first + s])
        if outcome != FINE:
            return outcome
    return FINE


@inner
def advance(b: Floats, h: float, room: Room) -> int:
    """The new state from the slopes, with compensation; returns how it went.

    Σ bⱼ = 1, so what is summed is how the slopes differ from the first: large weights then round nothing large.
    """
    for d in range(room.old.size):
        first, change = room.slopes[0, d], 0.0
        for j in range(1, b.size):
            change += b[j] * (room.slopes[j, d] - first)
        change = h * (first + change) + room.lost[d]
        room.new[d] = room.old[d] + change
        room.new_lost[d] = change - (room.new[d] - room.old[d])
        if not abs(room.new[d]) <= LARGEST_VALUE:
            return NOT_FINITE if np.isnan(room.new[d]) else TOO_LARGE
    return FINE


@inner
def attempt(motion: Motion, weights: Weights, t: float, h: float, room: Room) -> int:
    """All stages of one step, the new state and the slope there; returns how it went."""
    outcome = stages(motion, weights.a, weights.c, variable(1), t, h, room)
    if outcome == FINE:
        outcome = advance(weights.b, h, room)
    if outcome == FINE:
        outcome = slope(motion, t + h, room.new, room.slopes[weights.b.size])
    return outcome


@inner
def accept(end: int, room: Room) -> None:
    """The new state becomes the old one."""
    one_by_one()
    for d in range(room.old.size):
        room.old[d] = room.new[d]
        room.lost[d] = room.new_lost[d]
        room.slopes[0, d] = room.slopes[end, d]
