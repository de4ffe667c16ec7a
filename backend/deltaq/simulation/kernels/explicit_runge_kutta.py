"""The stepping loop of all explicit Runge–Kutta methods, fixed step and adaptive."""

from __future__ import annotations

import numpy as np

from .compiler import inner, kernel, variable
from .extension import sample, watch_extension
from .loop import Result, begin, interruption, passed
from .motion import FINE, HELD, STEP_UNDERFLOW, Floats, Motion, slope
from .plan import entered, fitted, record
from .step import Room, Weights, accept, attempt
from .step_control import LARGEST_GROWTH, Control, error_norm, first_step, grown, level, patience, shrunk, tells_apart
from .switch import AHEAD, fallen, hold, is_held_before
from .watch import Watch


@inner
def tried_again(control: Control, outcome: int, t: float, h: float, error: float) -> tuple[int, float]:
    """FINE and a smaller size to try the step with, or what ends the run: the size is too small to tell times apart."""
    smaller = shrunk(control, h, error if outcome == FINE else np.nan)
    if tells_apart(control, t, smaller):
        return FINE, smaller
    return STEP_UNDERFLOW if outcome == FINE else outcome, smaller


@inner
def next_size(control: Control, h: float, now: float, before: float, growth: float, planned: float) -> float:
    """The step wanted after one of size h, not below what was planned before a piece cut it; any where it is fixed."""
    return max(grown(control, h, now, before, growth), planned) if control.tolerance > 0.0 else np.inf


@inner
def restarted(motion: Motion, control: Control, t: float, room: Room) -> tuple[int, float, int]:
    """The slope behind a jump and a first step there; returns how it went, the step and the evaluations made."""
    outcome = slope(motion, t, room.old, room.slopes[0])
    record(control.plan, t, room.old)
    if outcome != FINE or control.tolerance == 0.0:
        return outcome, np.inf, 1
    return outcome, first_step(motion, control, t, room), 2


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
    t, lost_time, end, plan = times[0], 0.0, weights.b.size, control.plan
    outcome = begin(motion, plan, watch, t, room.old, room.slopes[0], out)
    if outcome != FINE:
        return Result(outcome, 1, 0, 0, 1, t)
    is_adaptive = control.tolerance > 0.0
    wanted = first_step(motion, control, t, room) if is_adaptive else np.inf
    filled, steps, rejected, evaluations, before, growth = (
        variable(1),
        0,
        0,
        1 + is_adaptive,
        level(1e-4),
        LARGEST_GROWTH,
    )
    held_back, piece = variable(0), variable(0)
    while filled < times.size and outcome == FINE:
        outcome = interruption(control, steps + rejected, watch)
        piece, t, jumped = entered(plan, piece, t)
        if jumped and outcome == FINE:
            outcome, wanted, extra = restarted(motion, control, t, room)
            lost_time = 0.0
            evaluations += extra
        if outcome != FINE:
            break
        h, ends_piece = fitted(plan, piece, t, wanted)
        outcome = attempt(motion, weights, t, h, room)
        evaluations += end
        error = error_norm(weights.error, control.tolerance, h, motion.degrees, room) if is_adaptive else 0.0
        if outcome == FINE and error <= 1.0:
            left = times[times.size - 1] - t
            held_back, outcome = patience(control, held_back, steps, left, h, motion.degrees, room)
            held = hold(motion, watch.switch, t, h, 0 if is_adaptive else 1, room.old, room.new)
            if outcome != FINE or is_held_before(watch.switch, t + h, held):
                outcome = outcome or held
                break
            filled, extra = sample(motion, weights, t, h, times, out, filled, room)
            evaluations += extra
            outcome, extra = watch_extension(motion, weights, t, h, watch, room)
            outcome = outcome or held
            evaluations += extra
            accept(end, room)
            steps += 1
            t, lost_time = passed(plan, piece, t, h, lost_time, 1 if ends_piece else 0)
            record(plan, t, room.old)
            now = level(error)
            wanted = next_size(control, h, now, before, growth, wanted if ends_piece else 0.0)
            before, growth = max(now, level(1e-4)), LARGEST_GROWTH
        elif is_adaptive:
            rejected += 1
            growth = 1.0
            outcome, wanted = tried_again(control, outcome, t, h, error)
    if outcome == STEP_UNDERFLOW:
        outcome = fallen(motion, watch.switch, t, AHEAD * control.largest_step, room.old, room.slopes[0], outcome)
    return Result(outcome, filled, steps, rejected, evaluations, watch.switch.when[0] if outcome == HELD else t)
