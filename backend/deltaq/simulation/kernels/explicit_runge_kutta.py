"""The stepping loop of all explicit Runge–Kutta methods, fixed step and adaptive."""

from __future__ import annotations

import numpy as np

from .compiler import inline, kernel, runtime_int
from .extension import sample, watch_extension
from .loop import Result, advance_time, begin, interruption, sample_at_jump, time_reached
from .motion import FINE, STEP_UNDERFLOW, Floats, Motion, finish_constrained, rhs
from .plan import enter_piece, fit_step, record
from .step import Weights, Workspace, accept, attempt
from .step_control import (
    LARGEST_GROWTH,
    Control,
    controlled_step,
    detect_stiffness,
    error_norm,
    first_step,
    is_resolvable,
    log_error,
    reduced_step,
)
from .switch import AHEAD, detect_hold, held_or_failed, is_held_before
from .watch import Watch


@inline
def retry_step(control: Control, outcome: int, t: float, h: float, error: float) -> tuple[int, float]:
    """FINE and a smaller size to try the step with, or what ends the run: t + h is no longer different from t."""
    smaller = reduced_step(control, h, error if outcome == FINE else np.nan)
    if is_resolvable(control, t, smaller):
        return FINE, smaller
    return STEP_UNDERFLOW if outcome == FINE else outcome, smaller


@inline
def next_step_size(control: Control, h: float, now: float, before: float, growth: float, planned: float) -> float:
    """The step wanted after one of size h, not below what was planned before a piece cut it; any where it is fixed."""
    return max(controlled_step(control, h, now, before, growth), planned) if control.tolerance > 0.0 else np.inf


@inline
def restart_after_jump(motion: Motion, control: Control, t: float, workspace: Workspace) -> tuple[int, float, int]:
    """The right-hand side behind a jump and a first step there; returns the outcome, the step and the evaluations."""
    outcome = rhs(motion, t, workspace.old, workspace.derivatives[0])
    record(control.plan, t, workspace.old)
    if outcome != FINE or control.tolerance == 0.0:
        return outcome, np.inf, 1
    return outcome, first_step(motion, control, t, workspace), 2


@kernel
def integrate(
    motion: Motion,
    weights: Weights,
    control: Control,
    watch: Watch,
    workspace: Workspace,
    times: Floats,
    out: Floats,
) -> Result:
    """Steps from times[0] to times[-1]; out[i] becomes the state at times[i], as far as all goes well.

    The initial state stands in `workspace.old`. `times` has shape (samples,), `out` shape (samples, width).
    """
    t, time_compensation, end, plan = times[0], 0.0, weights.b.size, control.plan
    outcome = begin(motion, plan, watch, t, workspace.old, workspace.derivatives[0], out)
    if outcome != FINE:
        return Result(outcome, 1, 0, 0, 1, t)
    is_adaptive = control.tolerance > 0.0
    reads_end = weights.reads_end if is_adaptive else 0
    wanted = first_step(motion, control, t, workspace) if is_adaptive else np.inf
    filled, steps, rejected, evaluations, before, growth = (
        runtime_int(1),
        0,
        0,
        1 + is_adaptive,
        log_error(1e-4),
        LARGEST_GROWTH,
    )
    stability_limited, piece = runtime_int(0), runtime_int(0)
    while filled < times.size and outcome == FINE:
        outcome = interruption(control, steps + rejected, watch)
        piece, t, jumped = enter_piece(plan, piece, t)
        if jumped and outcome == FINE:
            outcome, wanted, extra = restart_after_jump(motion, control, t, workspace)
            time_compensation = 0.0
            evaluations += extra
        if outcome != FINE:
            break
        h, ends_piece = fit_step(plan, piece, t, wanted)
        outcome = attempt(motion, weights, t, h, reads_end, workspace)
        evaluations += end
        error = error_norm(weights.error, control.tolerance, h, motion.degrees, workspace) if is_adaptive else 0.0
        if outcome == FINE and error <= 1.0:
            outcome = finish_constrained(
                motion, t, h, workspace.old, workspace.new, workspace.derivatives[0], workspace.derivatives[end]
            )
        if outcome == FINE and error <= 1.0:
            left = times[times.size - 1] - t
            stability_limited, outcome = detect_stiffness(
                control, stability_limited, steps, left, h, motion.degrees, workspace
            )
            held = detect_hold(motion, watch.switch, t, h, 0 if is_adaptive else 1, workspace.old, workspace.new)
            if outcome != FINE or is_held_before(watch.switch, t + h, held):
                outcome = outcome or held
                break
            filled, extra = sample(motion, weights, t, h, times, out, filled, workspace)
            evaluations += extra
            outcome, extra = watch_extension(motion, weights, t, h, watch, workspace)
            outcome = outcome or held
            evaluations += extra
            accept(end, workspace)
            steps += 1
            t, time_compensation = advance_time(plan, piece, t, h, time_compensation, 1 if ends_piece else 0)
            filled = sample_at_jump(plan, piece, t, filled, out, workspace.old)
            record(plan, t, workspace.old)
            now = log_error(error)
            wanted = next_step_size(control, h, now, before, growth, wanted if ends_piece else 0.0)
            before, growth = max(now, log_error(1e-4)), LARGEST_GROWTH
        elif is_adaptive:
            rejected += 1
            growth = 1.0
            outcome, wanted = retry_step(control, outcome, t, h, error)
    if outcome == STEP_UNDERFLOW:
        outcome = held_or_failed(
            motion, watch.switch, t, AHEAD * control.largest_step, workspace.old, workspace.derivatives[0], outcome
        )
    return Result(outcome, filled, steps, rejected, evaluations, time_reached(watch, outcome, times, filled, t))
