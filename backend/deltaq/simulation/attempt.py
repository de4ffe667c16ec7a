"""Runs at one resolution, and their refinement until the wanted accuracy is reached or refining does not help."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache, cached_property, partial

import numpy as np

from ..model.modes import Modes
from .audit import USUAL, Audit
from .estimate import Estimate, estimate, larger, rounding_matters, says_more, with_rounding
from .event import EventOccurrence
from .hybrid import run_on
from .integration import Flag
from .kernels.motion import CANCELLED, LOCKED, MANY_EVENTS, NEWTON_FAILED, SINGULAR, STEP_LIMIT, STIFF, UNSETTLED
from .method import Method
from .mode_state import ModeState
from .outcome import CHATTERS, NO_DIRECTION, NO_LENGTH, OUT_OF_REACH, SLIDES, UNDETERMINED
from .pieces import BlindStretch, Pieces
from .problem import Floats, Problem
from .refinement import FINER, LAST, Refinement
from .run import Run, Steps, run
from .side_by_side import side_by_side
from .transitions import begun, with_signs

TRIES = 6
LOOSE = 1e-5  # a tolerance from which on two runs that seem to meet it are compared with a third
MOST_BEYOND = 4.0  # times the steps of a run: more than the third one takes
ROUNDS = 4  # of shorter steps where a run was blind
BY_EVENTS = 0.5  # of the difference, where a motion goes on behind events
BY_IMPACTS = 1.0  # times the differences of runs that are shaken otherwise
UNSOLVED = (NEWTON_FAILED, LOCKED, SINGULAR, NO_LENGTH)
# How the motion goes on behind an event.
UNCLEAR = (UNSETTLED, NO_DIRECTION, UNDETERMINED, SLIDES, CHATTERS, MANY_EVENTS)
SAME_EVENT = 1e-4  # of the time: of events that pile up not all runs follow as many
SAME_PLACE = 1e-6  # of the time: runs that end so close to each other end at the same place
ORDERS = 4  # more for each finer run with steps that are given
BRIEF = 5_000  # right-hand sides; fewer take less time than a second thread needs to begin


@dataclass(frozen=True)
class Attempt:
    """Runs at one resolution: the one to return, and the error estimate from comparing it with the other.

    `blind` are the stretches on which the finer run stayed blind; `too_long` is the first stretch for which a step
    given by the user is too long. `discarded` are runs that were repeated because they had been blind. `is_shared` says
    that the coarser run is that of the attempt before.
    """

    chosen: Run
    runs: tuple[Run, ...]
    estimate: Estimate | None
    blind: tuple[BlindStretch, ...] = ()
    too_long: BlindStretch | None = None
    discarded: tuple[Run, ...] = ()
    is_shared: bool = False

    @property
    def own(self) -> tuple[Run, ...]:
        """All runs that were made for this attempt."""
        return (*self.runs[1 if self.is_shared else 0 :], *self.discarded)

    @property
    def is_complete(self) -> bool:
        """Whether all runs reached the end, or all the same event, and no event is doubtful."""
        return all(run.is_complete for run in self.runs) and self.doubtful is None

    @property
    def seen_until(self) -> float:
        """The time in seconds from which on the finer run was blind; infinite if it nowhere was."""
        return min((each.start for each in self.blind), default=np.inf)

    @property
    def doubtful(self) -> EventOccurrence | None:
        """An event that may or may not have happened, as far as the errors tell."""
        return None if self.estimate is None else self.estimate.doubtful

    @property
    def reached(self) -> float:
        """The time in seconds up to which the motion counts: to its end, an event, or a doubtful event."""
        if self.is_complete:
            return float(self.chosen.result.reached)
        ends = [run.result.reached for run in self.runs]
        return float(min(ends if self.doubtful is None else [*ends, self.doubtful.time]))


@dataclass(frozen=True)
class Integrator:
    """A problem and a method: runs at one resolution, and their refinement until the tolerance is met.

    `times`, shape (samples,), are those at which errors are compared, in seconds; without a tolerance it is infinite.
    """

    problem: Problem
    method: Method
    refinement: Refinement
    times: Floats
    cancelled: Flag
    tolerance: float
    modes: Modes | None = None
    judged: Problem | None = None  # the problem outside of all modes

    def _run(self, steps: Steps) -> Run:
        if self.modes is not None:
            return run_on(self.problem, self.modes, self.method, self.times, self.cancelled, steps, begin=self._begin)
        return run(self.problem, self.method, self.times, self.cancelled, steps)

    def _finer(self, steps: Steps) -> Run:
        """The finer run of a pair.

        One that only tells the error of the other is nudged, so that what rounding does to both alike shows in their
        difference.
        """
        is_answer = self.refinement.answer == LAST or steps.tolerance == 0.0
        if is_answer:
            return self._run(steps)
        return self._run(replace(steps, is_nudged=True) if self.modes is None else replace(steps, shaken=1))

    @property
    def _shaken(self) -> int:
        """The pattern by which the run of a pair that is not the answer is shaken."""
        return 0 if self.modes is None else 1

    @cached_property
    def _begin(self) -> Callable[[float], ModeState] | None:
        """The start in its mode by what counts as closed (`begun`): no run changes it, most have the same."""
        return None if self.modes is None else cache(partial(begun, self.problem, self.modes))

    @property
    def judge(self) -> Problem:
        """The problem by which errors are measured."""
        return self.judged or self.problem

    def coarse(self, step: float) -> Attempt:
        """One run with a fixed step in seconds, without an error estimate."""
        only = self._run(Steps(step))
        return Attempt(only, (only,), None)

    def fine(self) -> Attempt:
        """One run that should meet the tolerance, without an error estimate."""
        pieces = self.audit.before(self.tolerance)
        answer = self.refinement.pair(self.refinement.first(self.tolerance), pieces)[self.refinement.answer]
        only = self._run(replace(answer, pieces=pieces))
        return Attempt(only, (only,), None)

    @cached_property
    def audit(self) -> Audit:
        """What the method can see of the problem."""
        return Audit(self.problem if self.modes is None else with_signs(self.problem, self.modes), self.method)

    def given(self, step: float) -> Attempt:
        """The run with the step given by the user, compared with a finer run that the audit finds nowhere blind."""
        whole = Pieces.whole(self.problem.t_end)

        def compared(pieces: Pieces) -> Attempt:
            fine = Steps(step, pieces=pieces, ratio=FINER, is_recorded=True, order=self._order(1), shaken=self._shaken)
            runs = self._both(Steps(step, pieces=whole), fine)
            return Attempt(runs[0], runs, self._estimated(*runs, self.refinement.factor_of_coarse))

        found, pieces = self._seen(self.audit.before(USUAL), compared)
        if not pieces.is_whole or self._is_cut:
            found = self._confirmed(found, step, pieces)
        worst = USUAL if found.estimate is None else found.estimate.worst
        return replace(found, too_long=self.audit.before(worst).needed_by(step))

    def _confirmed(self, found: Attempt, step: float, pieces: Pieces) -> Attempt:
        """The attempt, its finer run held against a third.

        Where pieces bound its steps, nothing says that it is right; and where forces jump along the way, or events
        happen there, both runs may come there at the same part of a step and be wrong alike.
        """
        fine = found.runs[-1]
        ratio = FINER**2 if pieces.is_whole else FINER
        finer = Steps(
            step, pieces=pieces.scaled(1.0 / FINER), ratio=ratio, order=self._order(2), shaken=2 * self._shaken
        )
        third = self._run(finer)
        if found.estimate is None or not third.is_complete:
            return found
        of_given = estimate(self.judge, found.chosen, third, self.refinement.factor_of_coarse)
        of_fine = estimate(self.judge, fine, third, self.refinement.factor_of_coarse)
        return replace(found, estimate=larger(of_given, of_fine), discarded=(*found.discarded, third))

    def _order(self, finer: int) -> int | None:
        """The order of a finer run with given steps, of a method whose order may be chosen.

        A series ends where a force jumps or an event happens, however long its step: between two of them that lie
        closer together than steps, runs of one order err alike.
        """
        return self.method.order + finer * ORDERS if self._is_cut else None

    @property
    def _is_cut(self) -> bool:
        """Whether forces jump or bend along the way, or events happen there."""
        return self.modes is not None or self.problem.model.tape.has_choices

    def _estimated(self, coarse: Run, fine: Run, factor: float) -> Estimate | None:
        """The error by two runs; None where one of them has not even a first sample."""
        return estimate(self.judge, coarse, fine, factor) if len(coarse.times) and len(fine.times) else None

    def pair(self, resolution: float, pieces: Pieces, before: Attempt | None = None) -> tuple[Attempt, Pieces]:
        """Two runs at a resolution, and the pieces in which the finer one was nowhere blind.

        The coarser one is the best of the attempt before where the two can be compared.
        """
        coarse, fine = self.refinement.pair(resolution, pieces)
        known = None if before is None or self.modes is not None else self._comparable(before, fine)

        def compared(pieces: Pieces) -> Attempt:
            of_fine = replace(fine, pieces=self.refinement.of_fine(pieces), is_recorded=True)
            of_coarse = replace(coarse, pieces=pieces, shaken=self._shaken if self.refinement.answer == LAST else 0)
            runs = self._both(of_coarse, of_fine) if known is None else (known, self._finer(of_fine))
            factor, answer = self._factor(*runs), self.refinement.answer
            return Attempt(runs[answer], runs, self._estimated(*runs, factor), is_shared=known is not None)

        return self._seen(pieces, compared)

    def _factor(self, coarse: Run, fine: Run) -> float:
        """What the difference of a pair is multiplied by to estimate the error of the answer.

        Stretches between events have few steps, the first of which is guessed, and errors where events are found fall
        less fast than a tolerance.
        """
        factor = self.refinement.factor_of_answer(coarse.steps, fine.steps)
        return factor if self.modes is None else max(factor, BY_EVENTS)

    def _blind(self, fine: Run, tolerance: float) -> tuple[BlindStretch, ...]:
        """Where a run was blind, stretch by stretch in its mode if it went on behind events."""
        return (
            self.audit.after(fine, tolerance) if self.modes is None else self.audit.after_each(fine.meshes, tolerance)
        )

    def _comparable(self, before: Attempt, fine: Steps) -> Run | None:
        """The finer run of an attempt if it can stand for the coarser one of the next."""
        found = before.estimate
        is_good = before.is_complete and found is not None and found.horizon is None
        return before.chosen if is_good and self.refinement.can_compare(before.chosen, fine) else None

    def _seen(self, pieces: Pieces, compared: Callable[[Pieces], Attempt]) -> tuple[Attempt, Pieces]:
        """An attempt whose finer run was nowhere blind: made again with shorter steps wherever it was."""
        discarded: tuple[Run, ...] = ()
        for last in (False,) * (ROUNDS - 1) + (True,):
            found = compared(pieces)
            tolerance = min(self.tolerance, np.inf if found.estimate is None else found.estimate.worst)
            blind = self._blind(found.runs[-1], tolerance) or self._missed(found, tolerance)
            if last or not blind or not self.is_affordable(blind):
                break
            discarded += found.own
            pieces = pieces.with_bounds([(each.start, each.end, each.step) for each in blind])
        return replace(found, blind=blind, discarded=discarded), pieces

    def _missed(self, found: Attempt, tolerance: float) -> tuple[BlindStretch, ...]:
        """Where the coarser run of a pair was blind, if it went on behind more or fewer events than the finer one.

        Its steps are longer, and what the finer run saw may lie between their ends.
        """
        coarse, fine = found.runs[0], found.runs[-1]
        if len(coarse.meshes) == len(fine.meshes) or coarse.steps.tolerance == 0.0:
            return ()
        return self._blind(self._run(replace(coarse.steps, is_recorded=True)), tolerance)

    def rounded(self, found: Attempt) -> Attempt:
        """The attempt with an estimate no smaller than the effect of rounding.

        Where rounding may matter, one more run with a disturbed model measures it.
        """
        fine = found.runs[-1]
        if found.estimate is not None and any(each.kind == "impact" for each in found.chosen.transitions):
            found = self._with_impacts(found, found.estimate)
        if found.estimate is None or not rounding_matters(self.judge, fine, found.estimate):
            return found
        other = self._disturbed._run(replace(fine.steps, is_recorded=False))  # noqa: SLF001 - its own kind
        mended = with_rounding(self.judge, found.estimate, fine, other)
        return replace(found, estimate=mended, discarded=(*found.discarded, other))

    def _with_impacts(self, found: Attempt, known: Estimate) -> Attempt:
        """The attempt, its answer compared with the other run of the pair and with one that is shaken otherwise.

        Behind impacts neighbours part, and rounding with them; a single one may come back by chance, and errors that
        have grown stay.
        """
        third = self._run(replace(found.runs[-1].steps, is_recorded=False, shaken=2))
        if not len(third.times):
            return replace(found, discarded=(*found.discarded, third))
        for other in (third, *(each for each in found.runs if each is not found.chosen)):
            known = larger(known, estimate(self.judge, found.chosen, other, BY_IMPACTS))
        lasting = replace(known, errors=np.maximum.accumulate(known.errors))
        return replace(found, estimate=lasting, discarded=(*found.discarded, third))

    @property
    def _disturbed(self) -> Integrator:
        """The same with a disturbed model."""
        model = self.problem.model.disturbed
        modes = self.modes and replace(self.modes, model=model)
        return replace(self, problem=replace(self.problem, model=model), modes=modes)

    def is_affordable(self, blind: tuple[BlindStretch, ...]) -> bool:
        """Whether steps short enough for the blind stretches stay within the step limit."""
        return sum((each.end - each.start) / each.step for each in blind) < self.problem.step_limit

    def _both(self, coarse: Steps, fine: Steps) -> tuple[Run, Run]:
        """Two runs; side by side if they may take a while, for kernels hold no lock."""
        work = self.problem.t_end * fine.ratio * self.method.scheme.stages
        if self.modes is not None or (coarse.tolerance == 0.0 and work < BRIEF * fine.size):
            return self._run(coarse), self._finer(fine)
        of_fine, of_coarse = side_by_side(lambda: self._finer(fine), lambda: self._run(coarse))
        return of_coarse, of_fine

    def until(self) -> list[Attempt]:
        """Pairs of runs, finer and finer, until the estimate meets the tolerance or refining does not help."""
        resolution = self.refinement.first(self.tolerance)
        found, pieces = self.pair(resolution, self.audit.before(self.tolerance))
        attempts = [self._checked(found)]
        while len(attempts) < TRIES and _can_improve(attempts[-1], self.tolerance, self.problem):
            if self.refinement.is_finest(resolution):
                break
            before, resolution = resolution, self.refinement.next(resolution, _excess(attempts[-1], self.tolerance))
            part = self.refinement.least_part(before, resolution)
            found, pieces = self.pair(resolution, self.refinement.finer(pieces, before, resolution), attempts[-1])
            found = self._held_against(attempts[-1], self._at_least(part, attempts[-1], found))
            attempts.append(self._checked(found))
        return attempts

    def _checked(self, found: Attempt) -> Attempt:
        """The attempt, its answer compared with a third run where two that are coarse seem to be good enough.

        While steps are so long that errors do not fall as the order of a method says, no factor leads from the
        difference of two runs to the error of the finer one. The third is so much finer that it tells that error.
        """
        steps = self.refinement.beyond(found.chosen.steps) if self._is_to_be_checked(found) else None
        if steps is None:
            return found
        third, others = self._run(steps), found.runs[1 if found.is_shared else 0 : -1]
        if not third.is_complete:
            return replace(found, discarded=(*found.discarded, third))
        told = estimate(self.judge, found.chosen, third, self.refinement.factor_by_third)
        pair, discarded = (found.chosen, third), (*found.discarded, *others)
        return replace(found, runs=pair, estimate=told, discarded=discarded, is_shared=False)

    def _is_to_be_checked(self, found: Attempt) -> bool:
        """Whether two runs to a loose tolerance seem to meet it, and a third one stays within the step limit."""
        is_met = found.is_complete and found.estimate is not None and found.estimate.worst <= self.tolerance
        is_affordable = MOST_BEYOND * found.chosen.result.steps < self.problem.step_limit
        return is_met and is_affordable and self.tolerance >= LOOSE and self.modes is None

    def _held_against(self, before: Attempt, found: Attempt) -> Attempt:
        """The attempt, its answer held against the runs of the one before, too.

        Where steps are still so long that errors change their sign from one size to the next, the two runs of a pair
        may be wrong by about the same, and their difference says nothing of the error; a third one is not.
        """
        others = [each for each in before.runs if all(each is not own for own in found.runs)]
        if not self.judge.is_constrained or self.modes is not None or not before.is_complete:
            return found
        for other in others:
            factor, known = self.refinement.factor_across(other.steps, found.chosen.steps), found.estimate
            if known is not None and says_more(self.judge, other, found.chosen, factor, known):
                found = replace(found, estimate=larger(known, estimate(self.judge, other, found.chosen, factor)))
        return found

    def _at_least(self, part: float, before: Attempt, found: Attempt) -> Attempt:
        """The attempt, its errors not smaller than that part of the ones before."""
        if part == 0.0 or before.estimate is None or found.estimate is None:
            return found
        short = part * before.estimate.worst / found.estimate.worst
        if not 1.0 < short < np.inf:
            return found
        coarse, fine = found.runs
        factor = short * self._factor(coarse, fine)
        return replace(found, estimate=estimate(self.judge, coarse, fine, factor))


def _excess(attempt: Attempt, tolerance: float) -> float:
    """How many times too large the error is; without limit if the runs did not even come to the end."""
    return attempt.estimate.worst / tolerance if attempt.is_complete and attempt.estimate else np.inf


def _can_improve(attempt: Attempt, tolerance: float, problem: Problem) -> bool:
    is_reached = attempt.estimate is not None and attempt.estimate.worst <= tolerance
    is_cut_short = any(run.result.outcome in (STEP_LIMIT, OUT_OF_REACH, CANCELLED, STIFF) for run in attempt.runs)
    steps = max(run.result.steps + run.result.rejected for run in attempt.runs)
    # Finer runs would end there as well, where equations cannot be solved or nothing says what comes behind an event.
    is_stuck = _all_end(attempt, UNSOLVED, SAME_PLACE) or (is_reached and _all_end(attempt, UNCLEAR, SAME_EVENT))
    is_over = is_cut_short or is_stuck
    return not (is_reached and attempt.is_complete) and not is_over and 2 * steps < problem.step_limit


def _all_end(attempt: Attempt, outcomes: tuple[int, ...], apart: float) -> bool:
    """Whether all runs end in one of these ways, no further apart than that part of the time."""
    ends = [run.result.reached for run in attempt.runs]
    is_one = max(ends) - min(ends) <= apart * min(ends)
    return is_one and all(run.result.outcome in outcomes for run in attempt.runs)
