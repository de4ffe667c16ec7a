"""The status of a trajectory: how its runs ended, else what comparing them says."""

from __future__ import annotations

from ..mechanics.jumps import MOST
from .attempt import Attempt
from .audit import GuideJump
from .kernels.motion import CANCELLED, HELD, NOT_FINITE, STEP_UNDERFLOW, TOO_LARGE
from .lengths import fading_length
from .method import Method
from .outcome import NO_LENGTH, OK, Number, Outcome, outcome_of
from .problem import Problem
from .rounding import short
from .run import Run
from .singular import last_known, vanishing_margin
from .stability import largest_stable_step
from .stiffness import eigenvalues

WITHOUT_VALUE = (NOT_FINITE, STEP_UNDERFLOW, TOO_LARGE)  # what runs end by where something has no finite value
SMALL = 1e-5  # an error of a time, relative to it, that is not worth telling in a sentence


def outcome(
    problem: Problem,
    method: Method,
    best: Attempt,
    tolerance: float | None,
    step: float | None,
    guide_jump: GuideJump | None,
) -> Outcome:
    """The status: first what ended the runs, then a horizon, an event, a jump of a guide, a tolerance missed, else ok.

    Behind a horizon no event is certain, so it comes before them.
    """
    told: dict[str, Number] = {"method": method.id, "t": short(best.reached), "t_end": problem.t_end}
    ended = _failed(problem, method, best, step, told) or _unseen(best, step, told)
    if ended is not None:
        return ended
    found = best.estimate
    if found is not None and found.horizon is not None:
        return Outcome("horizon_reached", "horizon_reached", told | {"t": short(found.horizon)})
    if best.doubtful is not None or best.chosen.event is not None:
        return _ended(best, told)
    if guide_jump is not None:
        return Outcome("guide_jumps", "guide_jumps", told | {"t": short(guide_jump.time), "name": guide_jump.name})
    if found is not None and tolerance is not None and found.worst > tolerance:
        parameters = told | {"tolerance": tolerance, "error": short(found.worst)}
        return Outcome("tolerance_missed", "tolerance_missed", parameters)
    return OK


def _failed(
    problem: Problem, method: Method, best: Attempt, step: float | None, told: dict[str, Number]
) -> Outcome | None:
    """Friction that holds the motion, or a run that came to no end."""
    held = [run.held for run in best.runs if run.held is not None]
    if len(held) == len(best.runs):
        return outcome_of(HELD, told | {"name": problem.model.layout.switches[held[0].index]})
    failed = next((run for run in (best.chosen, *best.runs) if not run.is_complete), None)
    if failed is None and held:  # friction holds one run and not the other
        first = min(stop.time for stop in held)
        size = problem.t_end / max(best.chosen.result.steps, 1)
        return Outcome("unresolved", "unresolved", told | {"t": short(first), "step": short(0.1 * size)})
    if failed is None:
        return None
    steps = int(failed.result.steps + failed.result.rejected)
    if step is not None and failed.result.outcome == TOO_LARGE:
        return _grown(problem, method, step, told)
    singular = _singular(problem, failed, told)
    if singular is not None:
        return singular
    where = {"name": failed.at[:MOST]} if failed.at else {}
    given = {"step": short(step)} if step is not None else {}
    return outcome_of(int(failed.result.outcome), told | {"steps": steps} | given | where)


def _singular(problem: Problem, failed: Run, told: dict[str, Number]) -> Outcome | None:
    """What comes to zero where a run could not go on: a prescribed length, or what something is divided by."""
    ended = failed.result.outcome
    if ended not in (NO_LENGTH, CANCELLED):
        times, states, _ = last_known(problem, failed)
        fading = fading_length(problem, times, states)
        if fading is not None:
            return outcome_of(NO_LENGTH, told | {"name": fading[:MOST]})
    vanishing = vanishing_margin(problem, failed) if ended in WITHOUT_VALUE else None
    return None if vanishing is None else Outcome("singular", "singular", told | {"name": vanishing[:MOST]})


def _unseen(best: Attempt, step: float | None, told: dict[str, Number]) -> Outcome | None:
    """Steps that stayed too long to see what the forces do, chosen here or given."""
    if best.blind:
        first = best.blind[0]
        return Outcome("unresolved", "unresolved", told | {"t": short(first.start), "step": short(first.step)})
    if best.too_long is None:
        return None
    needed = {"t": short(best.too_long.start), "step": short(step or 0.0), "needed": short(best.too_long.step)}
    return Outcome("step_blind", "step_blind", told | needed)


def _ended(best: Attempt, told: dict[str, Number]) -> Outcome:
    """An event, with the error of its time where that can be seen in the digits told, or a doubtful one."""
    if best.doubtful is not None:
        return Outcome("event", "event_doubtful", told)
    error = 0.0 if best.estimate is None else best.estimate.event or 0.0
    precise = told | {"t": short(best.reached, 6)}
    if error <= SMALL * best.reached:
        return Outcome("event", "event", precise)
    return Outcome("event", "event_timed", precise | {"error": short(error, 2)})


def _grown(problem: Problem, method: Method, step: float, told: dict[str, Number]) -> Outcome:
    """A motion that grew beyond all bounds: because the step is outside of the region of stability, or by itself."""
    bound = largest_stable_step(method.scheme, eigenvalues(problem, 0.0, problem.state[: 2 * problem.degrees]))
    if 0.0 < bound < step:
        return Outcome("diverged", "unstable_step", told | {"step": short(step), "bound": short(bound)})
    return outcome_of(TOO_LARGE, told)
