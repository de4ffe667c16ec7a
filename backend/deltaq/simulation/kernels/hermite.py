"""Samples inside a step from what is known at its two ends, so that samples never change a fixed step."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .compiler import inline, runtime_int
from .motion import FINE, Floats, Motion, rhs
from .plan import comes_to
from .watch import Watch, check_events, set_sample_times

OFF = 0.3872983346207417  # √(3/20): as far from the middle of a step are two places inside it, nodes of Gauss


class Ends(NamedTuple):
    """The states at both ends of a step and their time derivatives: shape (width,) each.

    `old` and `new` are the states; `old_derivative` and `new_derivative` what the right-hand side says there. `inside`
    is a state inside the step, and `seen`, shape (2, width), what the right-hand side says at two of them, if asked.
    """

    old: Floats
    new: Floats
    old_derivative: Floats
    new_derivative: Floats
    inside: Floats
    seen: Floats


def make_ends(state: Floats) -> Ends:
    """Both ends at a state of shape (width,), with derivatives of zero."""
    still = np.zeros(state.size)
    return Ends(state.copy(), state.copy(), still.copy(), still.copy(), still.copy(), np.zeros((2, state.size)))


@inline
def is_smooth(ends: Ends, h: float, n: int) -> bool:
    """Whether the accelerations at the ends explain the change of rates; with unresolved vibrations they do not."""
    missed, largest = 0.0, 0.0
    for d in range(n, 2 * n):
        change = ends.new[d] - ends.old[d]
        missed = max(missed, abs(change - 0.5 * h * (ends.old_derivative[d] + ends.new_derivative[d])))
        largest = max(largest, h * abs(ends.old_derivative[d]), h * abs(ends.new_derivative[d]))
    return missed <= 0.1 * largest


@inline
def cubic(x: float, h: float, ends: Ends, d: int) -> float:
    """The cubic through values and derivatives at both ends (Hermite), at t + xh."""
    change = ends.new[d] - ends.old[d]
    bend = h * ends.old_derivative[d] - change
    other = change - h * ends.new_derivative[d] - bend
    return float(ends.old[d] + x * (change + (1.0 - x) * (bend + x * other)))


@inline
def quintic(x: float, h: float, ends: Ends, d: int, n: int, out: Floats) -> float:
    """Hermite interpolation of degree 5 at t + xh: q and q̇ of coordinate d from q, q̇, q̈ at both ends, error O(h⁶).

    They go into `out`, shape (width,); returns what h²q̈ is in the middle of the step.
    """
    v, a = h * ends.old[n + d], 0.5 * h * h * ends.old_derivative[n + d]
    value = ends.new[d] - ends.old[d] - v - a
    rate = h * ends.new[n + d] - v - 2.0 * a
    bend = 0.5 * h * h * ends.new_derivative[n + d] - a
    c3 = 10.0 * value - 4.0 * rate + bend
    c4 = -15.0 * value + 7.0 * rate - 2.0 * bend
    c5 = 6.0 * value - 3.0 * rate + bend
    out[d] = ends.old[d] + x * (v + x * (a + x * (c3 + x * (c4 + x * c5))))
    out[n + d] = (v + x * (2.0 * a + x * (3.0 * c3 + x * (4.0 * c4 + x * 5.0 * c5)))) / h
    return float(2.0 * a + 3.0 * (c3 + c4) + 2.5 * c5)


@inline
def look_inside(motion: Motion, t: float, h: float, ends: Ends) -> bool:
    """What the right-hand side says at two places inside a step, at states by the quintic; whether it says anything."""
    n = motion.degrees
    for k in range(2):
        x = 0.5 + (2 * k - 1) * OFF
        for d in range(ends.old.size):
            ends.inside[d] = cubic(x, h, ends, d)
        for d in range(n):
            quintic(x, h, ends, d, n, ends.inside)
        if rhs(motion, t + x * h, ends.inside, ends.seen[k]) != FINE:
            return False
    return True


@inline
def slope(x: float, h: float, ends: Ends, d: int) -> float:
    """The derivative of the cubic by x."""
    change = ends.new[d] - ends.old[d]
    bend = h * ends.old_derivative[d] - change
    other = change - h * ends.new_derivative[d] - bend
    return float(change + (1.0 - 2.0 * x) * (bend + x * other) + x * (1.0 - x) * other)


@inline
def sharpen(x: float, h: float, ends: Ends, d: int, n: int, out: Floats) -> None:
    """q and q̇ of coordinate d from accelerations at four places, into `out`, shape (width,): errors O(h⁷) and O(h⁶).

    Rates come from rates and accelerations alone: differences of positions, divided by h, would bring the rounding of
    these into them. To the cubic comes y² (α + βs), y = x (1 − x), s = x − ½; it has the accelerations seen inside. To
    the quintic comes y³, with the acceleration that this has in the middle.
    """
    v, y, s = n + d, x * (1.0 - x), x - 0.5
    early = h * ends.seen[0, v] - slope(0.5 - OFF, h, ends, v)
    late = h * ends.seen[1, v] - slope(0.5 + OFF, h, ends, v)
    alpha, beta = -(late - early) / (0.8 * OFF), -10.0 * (late + early)
    middle = quintic(x, h, ends, d, n, out)
    out[d] += (middle - h * (slope(0.5, h, ends, v) + beta / 16.0)) / 0.375 * y * y * y  # −3/8 is (y³)″ at ½
    out[v] = cubic(x, h, ends, v) + y * y * (alpha + beta * s)


@inline
def sample_between(
    motion: Motion, t: float, h: float, times: Floats, out: Floats, first: int, ends: Ends, is_high: int
) -> tuple[int, int]:
    """Samples number `first` and on, as far as they lie in the step; returns the next one and the evaluations made.

    `times` has shape (samples,), `out`, which is written, shape (samples, width). `is_high`: whether the step's order
    is so high that rates between its ends need accelerations seen there to be as good.
    """
    n, count, reached = motion.degrees, times.size, t + h
    is_last = comes_to(times[count - 1], reached)
    if not is_last and times[first] > reached:
        return first, 0
    knows = (
        rhs(motion, t, ends.old, ends.old_derivative) == FINE
        and rhs(motion, t + h, ends.new, ends.new_derivative) == FINE
    )
    smooth = knows and is_smooth(ends, h, n)
    looks = is_high != 0 and smooth
    sharp = looks and look_inside(motion, t, h, ends)
    while first < count and (is_last or times[first] <= reached):
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
                if sharp:
                    sharpen(x, h, ends, d, n, out[first])
                else:
                    quintic(x, h, ends, d, n, out[first])
        first += 1
    return first, 4 if looks else 2


@inline
def watch_between(motion: Motion, t: float, h: float, watch: Watch, ends: Ends) -> tuple[int, int]:
    """Whether an event happens in the step; also returns the evaluations made."""
    if watch.functions == 0:
        return FINE, 0
    set_sample_times(watch, t, h)
    _, extra = sample_between(motion, t, h, watch.times, watch.states, runtime_int(0), ends, runtime_int(0))
    return check_events(watch, motion.degrees), extra
