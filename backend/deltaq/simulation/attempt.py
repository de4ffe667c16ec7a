"""Runs at one resolution, and how resolutions are refined until the wanted accuracy is there or cannot be had."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .estimate import Estimate, estimate
from .event import Happening
from .integration import Flag
from .kernels.motion import CANCELLED, STEP_LIMIT, STIFF
from .method import Method
from .problem import Floats, Problem
from .refinement import Refinement
from .run import Run, Steps, run
from .side_by_side import side_by_side

TRIES = 6
BRIEF = 5_000  # right-hand sides; fewer take less time than a second thread needs to begin


@dataclass(frozen=True)
class Attempt:
    """Runs at one resolution: the one to return, and what comparing it with the other says."""

    chosen: Run
    runs: tuple[Run, ...]
    estimate: Estimate | None

    @property
    def is_complete(self) -> bool:
        """Whether all runs came to the end, or all to the same event, and it is sure which."""
        return all(run.is_complete for run in self.runs) and self.doubtful is None

    @property
    def doubtful(self) -> Happening | None:
        """An event of which it is not sure that it happened."""
        return None if self.estimate is None else self.estimate.doubtful

    @property
    def reached(self) -> float:
        """How far the motion is what the scene means: up to an event, or to where one is doubtful."""
        if self.is_complete:
            return float(self.chosen.result.reached)
        ends = [run.result.reached for run in self.runs]
        return float(min(ends if self.doubtful is None else [*ends, self.doubtful.time]))


@dataclass(frozen=True)
class Work:
    """A problem and a method, with the times at which errors are compared."""

    problem: Problem
    method: Method
    refinement: Refinement
    times: Floats
    cancelled: Flag

    def _run(self, steps: Steps) -> Run:
        return run(self.problem, self.method, self.times, self.cancelled, steps)

    def coarse(self, step: float) -> Attempt:
        """One run, without an estimate of its error."""
        only = self._run(self.refinement.pair(step)[0])
        return Attempt(only, (only,), None)

    def fine(self, tolerance: float) -> Attempt:
        """One run that should meet the tolerance, without an estimate of its error."""
        only = self._run(self.refinement.pair(self.refinement.first(tolerance))[1])
        return Attempt(only, (only,), None)

    def pair(self, resolution: float, *, returns_fine: bool) -> Attempt:
        """Two runs compared."""
        how = self.refinement
        coarse, fine = self._both(*how.pair(resolution))
        factor = how.factor_of_fine if returns_fine else how.factor_of_coarse
        found = estimate(self.problem, coarse, fine, factor)
        return Attempt(fine if returns_fine else coarse, (coarse, fine), found)

    def _both(self, coarse: Steps, fine: Steps) -> tuple[Run, Run]:
        """Two runs; side by side if they may take a while, for kernels hold no lock."""
        if coarse.tolerance == 0.0 and self.problem.t_end / fine.size * self.method.tableau.stages < BRIEF:
            return self._run(coarse), self._run(fine)
        of_fine, of_coarse = side_by_side(lambda: self._run(fine), lambda: self._run(coarse))
        return of_coarse, of_fine

    def until(self, tolerance: float) -> list[Attempt]:
        """Pairs of runs, finer and finer, until the error is below the tolerance or refining does not help."""
        resolution = self.refinement.first(tolerance)
        attempts = [self.pair(resolution, returns_fine=True)]
        while len(attempts) < TRIES and _can_improve(attempts[-1], tolerance, self.problem):
            if self.refinement.is_finest(resolution):
                break
            before, resolution = resolution, self.refinement.next(resolution, _excess(attempts[-1], tolerance))
            part = self.refinement.least_part(before, resolution)
            attempts.append(self._at_least(part, attempts[-1], self.pair(resolution, returns_fine=True)))
        return attempts

    def _at_least(self, part: float, before: Attempt, found: Attempt) -> Attempt:
        """The attempt, its errors not smaller than that part of the ones before."""
        if part == 0.0 or before.estimate is None or found.estimate is None:
            return found
        short = part * before.estimate.worst / found.estimate.worst
        if not 1.0 < short < np.inf:
            return found
        coarse, fine = found.runs
        factor = short * self.refinement.factor_of_fine
        return replace(found, estimate=estimate(self.problem, coarse, fine, factor))


def _excess(attempt: Attempt, tolerance: float) -> float:
    """How many times too large the error is; without limit if the runs did not even come to the end."""
    return attempt.estimate.worst / tolerance if attempt.is_complete and attempt.estimate else np.inf


def _can_improve(attempt: Attempt, tolerance: float, problem: Problem) -> bool:
    is_reached = attempt.estimate is not None and attempt.estimate.worst <= tolerance
    is_cut_short = any(run.result.outcome in (STEP_LIMIT, CANCELLED, STIFF) for run in attempt.runs)
    steps = max(run.result.steps + run.result.rejected for run in attempt.runs)
    return not (is_reached and attempt.is_complete) and not is_cut_short and 2 * steps < problem.step_limit
