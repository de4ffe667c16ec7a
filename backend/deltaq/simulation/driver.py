"""From a problem to a trajectory: runs, compares, refines until the wanted accuracy is there or cannot be had.

`tolerance` is the wanted error of the returned coordinates at every sample (global), not that of a step.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .estimate import Estimate, estimate
from .integration import Flag
from .kernels.motion import CANCELLED, FINE, STEP_LIMIT, STIFF, TOO_LARGE
from .method import Method
from .outcome import OK, Number, Outcome, outcome_of
from .problem import Floats, Problem
from .refinement import ByStep, ByTolerance, Refinement
from .run import Run, Steps, run
from .stability import largest_stable_step
from .stiffness import eigenvalues
from .trajectory import Cost, Trajectory

TRIES = 6
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
    """The motion of a problem with a fixed step, or to a tolerance (exactly one of the two is given)."""
    if (step is None) == (tolerance is None):
        raise ValueError("give either a step or a tolerance")
    flag = np.zeros(1, dtype=np.int64) if cancelled is None else cancelled
    work = _Work(problem, method, _refinement(problem, method, tolerance), _grid(problem), flag)
    if step is not None:
        attempts = [work.pair(step, returns_fine=False) if with_error else work.coarse(step)]
    else:
        attempts = work.until(tolerance or 0.0) if with_error else [work.fine(tolerance or 0.0)]
    return _trajectory(problem, method, attempts, tolerance, step)


def _refinement(problem: Problem, method: Method, tolerance: float | None) -> Refinement:
    if tolerance is not None and method.is_adaptive:
        return ByTolerance(problem.t_end)
    return ByStep(problem.t_end, method.order, problem.step_limit)


def _grid(problem: Problem) -> Floats:
    """The sample times, and as many between them as it takes to see the error."""
    refined = -(-LEAST_SAMPLES // (problem.samples - 1))
    return np.linspace(0.0, problem.t_end, refined * (problem.samples - 1) + 1)


@dataclass(frozen=True)
class _Attempt:
    """Runs at one resolution: the one to return, and what comparing it with the other says."""

    chosen: Run
    runs: tuple[Run, ...]
    estimate: Estimate | None

    @property
    def is_complete(self) -> bool:
        return all(run.is_complete for run in self.runs)


@dataclass(frozen=True)
class _Work:
    problem: Problem
    method: Method
    refinement: Refinement
    times: Floats
    cancelled: Flag

    def _run(self, steps: Steps) -> Run:
        return run(self.problem, self.method, self.times, self.cancelled, steps)

    def coarse(self, step: float) -> _Attempt:
        """One run, without an estimate of its error."""
        only = self._run(self.refinement.pair(step)[0])
        return _Attempt(only, (only,), None)

    def fine(self, tolerance: float) -> _Attempt:
        """One run that should meet the tolerance, without an estimate of its error."""
        only = self._run(self.refinement.pair(self.refinement.first(tolerance))[1])
        return _Attempt(only, (only,), None)

    def pair(self, resolution: float, *, returns_fine: bool) -> _Attempt:
        """Two runs compared."""
        how = self.refinement
        coarse, fine = (self._run(steps) for steps in how.pair(resolution))
        factor = how.factor_of_fine if returns_fine else how.factor_of_coarse
        found = estimate(self.problem, coarse, fine, factor)
        return _Attempt(fine if returns_fine else coarse, (coarse, fine), found)

    def until(self, tolerance: float) -> list[_Attempt]:
        """Pairs of runs, finer and finer, until the error is below the tolerance or refining does not help."""
        resolution = self.refinement.first(tolerance)
        attempts = [self.pair(resolution, returns_fine=True)]
        while len(attempts) < TRIES and _can_improve(attempts[-1], tolerance, self.problem):
            if self.refinement.is_finest(resolution):
                break
            resolution = self.refinement.next(resolution, _excess(attempts[-1], tolerance))
            attempts.append(self.pair(resolution, returns_fine=True))
        return attempts


def _excess(attempt: _Attempt, tolerance: float) -> float:
    """How many times too large the error is; without limit if the runs did not even come to the end."""
    return attempt.estimate.worst / tolerance if attempt.is_complete and attempt.estimate else np.inf


def _can_improve(attempt: _Attempt, tolerance: float, problem: Problem) -> bool:
    is_reached = attempt.estimate is not None and attempt.estimate.worst <= tolerance
    is_cut_short = any(run.result.outcome in (STEP_LIMIT, CANCELLED, STIFF) for run in attempt.runs)
    steps = max(run.result.steps + run.result.rejected for run in attempt.runs)
    return not (is_reached and attempt.is_complete) and not is_cut_short and 2 * steps < problem.step_limit


def _trajectory(
    problem: Problem, method: Method, attempts: list[_Attempt], tolerance: float | None, step: float | None
) -> Trajectory:
    best = max(attempts, key=_merit)
    chosen, n = best.chosen, problem.degrees
    count = len(best.estimate.errors) if best.estimate else len(chosen.times)
    every = (len(_grid(problem)) - 1) // (problem.samples - 1)
    shown = slice(0, count, every)
    found = replace(best.estimate, errors=best.estimate.errors[shown]) if best.estimate else None
    is_reached = None if tolerance is None or found is None else found.worst <= tolerance and best.is_complete
    states = chosen.states[shown]
    return Trajectory(
        method.id,
        _outcome(problem, method, best, tolerance, step),
        chosen.times[shown],
        states[:, :n],
        states[:, n : 2 * n],
        states[:, 2 * n] if states.shape[1] > 2 * n else np.zeros(len(states)),
        found,
        is_reached,
        _reached(best),
        min(run.conditioning for run in best.runs),
        _cost(attempts, chosen),
    )


def _merit(attempt: _Attempt) -> tuple[float, bool, float]:
    """What is right for longer comes first, then what is complete, then what is more accurate."""
    found = attempt.estimate
    worst = found.worst if found else 0.0
    horizon = np.inf if found is None or found.horizon is None else found.horizon
    return min(horizon, _reached(attempt)), attempt.is_complete, -worst


def _reached(attempt: _Attempt) -> float:
    return float(min(run.result.reached for run in attempt.runs))


def _cost(attempts: list[_Attempt], chosen: Run) -> Cost:
    runs = [run for attempt in attempts for run in attempt.runs]
    return Cost(
        int(chosen.result.steps),
        int(chosen.result.rejected),
        int(sum(run.result.evaluations for run in runs)),
        sum(run.wall_time for run in runs),
        len(runs),
        chosen.wall_time,
        int(chosen.result.evaluations),
    )


def _outcome(problem: Problem, method: Method, best: _Attempt, tolerance: float | None, step: float | None) -> Outcome:
    """The status: how the run ended, else what the error estimate says."""
    told: dict[str, Number] = {"method": method.id, "t": _short(_reached(best)), "t_end": problem.t_end}
    ended = next((run for run in (best.chosen, *best.runs) if run.result.outcome != FINE), None)
    if ended is not None:
        steps = int(ended.result.steps + ended.result.rejected)
        if step is not None and ended.result.outcome == TOO_LARGE:
            return _grown(problem, method, step, told)
        return outcome_of(int(ended.result.outcome), told | {"steps": steps})
    if best.estimate is None:
        return OK
    if best.estimate.horizon is not None:
        return Outcome("horizon_reached", "horizon_reached", told | {"t": _short(best.estimate.horizon)})
    if tolerance is not None and best.estimate.worst > tolerance:
        parameters = told | {"tolerance": tolerance, "error": _short(best.estimate.worst)}
        return Outcome("tolerance_missed", "tolerance_missed", parameters)
    return OK


def _grown(problem: Problem, method: Method, step: float, told: dict[str, Number]) -> Outcome:
    """A motion that grew beyond all bounds: because the step is outside of the region of stability, or by itself."""
    bound = largest_stable_step(method.tableau, eigenvalues(problem, 0.0, problem.state[: 2 * problem.degrees]))
    if 0.0 < bound < step:
        return Outcome("diverged", "unstable_step", told | {"step": _short(step), "bound": _short(bound)})
    return outcome_of(TOO_LARGE, told)


def _short(number: float) -> float:
    return float(f"{number:.3g}")
