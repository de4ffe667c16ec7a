"""The stepping loop of Newmark's family of methods."""

from __future__ import annotations

import numpy as np

from .compiler import kernel, variable
from .hermite import sample_between, watch_between
from .loop import Result, begin, interruption, passed
from .motion import FINE, HELD, NEWTON_FAILED, Floats, Motion, slope
from .newmark_step import NewmarkRoom, NewmarkWeights, attempt_newmark, take
from .newton import SLOW
from .plan import entered, fitted, record
from .step_control import Control
from .switch import fallen, hold, is_held_before
from .watch import Watch


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
    t, lost_time, plan, ends = times[0], 0.0, control.plan, room.ends
    outcome = begin(motion, plan, watch, t, ends.old, ends.old_slope, out)
    if outcome != FINE:
        return Result(outcome, 1, 0, 0, 1, t)
    filled, steps, evaluations, piece, needs_matrix, matrix_h = variable(1), 0, 1, variable(0), True, 0.0
    while filled < times.size and outcome == FINE:
        outcome = interruption(control, steps, watch)
        piece, t, jumped = entered(plan, piece, t)
        if jumped and outcome == FINE:
            lost_time, outcome = 0.0, slope(motion, t, ends.old, ends.old_slope)
            evaluations += 1
            record(plan, t, ends.old)
        if outcome != FINE:
            break
        h, ends_piece = fitted(plan, piece, t, np.inf)
        was_fresh = needs_matrix or h != matrix_h
        matrix_h = h
        outcome, made, slowness = attempt_newmark(motion, weights, t, h, 1 if was_fresh else 0, room)
        evaluations += made
        needs_matrix = slowness > SLOW
        if outcome == FINE:
            held = hold(motion, watch.switch, t, h, 1, ends.old, ends.new)
            if is_held_before(watch.switch, t + h, held):
                outcome = held
                break
            filled, made = sample_between(motion, t, h, times, out, filled, ends)
            evaluations += made
            outcome, made = watch_between(motion, t, h, watch, ends)
            outcome = outcome or held
            evaluations += made
            take(room)
            steps += 1
            t, lost_time = passed(plan, piece, t, h, lost_time, 1 if ends_piece else 0)
            record(plan, t, ends.old)
        elif not was_fresh:
            needs_matrix, outcome = True, FINE
    if outcome == NEWTON_FAILED:
        outcome = fallen(motion, watch.switch, t, 2.0 * matrix_h, ends.old, ends.old_slope, outcome)
    reached = watch.switch.when[0] if outcome == HELD else min(t, times[times.size - 1])
    return Result(outcome, filled, steps, 0, evaluations, reached)
