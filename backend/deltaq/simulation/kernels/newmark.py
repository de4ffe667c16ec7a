"""The stepping loop of Newmark's family of methods."""

from __future__ import annotations

import numpy as np

from .compiler import kernel, runtime_int
from .hermite import sample_between, watch_between
from .loop import Result, advance_time, begin, interruption, sample_at_jump, time_reached
from .motion import FINE, NEWTON_FAILED, Floats, Motion, rhs
from .newmark_step import (
    KNOWN,
    NewmarkWeights,
    NewmarkWorkspace,
    accept_step,
    attempt_newmark,
    forget_accelerations,
)
from .newton import SLOW
from .plan import enter_piece, fit_step, record
from .step_control import Control
from .switch import detect_hold, held_or_failed, is_held_before
from .watch import Watch


@kernel
def integrate_newmark(
    motion: Motion,
    weights: NewmarkWeights,
    control: Control,
    watch: Watch,
    workspace: NewmarkWorkspace,
    times: Floats,
    out: Floats,
) -> Result:
    """Steps of one size from times[0] past times[-1]; out[i] becomes (q, q̇, ∫P dt) at times[i].

    The initial state stands in `workspace.ends.old`. `times` has shape (samples,), `out` shape (samples, width).
    """
    t, time_compensation, plan, ends = times[0], 0.0, control.plan, workspace.ends
    outcome = begin(motion, plan, watch, t, ends.old, ends.old_derivative, out)
    if outcome != FINE:
        return Result(outcome, 1, 0, 0, 1, t)
    filled, steps, evaluations, piece, needs_matrix, matrix_h = runtime_int(1), 0, 1, runtime_int(0), True, 0.0
    while filled < times.size and outcome == FINE:
        outcome = interruption(control, steps, watch)
        piece, t, jumped = enter_piece(plan, piece, t)
        if jumped and outcome == FINE:
            time_compensation, outcome = 0.0, rhs(motion, t, ends.old, ends.old_derivative)
            evaluations += 1
            record(plan, t, ends.old)
        if outcome != FINE:
            break
        h, ends_piece = fit_step(plan, piece, t, np.inf)
        was_fresh = needs_matrix or h != matrix_h
        if jumped or h != matrix_h:
            forget_accelerations(workspace)
        matrix_h = h
        outcome, made, slowness = attempt_newmark(motion, weights, t, h, 1 if was_fresh else 0, workspace)
        evaluations += made
        needs_matrix = slowness > SLOW
        if outcome == FINE:
            held = detect_hold(motion, watch.switch, t, h, 1, ends.old, ends.new)
            if is_held_before(watch.switch, t + h, held):
                outcome = held
                break
            filled, made = sample_between(motion, t, h, times, out, filled, ends, runtime_int(0))
            evaluations += made
            outcome, made = watch_between(motion, t, h, watch, ends)
            outcome = outcome or held
            evaluations += made
            accept_step(workspace)
            steps += 1
            t, time_compensation = advance_time(plan, piece, t, h, time_compensation, 1 if ends_piece else 0)
            filled = sample_at_jump(plan, piece, t, filled, out, ends.old)
            record(plan, t, ends.old)
        elif not was_fresh or workspace.remembered[KNOWN] > 0:
            needs_matrix, outcome = True, FINE
            forget_accelerations(workspace)
    if outcome == NEWTON_FAILED:
        outcome = held_or_failed(motion, watch.switch, t, 2.0 * matrix_h, ends.old, ends.old_derivative, outcome)
    return Result(outcome, filled, steps, 0, evaluations, time_reached(watch, outcome, times, filled, t))
