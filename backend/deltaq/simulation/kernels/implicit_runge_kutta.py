"""The stepping loop of all implicit and partitioned Runge–Kutta methods in positions and momenta.

Fixed steps stay what they are: the last one goes past the end if it must, and samples lie inside the steps.
"""

from __future__ import annotations

import numpy as np

from .collocation import sample_stages
from .compiler import inner, kernel, variable
from .hermite import sample_between
from .implicit_room import ImplicitRoom, take
from .implicit_step import attempt_implicit, differentiate, prepare
from .loop import Result, begin, interruption, passed
from .motion import FINE, HELD, NEWTON_FAILED, STEP_UNDERFLOW, Floats, Motion, slope
from .newton import SLOW
from .phase import Phase, momenta
from .plan import Plan, entered, fitted, record
from .stages import ImplicitWeights, predict
from .step_control import Control, grown, level, shrunk, tells_apart
from .switch import AHEAD, fallen, hold, is_held_before
from .watch import Watch, look_at, seen


@inner
def sample_implicit(
    motion: Motion,
    phase: Phase,
    weights: ImplicitWeights,
    now: tuple[float, float],
    samples: tuple[Floats, Floats],
    first: int,
    room: ImplicitRoom,
) -> tuple[int, int]:
    """Samples number `first` and on that lie in the step now = (t, h); samples = (times, states)."""
    if weights.error.size > 0:
        return sample_stages(phase, weights, now, samples, first, room), 0
    return sample_between(motion, now[0], now[1], samples[0], samples[1], first, room.ends)


@inner
def watch_implicit(
    motion: Motion, phase: Phase, weights: ImplicitWeights, now: tuple[float, float], watch: Watch, room: ImplicitRoom
) -> tuple[int, int]:
    """Whether an event happens in the step now = (t, h); also returns the evaluations made."""
    if watch.functions == 0:
        return FINE, 0
    look_at(watch, now[0], now[1])
    _, extra = sample_implicit(motion, phase, weights, now, (watch.times, watch.states), variable(0), room)
    return seen(watch, motion.degrees), extra


@inner
def shown(
    motion: Motion,
    phase: Phase,
    weights: ImplicitWeights,
    now: tuple[float, float],
    samples: tuple[Floats, Floats],
    first: int,
    watch: Watch,
    room: ImplicitRoom,
) -> tuple[int, int, int]:
    """Samples of a step, and whether an event happens in it: the next sample, how it went, and the evaluations made."""
    filled, made = sample_implicit(motion, phase, weights, now, samples, first, room)
    outcome, more = watch_implicit(motion, phase, weights, now, watch, room)
    return filled, outcome, made + more


@inner
def next_step(control: Control, h: float, error: float) -> float:
    """The size after an accepted step; the same again where it would hardly grow, which saves a decomposition."""
    if control.tolerance == 0.0:
        return np.inf
    wanted = grown(control, h, level(max(error, 1e-6)), 0.0, 5.0)
    return h if h <= wanted <= 1.2 * h else wanted


@inner
def smaller_step(control: Control, outcome: int, t: float, h: float, error: float) -> tuple[int, float]:
    """The size to try again with, or the outcome that ends the run."""
    if control.tolerance == 0.0:
        return outcome, h
    smaller = shrunk(control, h, error) if outcome == FINE else 0.25 * h
    if tells_apart(control, t, smaller):
        return FINE, smaller
    return STEP_UNDERFLOW if outcome in (FINE, NEWTON_FAILED) else outcome, smaller


@inner
def cautious(control: Control, piece: int) -> float:
    """A first step in a piece: a small part of the largest one where there is step control."""
    return 0.01 * min(control.largest_step, control.plan.sizes[piece]) if control.tolerance > 0.0 else np.inf


@inner
def renewed(phase: Phase, plan: Plan, t: float, room: ImplicitRoom) -> int:
    """The rates of the momenta where a step begins, which is recorded; returns the evaluations made."""
    ends, n = room.ends, room.p.size
    momenta(phase, t, ends.old[:n], ends.old[n : 2 * n], room.stages.spare[0], room.rate)
    record(plan, t, ends.old)
    return 1


@inner
def explained(
    motion: Motion, control: Control, watch: Watch, t: float, h: float, outcome: int, room: ImplicitRoom
) -> int:
    """HELD if a run ended because friction holds the motion, else the outcome as it was."""
    if outcome not in (STEP_UNDERFLOW, NEWTON_FAILED) or slope(motion, t, room.ends.old, room.ends.old_slope) != FINE:
        return outcome
    reach = AHEAD * control.largest_step if control.tolerance > 0.0 else 2.0 * h
    return fallen(motion, watch.switch, t, reach, room.ends.old, room.ends.old_slope, outcome)


@kernel
def integrate_implicit(
    motion: Motion,
    phase: Phase,
    weights: ImplicitWeights,
    control: Control,
    watch: Watch,
    room: ImplicitRoom,
    times: Floats,
    out: Floats,
) -> Result:
    """Steps from times[0] to times[-1] and fills out[i] with (q, q̇, ∫P dt) at times[i], for as long as all goes well.

    The initial state stands in room.ends.old.
    """
    t, lost_time, n, plan = times[0], 0.0, motion.degrees, control.plan
    q, v = room.ends.old[:n], room.ends.old[n : 2 * n]
    outcome = begin(motion, plan, watch, t, room.ends.old, room.ends.old_slope, out)
    if outcome != FINE:
        return Result(outcome, 1, 0, 0, 1, t)
    momenta(phase, t, q, v, room.p, room.rate)
    is_adaptive = control.tolerance > 0.0
    wanted, piece = cautious(control, 0), variable(0)
    h, before_h, assembled_h, is_old, is_fresh = 0.0, 0.0, 0.0, True, True
    filled, steps, rejected, evaluations = variable(1), 0, 0, 2
    while filled < times.size and outcome == FINE:
        outcome = interruption(control, steps + rejected, watch)
        if outcome != FINE:
            break
        piece, t, jumped = entered(plan, piece, t)
        if jumped:
            lost_time, before_h, is_old, wanted = 0.0, 0.0, True, cautious(control, piece)
            evaluations += renewed(phase, plan, t, room)
        h, ends_piece = fitted(plan, piece, t, wanted)
        predict(weights, h / before_h if before_h > 0.0 else 0.0, v, room.stages)
        if is_old:
            evaluations += differentiate(phase, weights, t, h, room)
            assembled_h, is_old, is_fresh = 0.0, False, True
        outcome = prepare(weights, h, room) if assembled_h != h else FINE
        assembled_h, slowness, error = h, 0.0, 0.0
        if outcome == FINE:
            outcome, made, slowness, error = attempt_implicit(motion, phase, weights, control.tolerance, t, h, room)
            evaluations += made
        if outcome == FINE and error <= 1.0:
            held = hold(motion, watch.switch, t, h, 0 if is_adaptive else 1, room.ends.old, room.ends.new)
            if is_held_before(watch.switch, t + h, held):
                outcome = held
                break
            filled, outcome, made = shown(motion, phase, weights, (t, h), (times, out), filled, watch, room)
            outcome = outcome or held
            evaluations += made
            take(room)
            steps += 1
            t, lost_time = passed(plan, piece, t, h, lost_time, 1 if ends_piece else 0)
            evaluations += renewed(phase, plan, t, room)
            before_h, is_fresh, is_old = h, False, slowness > SLOW
            wanted = max(next_step(control, h, error), wanted if ends_piece else 0.0)
        elif outcome != FINE and not is_fresh:
            before_h, is_old, outcome = 0.0, True, FINE
        else:
            before_h = 0.0
            rejected += is_adaptive
            outcome, wanted = smaller_step(control, outcome, t, h, error)
    outcome = explained(motion, control, watch, t, h, outcome, room)
    reached = watch.switch.when[0] if outcome == HELD else min(t, times[times.size - 1])
    return Result(outcome, filled, steps, rejected, evaluations, reached)
