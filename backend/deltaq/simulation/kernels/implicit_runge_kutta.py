"""The stepping loop of all implicit and partitioned Runge–Kutta methods in positions and momenta.

Fixed steps stay what they are: the last one goes past the end if it must, and samples lie inside the steps.
"""

from __future__ import annotations

import numpy as np

from .collocation import sample_stages
from .compiler import inline, kernel, runtime_int
from .hermite import sample_between
from .implicit_step import attempt_implicit, differentiate, prepare
from .implicit_workspace import ImplicitWorkspace, accept_step
from .loop import Result, advance_time, begin, interruption, sample_at_jump, time_reached
from .motion import FINE, NEWTON_FAILED, STEP_UNDERFLOW, Floats, Motion, rhs
from .newton import SLOW
from .phase import Phase, momenta
from .plan import enter_piece, fit_step, record
from .stages import ImplicitWeights, predict
from .step_control import Control, controlled_step, is_resolvable, log_error, reduced_step
from .switch import AHEAD, detect_hold, held_or_failed, is_held_before
from .watch import Watch, check_events, set_sample_times


@inline
def sample_implicit(
    motion: Motion,
    phase: Phase,
    weights: ImplicitWeights,
    now: tuple[float, float],
    samples: tuple[Floats, Floats],
    first: int,
    workspace: ImplicitWorkspace,
) -> tuple[int, int]:
    """Samples number `first` and on that lie in the step now = (t, h); returns the next one and the evaluations made.

    `samples` are the times, shape (samples,), and the states, shape (samples, width), which are written.
    """
    if weights.error.size > 0:
        return sample_stages(phase, weights, now, samples, first, workspace), 0
    is_high = 1 if weights.c.size > 1 else 0  # of order 2s
    return sample_between(motion, now[0], now[1], samples[0], samples[1], first, workspace.ends, is_high)


@inline
def watch_implicit(
    motion: Motion,
    phase: Phase,
    weights: ImplicitWeights,
    now: tuple[float, float],
    watch: Watch,
    workspace: ImplicitWorkspace,
) -> tuple[int, int]:
    """Whether an event happens in the step now = (t, h); also returns the evaluations made."""
    if watch.functions == 0:
        return FINE, 0
    set_sample_times(watch, now[0], now[1])
    _, extra = sample_implicit(motion, phase, weights, now, (watch.times, watch.states), runtime_int(0), workspace)
    return check_events(watch, motion.degrees), extra


@inline
def sample_and_watch(
    motion: Motion,
    phase: Phase,
    weights: ImplicitWeights,
    now: tuple[float, float],
    samples: tuple[Floats, Floats],
    first: int,
    watch: Watch,
    workspace: ImplicitWorkspace,
) -> tuple[int, int, int]:
    """Samples of a step, and whether an event happens in it: the next sample, the outcome, and the evaluations made.

    `samples` are the times, shape (samples,), and the states, shape (samples, width), which are written.
    """
    filled, made = sample_implicit(motion, phase, weights, now, samples, first, workspace)
    outcome, more = watch_implicit(motion, phase, weights, now, watch, workspace)
    return filled, outcome, made + more


@inline
def next_step(control: Control, h: float, error: float) -> float:
    """The size after an accepted step; the same again where it would hardly grow, which saves a decomposition."""
    if control.tolerance == 0.0:
        return np.inf
    wanted = controlled_step(control, h, log_error(max(error, 1e-6)), 0.0, 5.0)
    return h if h <= wanted <= 1.2 * h else wanted


@inline
def smaller_step(control: Control, outcome: int, t: float, h: float, error: float) -> tuple[int, float]:
    """The size to try again with, or the outcome that ends the run."""
    if control.tolerance == 0.0:
        return outcome, h
    smaller = reduced_step(control, h, error) if outcome == FINE else 0.25 * h
    if is_resolvable(control, t, smaller):
        return FINE, smaller
    return STEP_UNDERFLOW if outcome in (FINE, NEWTON_FAILED) else outcome, smaller


@inline
def first_step_of_piece(control: Control, piece: int) -> float:
    """A first step in a piece: a small part of the largest one where there is step control."""
    return 0.01 * min(control.largest_step, control.plan.sizes[piece]) if control.tolerance > 0.0 else np.inf


@inline
def begin_step(phase: Phase, control: Control, t: float, workspace: ImplicitWorkspace) -> int:
    """The rates of the momenta where a step begins, which is recorded; returns the evaluations made.

    Only an error that is estimated reads them.
    """
    ends, n = workspace.ends, workspace.p.size
    record(control.plan, t, ends.old)
    if control.tolerance == 0.0:
        return 0
    momenta(phase, t, ends.old[:n], ends.old[n : 2 * n], workspace.stages.spare[0], workspace.rate)
    return 1


@inline
def explain_failure(
    motion: Motion, control: Control, watch: Watch, t: float, h: float, outcome: int, workspace: ImplicitWorkspace
) -> int:
    """HELD if a run ended because friction holds the motion, else the outcome as it was."""
    if (
        outcome not in (STEP_UNDERFLOW, NEWTON_FAILED)
        or rhs(motion, t, workspace.ends.old, workspace.ends.old_derivative) != FINE
    ):
        return outcome
    reach = AHEAD * control.largest_step if control.tolerance > 0.0 else 2.0 * h
    return held_or_failed(motion, watch.switch, t, reach, workspace.ends.old, workspace.ends.old_derivative, outcome)


@kernel
def integrate_implicit(
    motion: Motion,
    phase: Phase,
    weights: ImplicitWeights,
    control: Control,
    watch: Watch,
    workspace: ImplicitWorkspace,
    times: Floats,
    out: Floats,
) -> Result:
    """Steps from times[0] to times[-1]; out[i] becomes (q, q̇, ∫P dt) at times[i], as far as all goes well.

    The initial state stands in `workspace.ends.old`. `times` has shape (samples,), `out` shape (samples, width).
    """
    t, time_compensation, n, plan = times[0], 0.0, motion.degrees, control.plan
    q, v = workspace.ends.old[:n], workspace.ends.old[n : 2 * n]
    outcome = begin(motion, plan, watch, t, workspace.ends.old, workspace.ends.old_derivative, out)
    if outcome != FINE:
        return Result(outcome, 1, 0, 0, 1, t)
    momenta(phase, t, q, v, workspace.p, workspace.rate)
    is_adaptive = control.tolerance > 0.0
    wanted, piece = first_step_of_piece(control, 0), runtime_int(0)
    h, before_h, assembled_h, is_old, is_fresh = 0.0, 0.0, 0.0, True, True
    filled, steps, rejected, evaluations = runtime_int(1), 0, 0, 2
    while filled < times.size and outcome == FINE:
        outcome = interruption(control, steps + rejected, watch)
        if outcome != FINE:
            break
        piece, t, jumped = enter_piece(plan, piece, t)
        if jumped:
            time_compensation, before_h, is_old, wanted = 0.0, 0.0, True, first_step_of_piece(control, piece)
            evaluations += begin_step(phase, control, t, workspace)
        h, ends_piece = fit_step(plan, piece, t, wanted)
        predict(weights, h / before_h if before_h > 0.0 else 0.0, 0 if is_adaptive else 1, v, workspace.stages)
        if is_old:
            evaluations += differentiate(phase, weights, t, h, workspace)
            assembled_h, is_old, is_fresh = 0.0, False, True
        outcome = prepare(weights, h, workspace) if assembled_h != h else FINE
        assembled_h, slowness, error = h, 0.0, 0.0
        if outcome == FINE:
            outcome, made, slowness, error = attempt_implicit(
                motion, phase, weights, control.tolerance, t, h, workspace
            )
            evaluations += made
        if outcome == FINE and error <= 1.0:
            held = detect_hold(
                motion, watch.switch, t, h, 0 if is_adaptive else 1, workspace.ends.old, workspace.ends.new
            )
            if is_held_before(watch.switch, t + h, held):
                outcome = held
                break
            filled, outcome, made = sample_and_watch(
                motion, phase, weights, (t, h), (times, out), filled, watch, workspace
            )
            outcome = outcome or held
            evaluations += made
            accept_step(workspace)
            steps += 1
            t, time_compensation = advance_time(plan, piece, t, h, time_compensation, 1 if ends_piece else 0)
            filled = sample_at_jump(plan, piece, t, filled, out, workspace.ends.old)
            evaluations += begin_step(phase, control, t, workspace)
            before_h, is_fresh, is_old = h, False, slowness > SLOW
            wanted = max(next_step(control, h, error), wanted if ends_piece else 0.0)
        elif outcome != FINE and (not is_fresh or before_h > 0.0):
            before_h, is_old, outcome = 0.0, True, FINE
        else:
            before_h = 0.0
            rejected += is_adaptive
            outcome, wanted = smaller_step(control, outcome, t, h, error)
    outcome = explain_failure(motion, control, watch, t, h, outcome, workspace)
    return Result(outcome, filled, steps, rejected, evaluations, time_reached(watch, outcome, times, filled, t))
