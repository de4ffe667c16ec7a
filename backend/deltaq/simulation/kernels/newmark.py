"""The stepping loop of Newmark's family of methods."""

from __future__ import annotations

from .compiler import kernel, variable
from .hermite import sample_between, watch_between
from .loop import Result, begin, interruption, later
from .motion import FINE, Floats, Motion
from .newmark_step import NewmarkRoom, NewmarkWeights, attempt_newmark, take
from .newton import SLOW
from .step_control import Control
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
    t, lost_time, h, ends = times[0], 0.0, control.step, room.ends
    outcome = begin(motion, t, ends.old, ends.old_slope, out)
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
            t, lost_time = later(t, h, lost_time)
        elif not was_fresh:
            needs_matrix, outcome = True, FINE
    return Result(outcome, filled, steps, 0, evaluations, min(t, times[times.size - 1]))
