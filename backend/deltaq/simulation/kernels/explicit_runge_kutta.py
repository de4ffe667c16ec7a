"""The stepping loop of all explicit Runge–Kutta methods, fixed step and adaptive."""

from __future__ import annotations

import numpy as np

from .compiler import inner, kernel, variable
from .extension import sample, watch_extension
from .loop import Result, begin, interruption, later
from .motion import FINE, STEP_UNDERFLOW, Floats, Motion
from .step import Room, Weights, accept, attempt
from .step_control import LARGEST_GROWTH, Control, error_norm, first_step, grown, level, patience, shrunk, tells_apart
from .watch import Watch


@inner
def tried_again(control: Control, outcome: int, t: float, h: float, error: float) -> tuple[int, float]:
    """FINE and a smaller size to try the step with, or what ends the run: the size is too small to tell times apart."""
    smaller = shrunk(control, h, error if outcome == FINE else np.nan)
    if tells_apart(control, t, smaller):
        return FINE, smaller
    return STEP_UNDERFLOW if outcome == FINE else outcome, smaller


@kernel
def integrate(
    motion: Motion,
    weights: Weights,
    control: Control,
    watch: Watch,
    room: Room,
    times: Floats,
    out: Floats,
) -> Result:
    """Steps from times[0] to times[-1] and fills out[i] with the state at times[i], for as long as all goes well.

    The initial state stands in room.old.
    """
    t, lost_time, end = times[0], 0.0, weights.b.size
    finish = times[times.size - 1]
    outcome = begin(motion, t, room.old, room.slopes[0], out)
    if outcome != FINE:
        return Result(outcome, 1, 0, 0, 1, t)
    is_adaptive = control.tolerance > 0.0
    h = first_step(motion, control, t, room) if is_adaptive else control.step
    filled, steps, rejected, evaluations, before, growth = (
        variable(1),
        0,
        0,
        1 + is_adaptive,
        level(1e-4),
        LARGEST_GROWTH,
    )
    held_back = variable(0)
    while filled < times.size and outcome == FINE:
        outcome = interruption(control, steps + rejected, watch)
        if outcome != FINE:
            break
        h = h if h * (1.0 + 1e-9) < finish - t else finish - t
        outcome = attempt(motion, weights, t, h, room)
        evaluations += end
        error = error_norm(weights.error, control.tolerance, h, motion.degrees, room) if is_adaptive else 0.0
        if outcome == FINE and error <= 1.0:
            held_back, outcome = patience(control, held_back, steps, finish - t, h, motion.degrees, room)
            if outcome != FINE:
                break
            filled, extra = sample(motion, weights, t, h, times, out, filled, room)
            evaluations += extra
            outcome, extra = watch_extension(motion, weights, t, h, watch, room)
            evaluations += extra
            accept(end, room)
            steps += 1
            t, lost_time = later(t, h, lost_time)
            now = level(error)
            h = grown(control, h, now, before, growth)
            before, growth = max(now, level(1e-4)), LARGEST_GROWTH
        elif is_adaptive:
            rejected += 1
            growth = 1.0
            outcome, h = tried_again(control, outcome, t, h, error)
    return Result(outcome, filled, steps, rejected, evaluations, t)
