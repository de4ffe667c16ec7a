"""The stepping loop of all implicit and partitioned Runge–Kutta methods in positions and momenta.

Fixed steps stay what they are: the last one goes past the end if it must, and samples lie inside the steps.
"""

from __future__ import annotations

from .collocation import sample_stages
from .compiler import inner, kernel, variable
from .hermite import sample_between
from .implicit_room import ImplicitRoom, take
from .implicit_step import attempt_implicit, differentiate, prepare
from .loop import Result, begin, interruption, later
from .motion import FINE, NEWTON_FAILED, STEP_UNDERFLOW, Floats, Motion
from .newton import SLOW
from .phase import Phase, momenta
from .stages import ImplicitWeights, predict
from .step_control import Control, grown, level, shrunk, tells_apart
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
def next_step(control: Control, h: float, error: float) -> float:
    """The size after an accepted step; the same again where it would hardly grow, which saves a decomposition."""
    if control.tolerance == 0.0:
        return control.step
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
    t, lost_time, n, last = times[0], 0.0, motion.degrees, times[times.size - 1]
    q, v = room.ends.old[:n], room.ends.old[n : 2 * n]
    outcome = begin(motion, t, room.ends.old, room.ends.old_slope, out)
    if outcome != FINE:
        return Result(outcome, 1, 0, 0, 1, t)
    momenta(phase, t, q, v, room.p, room.rate)
    is_adaptive = control.tolerance > 0.0
    h = control.step * (0.01 if is_adaptive else 1.0)
    before_h, assembled_h, is_old, is_fresh = 0.0, 0.0, True, True
    filled, steps, rejected, evaluations = variable(1), 0, 0, 2
    while filled < times.size and outcome == FINE:
        outcome = interruption(control, steps + rejected, watch)
        if outcome != FINE:
            break
        h = last - t if is_adaptive and h * (1.0 + 1e-9) > last - t else h
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
            now, samples = (t, h), (times, out)
            filled, made = sample_implicit(motion, phase, weights, now, samples, filled, room)
            evaluations += made
            outcome, made = watch_implicit(motion, phase, weights, now, watch, room)
            evaluations += made
            take(room)
            steps += 1
            t, lost_time = later(t, h, lost_time)
            before_h, is_fresh, is_old = h, False, slowness > SLOW
            h = next_step(control, h, error)
            momenta(phase, t, q, v, room.stages.spare[0], room.rate)
            evaluations += 1
        elif outcome != FINE and not is_fresh:
            before_h, is_old, outcome = 0.0, True, FINE
        else:
            before_h = 0.0
            rejected += is_adaptive
            outcome, h = smaller_step(control, outcome, t, h, error)
    return Result(outcome, filled, steps, rejected, evaluations, min(t, last))
