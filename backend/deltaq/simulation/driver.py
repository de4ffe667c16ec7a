"""From a problem to a trajectory: runs, compares, refines until the wanted accuracy is there or cannot be had.

`tolerance` is the wanted error of the returned coordinates at every sample (global), not that of a step.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..errors import Problem as Mistake
from ..errors import RequestError
from ..model.modes import Modes, modes_of_model
from .attempt import Attempt, Integrator
from .audit import Audit, GuideJump
from .conclusion import outcome
from .consistency import unmet
from .constraints import Reactions
from .estimate import Estimate
from .event import EventOccurrence
from .integration import Flag
from .method import Method, Series
from .problem import Floats, Problem, Stretch
from .reactions import reactions_along
from .refinement import BySeries, ByStep, ByTolerance, Refinement
from .rounding import significant
from .run import Stop
from .trajectory import MOST_TOLD, Cost, Trajectory
from .transitions import Transition

SPACING = 4e-16  # of numbers, relative
LEAST_SAMPLES = 200  # intervals that errors are compared on, however few samples are asked for


def simulate(
    problem: Problem,
    method: Method,
    *,
    step: float | None = None,
    tolerance: float | None = None,
    with_error: bool = True,
    cancelled: Flag | None = None,
) -> Trajectory:
    """The motion of a problem with a fixed step in seconds, or to a tolerance of its coordinates.

    The tolerance is absolute for coordinates below 1 and relative above. Without `with_error` there is one run and no
    estimate. `cancelled`, shape (1,), ends the runs when it is not 0. Raises ValueError unless one of step and
    tolerance is given, and SceneError where constraints cannot be kept even at the start.
    """
    if (step is None) == (tolerance is None):
        raise ValueError("give either a step or a tolerance")
    require_suitable(problem, method)
    guide_jump, modes = Audit(problem, method).guide_jump(), modes_of_model(problem.model)
    flag = np.zeros(1, dtype=np.int64) if cancelled is None else cancelled
    integrator = Integrator(
        problem if modes is None else replace(problem, model=modes.model),
        method,
        _refinement(problem, method, tolerance, modes),
        _grid(problem, guide_jump),
        flag,
        tolerance or np.inf,
        modes,
        problem,
    )
    if step is not None:
        attempts = [integrator.rounded(integrator.given(step)) if with_error else integrator.coarse(step)]
    else:
        attempts = [integrator.rounded(each) for each in integrator.until()] if with_error else [integrator.fine()]
    return _trajectory(problem, method, attempts, tolerance, step, guide_jump)


def require_suitable(problem: Problem, method: Method, pointer: str = "/method") -> None:
    """Raises RequestError for a method that cannot do a problem, with one that can."""
    if not is_suitable(problem, method):
        raise RequestError(Mistake("method-constraints", pointer, parameters={"name": method.id, "other": "dop853"}))


def is_suitable(problem: Problem, method: Method) -> bool:
    """Whether a method can do a problem: series have no way back to constraints yet."""
    return not (problem.is_constrained and isinstance(method.scheme, Series))


def _refinement(problem: Problem, method: Method, tolerance: float | None, modes: Modes | None) -> Refinement:
    if tolerance is not None and isinstance(method.scheme, Series):
        return BySeries(problem.t_end, method.scheme)
    if tolerance is not None and method.is_adaptive:
        return ByTolerance(problem.t_end, method.error_order or method.order)
    sure = 1 if (problem if modes is None else modes).model.tape.has_choices else method.order
    return ByStep(problem.t_end, method.order, problem.step_limit, sure)


def _grid(problem: Problem, guide_jump: GuideJump | None) -> Floats:
    """The sample times, and as many between them as it takes to see the error; up to a blow that ends the motion.

    They are numbers of 15 digits, so that what is computed at them and what an answer writes down are the same times.
    """
    times = significant(np.linspace(0.0, problem.t_end, _refined(problem) * (problem.samples - 1) + 1), 15)
    times[-1] = problem.t_end
    return (
        times
        if guide_jump is None or guide_jump.time >= problem.t_end
        else np.append(times[times < guide_jump.time], guide_jump.time)
    )


def _refined(problem: Problem) -> int:
    return -(-LEAST_SAMPLES // (problem.samples - 1))


def _trajectory(
    problem: Problem,
    method: Method,
    attempts: list[Attempt],
    tolerance: float | None,
    step: float | None,
    guide_jump: GuideJump | None,
) -> Trajectory:
    best = _best(problem, attempts)
    found, n = best.estimate, problem.degrees
    is_reached = None if tolerance is None or found is None else found.worst <= tolerance and best.is_complete
    transitions = _transitions(best)
    times, states, told = _with_both_sides(
        transitions, *_with_multipliers(found, problem, *_shown(best, _refined(problem)))
    )
    errors, of_multipliers = told[:, 0], told[:, 1:] if told.shape[1] > 1 else None
    stretches, reactions = tuple(Stretch(each.start, each.problem) for each in best.chosen.meshes), None
    if problem.reactions:
        states, reactions = _kept(problem, times, states, stretches)
        times, errors = times[: len(states)], errors[: len(states)]
        of_multipliers = of_multipliers if of_multipliers is None else of_multipliers[: len(states)]
    return Trajectory(
        method=method.id,
        outcome=outcome(problem, method, best, tolerance, step, guide_jump),
        times=times,
        values=states[:, :n],
        rates=states[:, n : 2 * n],
        work=states[:, 2 * n] if states.shape[1] > 2 * n else np.zeros(len(states)),
        estimate=None if found is None else Estimate(errors, found.worst, found.horizon, multipliers=of_multipliers),
        tolerance_reached=is_reached,
        reached=best.reached,
        conditioning=min(run.conditioning for run in best.runs),
        cost=_cost(attempts, best),
        event=_event_occurrence(best),
        seen_until=best.seen_until,
        reactions=reactions,
        transitions=transitions,
        stretches=stretches,
    )


def _kept(problem: Problem, times: Floats, states: Floats, stretches: tuple[Stretch, ...]) -> tuple[Floats, Reactions]:
    """The states as far as they can be kept, and the reactions there. Raises SceneError where the first one cannot.

    `times` has shape (samples,), `states` shape (samples, width).
    """
    found = reactions_along(problem, times, states, stretches)
    if not len(found[0]):
        raise unmet(problem)
    return found


def _best(problem: Problem, attempts: list[Attempt]) -> Attempt:
    """The attempt to answer with. Raises SceneError where constraints cannot be kept even at the start."""
    best = max(attempts, key=_merit)
    if problem.is_constrained and not min(len(run.times) for run in best.runs):
        raise unmet(problem)
    return best


def _transitions(best: Attempt) -> tuple[Transition, ...]:
    """The events behind which the motion went on, their times judged by how far the other run's are from them."""
    found = best.chosen.transitions
    others = best.runs[0 if best.chosen is best.runs[-1] else -1].transitions
    is_known = best.estimate is not None and len(best.runs) > 1
    pairs = zip(found, (*others, *(None,) * len(found)), strict=False)
    return tuple(
        replace(one, error=abs(one.time - other.time) + SPACING * one.time)
        if is_known and not one.ends_many and other is not None and (other.name, other.kind) == (one.name, one.kind)
        else one
        for one, other in pairs
    )


def _with_both_sides(
    transitions: tuple[Transition, ...], times: Floats, states: Floats, errors: Floats
) -> tuple[Floats, Floats, Floats]:
    """The samples, and at each event its time twice, with the states before and behind it.

    `errors` have shape (samples, k).
    """
    inside = [each for each in transitions[:MOST_TOLD] if len(times) and each.time <= times[-1]]
    if not inside:
        return times, states, errors
    at = np.array([each.time for each in inside])
    beside, kept = np.searchsorted(times, at), np.ones(len(times), dtype=np.bool_)
    kept[beside[times[beside] == at]] = False  # none is behind the last sample
    doubts = np.maximum(errors[np.maximum(beside - 1, 0)], errors[np.minimum(beside, len(times) - 1)])
    sides = np.array([state for each in inside for state in (each.before, each.after)])
    found = np.concatenate([times[kept], np.repeat(at, 2)])
    order = np.argsort(found, kind="stable")
    return (
        found[order],
        np.vstack([states[kept], sides])[order],
        np.concatenate([errors[kept], np.repeat(doubts, 2, axis=0)])[order],
    )


def _with_multipliers(
    found: Estimate | None, problem: Problem, times: Floats, states: Floats, errors: Floats
) -> tuple[Floats, Floats, Floats]:
    """The samples shown, their errors and those of the multipliers side by side, shape (samples, 1 + m).

    Those of an event that ends the motion are those of the last sample before it.
    """
    if found is None or found.multipliers is None:
        return times, states, errors[:, None]
    shown = found.multipliers[:: _refined(problem)][: len(times)]
    shown = np.vstack([shown, np.repeat(found.multipliers[-1:], len(times) - len(shown), axis=0)])
    return times, states, np.column_stack([errors, shown])


def _shown(best: Attempt, every: int) -> tuple[Floats, Floats, Floats]:
    """Times, states and errors of the samples asked for, and of the event if there is one."""
    chosen, found = best.chosen, best.estimate
    count = min(len(run.times) for run in best.runs)
    if best.doubtful is not None:
        count = min(count, int(np.searchsorted(chosen.times, best.reached, side="right")))
    errors = np.zeros(count) if found is None else found.errors
    shown = slice(0, min(count, len(errors)), every)  # a third run may have been held earlier
    if chosen.held is not None and best.is_complete:
        return _with_stop(chosen.held, found, chosen.times[shown], chosen.states[shown], errors[shown])
    if chosen.event is None or not best.is_complete:
        return chosen.times[shown], chosen.states[shown], errors[shown]
    return (
        np.append(chosen.times[shown], chosen.event.time),
        np.vstack([chosen.states[shown], chosen.event.state]),
        np.append(errors[shown], errors[-1]),
    )


def _with_stop(
    stop: Stop, found: Estimate | None, times: Floats, states: Floats, errors: Floats
) -> tuple[Floats, Floats, Floats]:
    """The samples, and the state in which friction holds the motion as the last one."""
    before = times < stop.time
    times, states, errors = times[before], states[before], errors[before]
    last = states[-1].copy() if len(states) else stop.state.copy()
    count = len(stop.state) // 2 * 2
    last[:count] = stop.state[:count]
    error = max(errors[-1] if len(errors) else 0.0, 0.0 if found is None else found.stop)
    return np.append(times, stop.time), np.vstack([states, last]), np.append(errors, error)


def _event_occurrence(best: Attempt) -> EventOccurrence | None:
    """The event that ended the motion, or may have."""
    event, found = best.chosen.event, best.estimate
    if event is None or not best.is_complete:
        return best.doubtful
    return EventOccurrence(event.index, event.time, None if found is None else found.event)


def _merit(attempt: Attempt) -> tuple[float, bool, float]:
    """What is right for longer comes first, then what is complete, then what is more accurate."""
    found = attempt.estimate
    worst = found.worst if found else 0.0
    horizon = np.inf if found is None or found.horizon is None else found.horizon
    return (
        min(horizon, attempt.seen_until, np.inf if attempt.is_complete else attempt.reached),
        attempt.is_complete,
        -worst,
    )


def _cost(attempts: list[Attempt], best: Attempt) -> Cost:
    runs, chosen = [run for attempt in attempts for run in attempt.own], best.chosen
    return Cost(
        int(chosen.result.steps),
        int(chosen.result.rejected),
        int(sum(run.result.evaluations for run in runs)),
        sum(run.wall_time for run in runs),
        len(runs),
        chosen.wall_time,
        int(chosen.result.evaluations),
    )
