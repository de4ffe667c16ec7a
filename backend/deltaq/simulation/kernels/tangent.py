"""How a small deviation of a motion grows: the motion and a neighbour of it, stretch by stretch, in the same steps.

The neighbour takes the very steps that the motion takes, so the difference of the two is the derivative of the numeric
flow: errors of the steps are common to both. It is brought near again only where it has gone far: along a curved orbit
each such move leaves an error of the order of the distance, and done every period these feign a growth.
Source: Benettin, Galgani, Strelcyn, Phys. Rev. A 14 (1976) 2338.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .compiler import inline, kernel
from .motion import FINE, NOT_FINITE, STEP_LIMIT, STEP_UNDERFLOW, Floats, Motion, rhs
from .plan import Plan, comes_to, record
from .step import Weights, Workspace, accept, attempt
from .step_control import (
    LARGEST_GROWTH,
    Control,
    controlled_step,
    error_norm,
    first_step,
    is_resolvable,
    log_error,
    reduced_step,
)

NEAR = 1e-8  # size of the deviation, in units of the scales
FAR, TOO_NEAR = 1000.0, 0.03  # times NEAR: beyond these it is brought to NEAR again
TINY = 1e-9  # of a stretch


class Pair(NamedTuple):
    """The motion, its neighbour, and the units in which their distance is measured: `scales`, shape (2n,)."""

    motion: Motion
    weights: Weights
    control: Control
    workspace: Workspace
    neighbour: Workspace
    scales: Floats  # shape (2n,)


class Progress(NamedTuple):
    """Where the pair is: `clock`, shape (2,), holds the time and the size of the next step in seconds.

    `used`, shape (1,), is the number of steps.
    """

    clock: Floats
    used: Floats


class Trace(NamedTuple):
    """At the end of each stretch: the state, and the logarithm of the factor by which the deviation grew in it.

    `states` has shape (stretches, 2n), `growths` shape (stretches,).
    """

    states: Floats  # shape (stretches, 2n)
    growths: Floats


@kernel
def begin_pair(pair: Pair, progress: Progress, direction: Floats) -> int:
    """Sets derivatives, a first step, and the neighbour NEAR the motion in a direction; returns the outcome.

    `direction` has shape (2n,).
    """
    outcome = rhs(pair.motion, progress.clock[0], pair.workspace.old, pair.workspace.derivatives[0])
    if outcome != FINE:
        return outcome
    progress.clock[1] = first_step(pair.motion, pair.control, progress.clock[0], pair.workspace)
    return place_neighbour(pair, progress, direction, 0.0)


@inline
def place_neighbour(pair: Pair, progress: Progress, direction: Floats, size: float) -> int:
    """Puts the neighbour NEAR the motion: in its own direction, `size` times nearer, or (0) in the direction given.

    `direction` has shape (2n,). Returns the outcome.
    """
    workspace, neighbour = pair.workspace, pair.neighbour
    for d in range(workspace.old.size):
        away = 0.0
        if d < pair.scales.size:
            away = deviation(pair, d) / size if size > 0.0 else NEAR * direction[d] * pair.scales[d]
        neighbour.old[d] = workspace.old[d] + away
        neighbour.compensation[d] = workspace.compensation[d] + (away - (neighbour.old[d] - workspace.old[d]))
    return rhs(pair.motion, progress.clock[0], neighbour.old, neighbour.derivatives[0])


@inline
def deviation(pair: Pair, d: int) -> float:
    """One component of the deviation, digits below rounding included."""
    return float(
        (pair.neighbour.old[d] - pair.workspace.old[d])
        + (pair.neighbour.compensation[d] - pair.workspace.compensation[d])
    )


@inline
def deviation_size(pair: Pair) -> float:
    """The size of the deviation in units of the scales."""
    total = 0.0
    for d in range(pair.scales.size):
        total += (deviation(pair, d) / pair.scales[d]) ** 2
    return float(np.sqrt(total))


@inline
def bounded(plan: Plan, t: float, wanted: float) -> float:
    """The step wanted, no longer than the plan allows at t, and not beyond the end of that piece."""
    piece = 0
    while comes_to(plan.ends[piece], t):
        piece += 1
    return float(min(wanted, plan.sizes[piece], plan.ends[piece] - t))


@inline
def step_both(pair: Pair, progress: Progress, left: float) -> int:
    """One accepted step of at most `left` seconds for both motions; the clock says when it ended, the plan keeps it."""
    control, workspace, clock, end = pair.control, pair.workspace, progress.clock, pair.weights.b.size
    outcome, growth = FINE, LARGEST_GROWTH
    while outcome == FINE:
        h = bounded(control.plan, clock[0], min(clock[1], left))
        outcome = attempt(pair.motion, pair.weights, clock[0], h, pair.weights.reads_end, workspace)
        error = error_norm(pair.weights.error, control.tolerance, h, pair.motion.degrees, workspace)
        if outcome == FINE and error <= 1.0:
            outcome = attempt(pair.motion, pair.weights, clock[0], h, pair.weights.reads_end, pair.neighbour)
            accept(end, workspace)
            accept(end, pair.neighbour)
            proposed = controlled_step(control, h, log_error(error), log_error(1e-4), growth)
            clock[1] = proposed if h == clock[1] else max(clock[1], proposed)
            clock[0] += h
            record(control.plan, clock[0], workspace.old)
            return outcome
        smaller, growth = reduced_step(control, h, error if outcome == FINE else np.nan), 1.0
        if not is_resolvable(control, clock[0], smaller):
            return STEP_UNDERFLOW if outcome == FINE else outcome
        clock[1], outcome = smaller, FINE
    return outcome


@kernel
def follow_stretches(
    pair: Pair, progress: Progress, start: float, stretch: float, first: int, count: int, trace: Trace
) -> int:
    """Fills stretches first … first + count − 1 of the trace; returns the outcome.

    Stretch k ends at the time start + (k + 1) · stretch.
    """
    outcome = FINE
    for k in range(first, first + count):
        before, rescaled = np.log(deviation_size(pair) / NEAR), 0.0
        finish = start + (k + 1) * stretch
        while outcome == FINE and finish - progress.clock[0] > TINY * stretch:
            outcome, size = advance_pair(pair, progress, finish)
            if outcome == FINE and not TOO_NEAR < size < FAR:
                rescaled += np.log(size)
                outcome = place_neighbour(pair, progress, pair.scales, size)
        if outcome != FINE:
            return outcome
        trace.growths[k] = np.log(deviation_size(pair) / NEAR) + rescaled - before
        for d in range(pair.scales.size):
            trace.states[k, d] = pair.workspace.old[d]
    return FINE


@inline
def advance_pair(pair: Pair, progress: Progress, finish: float) -> tuple[int, float]:
    """One step towards `finish`: the outcome, and how many times NEAR the neighbour is away then."""
    if progress.used[0] >= pair.control.step_limit:
        return STEP_LIMIT, 1.0
    outcome = step_both(pair, progress, finish - progress.clock[0])
    progress.used[0] += 1
    size = deviation_size(pair) / NEAR
    return (outcome if 0.0 < size < np.inf else NOT_FINITE), size
