"""The stepping loop of Newmark's family of methods."""

from __future__ import annotations

import numpy as np

from .compiler import kernel, variable
from .explicit_runge_kutta import Result, interruption
from .hermite import sample_between, watch_between
from .motion import FINE, NOT_FINITE, Floats, Motion, slope
from .newmark_step import NewmarkRoom, NewmarkWeights, attempt_newmark, take
from .step_control import Control
from .watch import Watch

SLOW = 0.002  # a ratio of corrections above which the derivatives are taken anew


@kernel
def integrate_newmark(
    motion: Motion,
    weights: NewmarkWeights,
    control: Control,
    watch: Watch,
    room: NewmarkRoom,
    times: Floats,
    out: Floats,
) -> Result:
    """Steps of one size from times[0] past times[-1]; out[i] becomes (q, q̇, ∫P dt) at times[i].

    The initial state stands in room.ends.old.
    """
    t, lost_time, h, ends = times[0], 0.0, control.step, room.ends
    outcome = slope(motion, t, ends.old, ends.old_slope)
    for d in range(ends.old.size):
        out[0, d] = ends.old[d]
        if outcome == FINE and not abs(ends.old_slope[d]) < np.inf:
            outcome = NOT_FINITE
    if outcome != FINE:
        return Result(outcome, 1, 0, 0, 1, t)
    filled, steps, evaluations, needs_matrix = variable(1), 0, 1, True
    while filled < times.size and outcome == FINE:
        outcome = interruption(control, steps, watch)
        if outcome != FINE:
            break
        was_fresh = needs_matrix
        outcome, made, slowness = attempt_newmark(motion, weights, t, h, 1 if was_fresh else 0, room)
        evaluations += made
        needs_matrix = slowness > SLOW
        if outcome == FINE:
            filled, made = sample_between(motion, t, h, times, out, filled, ends)
            evaluations += made
            outcome, made = watch_between(motion, t, h, watch, ends)
            evaluations += made
            take(room)
            steps += 1
            tick = h + lost_time
            lost_time = tick - ((t + tick) - t)
            t += tick
        elif not was_fresh:
            needs_matrix, outcome = True, FINE
    return Result(outcome, filled, steps, 0, evaluations, min(t, times[times.size - 1]))
