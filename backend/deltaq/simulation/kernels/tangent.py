"""How a small deviation of a motion grows: the motion and a neighbour of it, stretch by stretch, in the same steps.

The neighbour takes the very steps that the motion takes, so the difference of the two is the derivative of the numeric
flow: errors of the steps are common to both. It is brought near again only where it has gone far: along a curved orbit
each such move leaves an error of the order of the distance, and done every period these feign a growth.
Source: Benettin, Galgani, Strelcyn, Phys. Rev. A 14 (1976) 2338.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .compiler import inner, kernel
from .motion import FINE, NOT_FINITE, STEP_LIMIT, STEP_UNDERFLOW, Floats, Motion, slope
from .step import Room, Weights, accept, attempt
from .step_control import LARGEST_GROWTH, Control, error_norm, first_step, grown, level, shrunk, tells_apart

NEAR = 1e-8  # size of the deviation, in units of the scales
FAR, TOO_NEAR = 1000.0, 0.03  # times NEAR: beyond these it is brought to NEAR again
TINY = 1e-9  # of a stretch


class Pair(NamedTuple):
    """The motion, its neighbour, and the units in which their distance is measured."""

    motion: Motion
    weights: Weights
    control: Control
    room: Room
    other: Room
    scales: Floats  # shape (2n,)


class Pace(NamedTuple):
    """Where the pair is: `clock` holds the time and the size of the next step, `used` the number of steps."""

    clock: Floats
    used: Floats


class Trace(NamedTuple):
    """At the end of each stretch: the state, and the logarithm of the factor by which the deviation grew in it."""

    states: Floats  # shape (stretches, 2n)
    growths: Floats


@kernel
def begin_pair(pair: Pair, pace: Pace, direction: Floats) -> int:
    """Sets the slopes, the first step, and the neighbour NEAR the motion in a direction."""
    outcome = slope(pair.motion, pace.clock[0], pair.room.old, pair.room.slopes[0])
    if outcome != FINE:
        return outcome
    pace.clock[1] = first_step(pair.motion, pair.control, pace.clock[0], pair.room)
    return place(pair, pace, direction, 0.0)


@inner
def place(pair: Pair, pace: Pace, direction: Floats, size: float) -> int:
    """Puts the neighbour NEAR the motion: in its own direction, `size` times nearer, or (0) in the direction given."""
    room, other = pair.room, pair.other
    for d in range(room.old.size):
        away = 0.0
        if d < pair.scales.size:
            away = gap(pair, d) / size if size > 0.0 else NEAR * direction[d] * pair.scales[d]
        other.old[d] = room.old[d] + away
        other.lost[d] = room.lost[d] + (away - (other.old[d] - room.old[d]))
    return slope(pair.motion, pace.clock[0], other.old, other.slopes[0])


@inner
def gap(pair: Pair, d: int) -> float:
    """One component of the deviation, digits below rounding included."""
    return float((pair.other.old[d] - pair.room.old[d]) + (pair.other.lost[d] - pair.room.lost[d]))


@inner
def distance(pair: Pair) -> float:
    """Size of the deviation in units of the scales."""
    total = 0.0
    for d in range(pair.scales.size):
        total += (gap(pair, d) / pair.scales[d]) ** 2
    return float(np.sqrt(total))


@inner
def step_both(pair: Pair, pace: Pace, left: float) -> int:
    """One accepted step of at most `left`; the clock says when it ended."""
    control, room, clock, end = pair.control, pair.room, pace.clock, pair.weights.b.size
    outcome, growth = FINE, LARGEST_GROWTH
    while outcome == FINE:
        h = min(clock[1], left)
        outcome = attempt(pair.motion, pair.weights, clock[0], h, room)
        error = error_norm(pair.weights.error, control.tolerance, h, pair.motion.degrees, room)
        if outcome == FINE and error <= 1.0:
            outcome = attempt(pair.motion, pair.weights, clock[0], h, pair.other)
            accept(end, room)
            accept(end, pair.other)
            proposed = grown(control, h, level(error), level(1e-4), growth)
            clock[1] = proposed if h == clock[1] else max(clock[1], proposed)
            clock[0] += h
            return outcome
        smaller, growth = shrunk(control, h, error if outcome == FINE else np.nan), 1.0
        if not tells_apart(control, clock[0], smaller):
            return STEP_UNDERFLOW if outcome == FINE else outcome
        clock[1], outcome = smaller, FINE
    return outcome


@kernel
def accompany(pair: Pair, pace: Pace, start: float, stretch: float, first: int, count: int, trace: Trace) -> int:
    """Fills stretches first … first + count − 1 of the trace, which end at start + (k + 1) · stretch."""
    outcome = FINE
    for k in range(first, first + count):
        before, renewed = np.log(distance(pair) / NEAR), 0.0
        finish = start + (k + 1) * stretch
        while outcome == FINE and finish - pace.clock[0] > TINY * stretch:
            outcome, size = walk(pair, pace, finish)
            if outcome == FINE and not TOO_NEAR < size < FAR:
                renewed += np.log(size)
                outcome = place(pair, pace, pair.scales, size)
        if outcome != FINE:
            return outcome
        trace.growths[k] = np.log(distance(pair) / NEAR) + renewed - before
        for d in range(pair.scales.size):
            trace.states[k, d] = pair.room.old[d]
    return FINE


@inner
def walk(pair: Pair, pace: Pace, finish: float) -> tuple[int, float]:
    """One step towards `finish`, and how many times NEAR the neighbour is away then."""
    if pace.used[0] >= pair.control.step_limit:
        return STEP_LIMIT, 1.0
    outcome = step_both(pair, pace, finish - pace.clock[0])
    pace.used[0] += 1
    size = distance(pair) / NEAR
    return (outcome if 0.0 < size < np.inf else NOT_FINITE), size
