"""Samples inside a step from what is known at its two ends, so that samples never change a fixed step."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .compiler import inner, variable
from .motion import FINE, Floats, Motion, slope
from .watch import Watch, look_at, seen


class Ends(NamedTuple):
    """States (q, q̇ and, where power is fed in, ∫P dt) at both ends of a step, and their slopes."""

    old: Floats
    new: Floats
    old_slope: Floats
    new_slope: Floats


def make_ends(state: Floats) -> Ends:
    return Ends(state.copy(), state.copy(), np.zeros(state.size), np.zeros(state.size))


@inner
def is_smooth(ends: Ends, h: float, n: int) -> bool:
    """Whether the accelerations at the ends explain the change of rates; with unresolved vibrations they do not."""
    missed, largest = 0.0, 0.0
    for d in range(n, 2 * n):
        change = ends.new[d] - ends.old[d]
        missed = max(missed, abs(change - 0.5 * h * (ends.old_slope[d] + ends.new_slope[d])))
        largest = max(largest, h * abs(ends.old_slope[d]), h * abs(ends.new_slope[d]))
    return missed <= 0.1 * largest


@inner
def cubic(x: float, h: float, ends: Ends, d: int) -> float:
    """The cubic through values and slopes at both ends (Hermite), at t + xh."""
    change = ends.new[d] - ends.old[d]
    bend = h * ends.old_slope[d] - change
    other = change - h * ends.new_slope[d] - bend
    return float(ends.old[d] + x * (change + (1.0 - x) * (bend + x * other)))


@inner
def quintic(x: float, h: float, ends: Ends, d: int, n: int, out: Floats) -> None:
    """q and q̇ from the quintic through q, q̇, q̈ at both ends, of error h⁶."""
    v, a = h * ends.old[n + d], 0.5 * h * h * ends.old_slope[n + d]
    value = ends.new[d] - ends.old[d] - v - a
    rate = h * ends.new[n + d] - v - 2.0 * a
    bend = 0.5 * h * h * ends.new_slope[n + d] - a
    c3 = 10.0 * value - 4.0 * rate + bend
    c4 = -15.0 * value + 7.0 * rate - 2.0 * bend
    c5 = 6.0 * value - 3.0 * rate + bend
    out[d] = ends.old[d] + x * (v + x * (a + x * (c3 + x * (c4 + x * c5))))
    out[n + d] = (v + x * (2.0 * a + x * (3.0 * c3 + x * (4.0 * c4 + x * 5.0 * c5)))) / h


@inner
def sample_between(
    motion: Motion, t: float, h: float, times: Floats, out: Floats, first: int, ends: Ends
) -> tuple[int, int]:
    """Samples number `first` and on, as far as they lie in the step; returns the next one and the evaluations made."""
    n, count, reached = motion.degrees, times.size, t + h * (1.0 + 1e-9)
    if times[first] > reached:
        return first, 0
    knows = (
        slope(motion, t, ends.old, ends.old_slope) == FINE and slope(motion, t + h, ends.new, ends.new_slope) == FINE
    )
    smooth = knows and is_smooth(ends, h, n)
    while first < count and times[first] <= reached:
        x = min((times[first] - t) / h, 1.0)
        for d in range(ends.old.size):
            out[first, d] = ends.old[d] + x * (ends.new[d] - ends.old[d])
        if x == 1.0:
            for d in range(ends.old.size):
                out[first, d] = ends.new[d]
        elif knows:
            for d in range(ends.old.size):
                out[first, d] = cubic(x, h, ends, d)
            for d in range(n if smooth else 0):
                quintic(x, h, ends, d, n, out[first])
        first += 1
    return first, 2


@inner
def watch_between(motion: Motion, t: float, h: float, watch: Watch, ends: Ends) -> tuple[int, int]:
    """Whether an event happens in the step; also returns the evaluations made."""
    if watch.functions == 0:
        return FINE, 0
    look_at(watch, t, h)
    _, extra = sample_between(motion, t, h, watch.times, watch.states, variable(0), ends)
    return seen(watch, motion.degrees), extra
