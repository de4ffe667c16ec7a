"""The stepping loop of partitioned methods where M is constant and forces depend on q and t alone."""

from __future__ import annotations

import numpy as np

from .compiler import kernel, runtime_int, subroutine
from .hermite import sample_between, watch_between
from .loop import Result, advance_time, begin, interruption, sample_at_jump, time_reached
from .motion import FINE, Floats, Motion, rhs
from .phase import Phase
from .plan import enter_piece, fit_step, record
from .pushed import Pushed, advance_pushed
from .rattle import Held
from .split_step import SplitWeights, SplitWorkspace, add_compensated, advance, check, factorize
from .step_control import Control
from .watch import Watch


@subroutine
def work(motion: Motion, t: float, h: float, workspace: SplitWorkspace) -> int:
    """∫P dt over the step, by the trapezoidal rule."""
    ends, n = workspace.ends, motion.degrees
    outcome = rhs(motion, t, ends.old, ends.old_derivative)
    if outcome == FINE:
        outcome = rhs(motion, t + h, ends.new, ends.new_derivative)
    add_compensated(2 * n, 0.5 * h * (ends.old_derivative[2 * n] + ends.new_derivative[2 * n]), workspace)
    return outcome


@kernel
def integrate_split(
    motion: Motion,
    phase: Phase,
    scheme: tuple[SplitWeights, Held, Pushed],
    control: Control,
    watch: Watch,
    workspace: SplitWorkspace,
    times: Floats,
    out: Floats,
) -> Result:
    """Steps of one size from times[0] past times[-1]; out[i] becomes (q, q̇, ∫P dt) at times[i].

    `scheme` are the kicks and drifts, and what keeps them on constraints where there are any, by numbers and as solved
    for in symbols. The initial state stands in `workspace.ends.old` and `workspace.ends.new`. `times` has shape
    (samples,), `out` shape (samples, width).
    """
    t, time_compensation, n, plan, ends = times[0], 0.0, motion.degrees, control.plan, workspace.ends
    outcome = begin(motion, plan, watch, t, ends.old, ends.old_derivative, out)
    if outcome != FINE:
        return Result(outcome, 1, 0, 0, 1, t)
    weights, held, pushed = scheme
    factorize(phase, t, workspace)
    filled, steps, evaluations, piece, is_known = runtime_int(1), 0, 2, runtime_int(0), False
    while filled < times.size and outcome == FINE:
        outcome = interruption(control, steps, watch)
        if outcome != FINE:
            break
        piece, t, jumped = enter_piece(plan, piece, t)
        if jumped:
            time_compensation, is_known = 0.0, False
            record(plan, t, ends.old)
        h, ends_piece = fit_step(plan, piece, t, np.inf)
        if motion.finish == 0:
            is_known, computed = advance(phase, weights, t, h, 1 if is_known else 0, workspace)
        else:
            outcome, is_known, computed = advance_pushed(motion, held, pushed, t, h, 1 if is_known else 0, workspace)
        evaluations += computed
        outcome = outcome or check(n, workspace)
        if outcome == FINE and motion.is_powered:
            outcome = work(motion, t, h, workspace)
            evaluations += 2
        if outcome != FINE:
            break
        filled, extra = sample_between(motion, t, h, times, out, filled, ends, runtime_int(0))
        evaluations += extra
        outcome, extra = watch_between(motion, t, h, watch, ends)
        evaluations += extra
        for d in range(ends.old.size):
            ends.old[d] = ends.new[d]
        steps += 1
        t, time_compensation = advance_time(plan, piece, t, h, time_compensation, 1 if ends_piece else 0)
        filled = sample_at_jump(plan, piece, t, filled, out, ends.old)
        record(plan, t, ends.old)
    return Result(outcome, filled, steps, 0, evaluations, time_reached(watch, outcome, times, filled, t))
