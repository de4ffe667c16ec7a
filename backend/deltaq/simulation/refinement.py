"""How to run a method finer: a smaller local tolerance where it has step control, else a smaller step."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from .method import Series
from .pieces import Pieces
from .run import Run, Steps

FINEST_TOLERANCE = 1e-14  # of the coarser run of a pair; below, rounding rules
COARSEST_TOLERANCE = 3e-4  # of the coarser run; with more, its error says little of that of the finer one
# In the first try with a fixed step. Samples are a few hundred, as a rule a round number: steps that end at all of them
# would hide from the pair how wrong the finer run is inside its steps. Of these, as many to a sample are never whole.
FIRST_STEPS: float = 200.0 * (5.0**0.5 - 1.0)
USUAL_TOLERANCE = 1e-3
UNFINISHED = 0.25  # the step over that of a run that did not come to the end
RATIO: float = 3.0 + 0.5**0.5  # of the steps of a pair, below order 5
HIGH = 5  # the least order of methods whose pairs are FINER apart
FINER: float = 1.5 + 1.0 / 3.0**0.5  # the ratio where the coarser steps are given, and the finer run tells their error
NEAREST: float = 4.0 / 3.0**0.5 - 0.25
FARTHEST = 6.0  # what the ratio may be where a run is compared with one before
SHRINK = 2.15  # of adaptive steps from the coarser run of a pair to the finer
OFTEN = 3.0  # times as many steps as the longest would be: then they are rarely the longest
CLOSEST, FARTHEST_TOLERANCE = 10.0, 110.0  # between these the tolerances of a pair are apart
BEYOND = 30.0  # the local tolerance of the finer run of a pair over that of a third one
MARGIN = 14.0  # how far errors may fall short of shrinking as the theory says
ACROSS = 2.0  # the same from one attempt to a later one, between which chance evens out
LEAST_PART = 0.3  # of how far tolerances are apart, where a run is compared with one before
GRAIN = 1e-13  # below, rounding has its part in what a tolerance does
FIRST, LAST = 0, -1  # runs of a pair, the coarser one first
APART = 1.2  # the largest steps of a coarser series over those of the finer one
BELOW = 1e-3  # the local tolerance of a finer series over that of the coarser one
AHEAD = 1e-2  # that of a first series over the tolerance; ten times less costs but one order more
LARGEST_PART = 0.05  # that of a first series over the tolerance at most
GRAIN_OF_SERIES, AMONG_ROUNDING = 2e-12, 4.0  # below that local tolerance a nudge may do as much as the steps
FINEST_OF_SERIES, FINER_THAN_FINEST = 1e-15, 1e-16  # below, rounding rules
LARGEST_OF_SERIES = 0.05  # the largest step of the coarser one over the span
LARGEST_STEP = 0.01  # of the span, so that a motion that begins at rest does not jump over what comes later


class Refinement(Protocol):
    """`resolution` is whatever the method is refined by; `pair` is how to step for two runs that can be compared.

    The factors turn the difference of the two runs into an estimate of the error of either.
    """

    @property
    def factor_of_coarse(self) -> float:
        """What the difference of two runs is multiplied by to estimate the error of the coarser one."""

    @property
    def factor_by_third(self) -> float:
        """The same for the finer run of a pair, by its difference from a third one."""

    @property
    def answer(self) -> int:
        """Which run of a pair is the answer, FIRST or LAST."""

    def factor_of_answer(self, coarse: Steps, fine: Steps) -> float:
        """What their difference is multiplied by to estimate the error of that one."""

    def factor_across(self, coarse: Steps, fine: Steps) -> float:
        """The same for a coarser run of an attempt before, which may be any number of times as coarse."""

    def can_compare(self, coarse: Run, fine: Steps) -> bool:
        """Whether a run and a finer one are far enough apart, but not too far, for an estimate."""
        ...

    def of_fine(self, pieces: Pieces) -> Pieces:
        """The pieces for the finer run of a pair, by those for the coarser one."""
        ...

    def least_part(self, before: float, resolution: float) -> float:
        """How much of the error with the resolution before is left with this one at least; 0 if the runs tell."""
        ...

    def finer(self, pieces: Pieces, before: float, resolution: float) -> Pieces:
        """The pieces for runs with another resolution than before."""
        ...

    def first(self, tolerance: float) -> float:
        """The resolution to begin with."""

    def pair(self, resolution: float, pieces: Pieces, /) -> tuple[Steps, Steps]:
        """How to step for the coarser and the finer run at a resolution."""

    def beyond(self, fine: Steps) -> Steps | None:
        """How to step for a third run, still finer than a pair; None where no third one says more."""

    def next(self, resolution: float, excess: float) -> float:
        """The next resolution, where the error was `excess` times too large."""

    def is_finest(self, resolution: float) -> bool:
        """Whether there is no finer resolution."""


@dataclass(frozen=True)
class ByTolerance:
    """Adaptive methods. The error is about proportional to the local tolerance, and that to h^k, k = `error_order`.

    The tolerances of two runs are as far apart as it takes for steps that differ by about SHRINK; their difference is
    the error of the coarser one. Next to the finest tolerance it is not: there rounding has its part, as large in both
    runs and in some ways the same (that of a constant of the model, say), and chaos magnifies it. An error that falls
    faster there than the tolerance does so by chance. Tolerances stay close, too, where fast forces bound the steps.
    """

    t_end: float
    error_order: int
    factor_of_coarse: float = 1.35
    factor_by_third: float = 2.0
    answer: int = LAST

    def factor_of_answer(self, coarse: Steps, fine: Steps) -> float:
        return min(MARGIN * fine.tolerance / coarse.tolerance, self.factor_of_coarse)

    def factor_across(self, coarse: Steps, fine: Steps) -> float:
        return min(ACROSS * fine.tolerance / coarse.tolerance, self.factor_of_coarse)

    def _apart(self, fine: float) -> float:
        """How many times the tolerance of the finer run the coarser one gets."""
        if fine < GRAIN:
            return CLOSEST
        return float(max(min(SHRINK**self.error_order, FARTHEST_TOLERANCE, COARSEST_TOLERANCE / fine), CLOSEST))

    def can_compare(self, coarse: Run, fine: Steps) -> bool:
        """Not where steps are often as long as they may be, for then they are as long in the finer run."""
        steps = coarse.steps
        if _is_bounded(steps):
            return False
        is_free = coarse.result.steps * steps.size > OFTEN * self.t_end
        apart = self._apart(fine.tolerance)
        return is_free and LEAST_PART * apart <= steps.tolerance / fine.tolerance <= 10.0 * apart

    def of_fine(self, pieces: Pieces) -> Pieces:
        return pieces.scaled(1.0 / SHRINK)

    def least_part(self, before: float, resolution: float) -> float:
        return resolution / before if resolution < 10.0 * FINEST_TOLERANCE else 0.0

    def finer(self, pieces: Pieces, _before: float, _resolution: float) -> Pieces:
        return pieces

    def first(self, tolerance: float) -> float:
        return max(0.1 * tolerance, FINEST_TOLERANCE)

    def pair(self, resolution: float, pieces: Pieces) -> tuple[Steps, Steps]:
        """Two local tolerances, and two largest steps: where these rule, the tolerance does not tell the runs apart."""
        largest, fine = LARGEST_STEP * self.t_end, 0.1 * resolution
        apart = self._apart(fine) if pieces.is_whole else CLOSEST
        return Steps(largest, apart * fine), Steps(float(largest / apart ** (1.0 / self.error_order)), fine)

    def beyond(self, fine: Steps) -> Steps | None:
        part = float(BEYOND ** (-1.0 / self.error_order))
        pieces = None if fine.pieces is None else fine.pieces.scaled(part)
        return Steps(part * fine.size, fine.tolerance / BEYOND, pieces)

    def next(self, resolution: float, excess: float) -> float:
        """A tolerance by what is still missing, far enough for this pair's finer run to be the next one's coarser."""
        far = resolution / (1.01 * LEAST_PART * self._apart(0.1 * resolution))
        return max(min(resolution * max(0.3 / excess, 1e-4), far), FINEST_TOLERANCE)

    def is_finest(self, resolution: float) -> bool:
        return resolution <= FINEST_TOLERANCE


@dataclass(frozen=True)
class BySeries:
    """Taylor series. The coarser run is the answer, for its error is what the difference of the two runs says.

    No factor leads from there to the error of the finer one: local errors of series turn their sign nearly from step to
    step, so that their sums are as by chance. Being so much finer costs but an order or two.

    The finer run is nudged by some units in the last place. Either the steps of the coarser one err by far more than
    that, or, with the finest tolerance, by far less: in between both errors may be equal, and their difference nothing.
    """

    t_end: float
    scheme: Series
    ahead: float = AHEAD
    below: float = BELOW
    factor_of_coarse: float = 2.0
    factor_by_third: float = 2.0
    answer: int = FIRST

    def factor_of_answer(self, coarse: Steps, _fine: Steps) -> float:
        return AMONG_ROUNDING if coarse.tolerance < GRAIN_OF_SERIES else self.factor_of_coarse

    def factor_across(self, coarse: Steps, fine: Steps) -> float:
        return self.factor_of_answer(coarse, fine)

    @staticmethod
    def _told_apart(resolution: float) -> float:
        """The largest local tolerance up to that at which a nudge cannot hide what the steps do."""
        return resolution if resolution >= GRAIN_OF_SERIES else FINEST_OF_SERIES

    def can_compare(self, _coarse: Run, _fine: Steps) -> bool:
        return False

    def of_fine(self, pieces: Pieces) -> Pieces:
        return pieces.scaled(1.0 / APART)

    def least_part(self, _before: float, _resolution: float) -> float:
        return 0.0

    def finer(self, pieces: Pieces, _before: float, _resolution: float) -> Pieces:
        return pieces

    def first(self, tolerance: float) -> float:
        return self._told_apart(max(self.ahead * tolerance, min(LARGEST_PART * tolerance, GRAIN_OF_SERIES)))

    def pair(self, resolution: float, _pieces: Pieces) -> tuple[Steps, Steps]:
        largest, finer = LARGEST_OF_SERIES * self.t_end, max(self.below * resolution, FINER_THAN_FINEST)
        coarse = Steps(largest, resolution, order=self.scheme.order_for(resolution))
        return coarse, Steps(largest / APART, finer, order=self.scheme.order_for(finer))

    def beyond(self, _fine: Steps) -> Steps | None:
        return None

    def next(self, resolution: float, excess: float) -> float:
        return self._told_apart(resolution * max(0.1 / excess, 1e-6))

    def is_finest(self, resolution: float) -> bool:
        return resolution <= FINEST_OF_SERIES


@dataclass(frozen=True)
class ByStep:
    """Fixed steps. The error is proportional to h^p (Richardson); runs are so far apart that it falls about 100 times.

    Farther apart, the difference would say less of the finer one: while h is not small enough, errors fall faster or
    less fast by powers of the ratio. That is irrational, so that the two runs have no step in common: what is in step
    with one is not with the other. The factors below are those of 2, which is on the safe side. Where forces bend or
    jump along the way, `sure` is 1: a step across such a place is of first order, whatever the method.
    """

    t_end: float
    order: int
    step_limit: int
    sure: int
    answer: int = LAST

    @property
    def factor_of_coarse(self) -> float:
        return float(2.5 * FINER**self.sure / (FINER**self.sure - 1))

    @property
    def factor_by_third(self) -> float:
        return self.factor_of_coarse

    def factor_of_answer(self, coarse: Steps, fine: Steps) -> float:
        return float(max(0.03, self.factor_across(coarse, fine)))

    def factor_across(self, coarse: Steps, fine: Steps) -> float:
        return float(4.5 / (_ratio(coarse, fine) ** self.sure - 1))

    def can_compare(self, coarse: Run, fine: Steps) -> bool:
        steps = coarse.steps
        return not _is_bounded(steps) and NEAREST <= _ratio(steps, fine) <= FARTHEST

    def of_fine(self, pieces: Pieces) -> Pieces:
        return pieces

    def least_part(self, _before: float, _resolution: float) -> float:
        return 0.0

    def finer(self, pieces: Pieces, before: float, resolution: float) -> Pieces:
        return pieces.scaled(resolution / before)

    def first(self, tolerance: float) -> float:
        guess = float((tolerance / USUAL_TOLERANCE) ** (1.0 / self.order))
        return self.t_end / FIRST_STEPS * min(max(guess, 0.1), 1.0)

    def pair(self, resolution: float, _pieces: Pieces) -> tuple[Steps, Steps]:
        return Steps(resolution), Steps(resolution, ratio=self._apart)

    def beyond(self, fine: Steps) -> Steps | None:
        pieces = None if fine.pieces is None else fine.pieces.scaled(1.0 / FINER)
        return Steps(fine.size, pieces=pieces, ratio=FINER * fine.ratio)

    def next(self, resolution: float, excess: float) -> float:
        shrink = float((0.5 / excess) ** (1.0 / self.order)) if excess < np.inf else UNFINISHED
        return max(resolution * min(max(shrink, 0.02), 1.0 / NEAREST), self._finest)

    def is_finest(self, resolution: float) -> bool:
        return resolution <= self._finest

    @property
    def _finest(self) -> float:
        """The finer run of the pair must end within the step limit."""
        return 1.005 * self._apart * self.t_end / self.step_limit

    @property
    def _apart(self) -> float:
        """The ratio of the steps of a pair."""
        return RATIO if self.order < HIGH else FINER


def _is_bounded(steps: Steps) -> bool:
    """Whether pieces bound the steps of a run: a finer one may then take the same steps somewhere."""
    return steps.pieces is not None and not steps.pieces.is_whole


def _ratio(coarse: Steps, fine: Steps) -> float:
    """Of fixed steps."""
    return coarse.size / coarse.ratio * fine.ratio / fine.size
