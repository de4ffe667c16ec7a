"""How to run a method finer: a smaller local tolerance where it has step control, else a smaller step."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from .pieces import Pieces
from .run import Steps

FINEST_TOLERANCE = 1e-14  # of the coarser run of a pair; below, rounding rules
FIRST_STEPS, USUAL_TOLERANCE = 200, 1e-3  # in the first try with a fixed step
UNFINISHED = 0.25  # the step over that of a run that did not come to the end
RATIO = 1.5 + 1.0 / 3.0**0.5  # of the steps of a pair
LARGEST_STEP = 0.01  # of the span, so that a motion that begins at rest does not jump over what comes later


class Refinement(Protocol):
    """`resolution` is whatever the method is refined by; `pair` is how to step for two runs that can be compared.

    The factors turn the difference of the two runs into an estimate of the error of either.
    """

    @property
    def factor_of_coarse(self) -> float: ...
    @property
    def factor_of_fine(self) -> float: ...
    def least_part(self, before: float, resolution: float) -> float:
        """How much of the error with the resolution before is left with this one at least; 0 if the runs tell."""
        ...

    def finer(self, pieces: Pieces, before: float, resolution: float) -> Pieces:
        """The pieces for runs with another resolution than before."""
        ...

    def first(self, tolerance: float) -> float: ...
    def pair(self, resolution: float) -> tuple[Steps, Steps]: ...
    def next(self, resolution: float, excess: float) -> float: ...
    def is_finest(self, resolution: float) -> bool: ...


@dataclass(frozen=True)
class ByTolerance:
    """Adaptive methods. The error is about proportional to the local tolerance; runs are a factor of 10 apart.

    The difference is the error of the coarse run; taken for the error of the fine one it is on the safe side. Next to
    the finest tolerance it is not: there rounding has its part, as large in both runs and in some ways the same (that
    of a constant of the model, say), and chaos magnifies it. An error that falls faster there than the tolerance does
    so by chance.
    """

    t_end: float
    factor_of_coarse: float = 1.15
    factor_of_fine: float = 1.15

    def least_part(self, before: float, resolution: float) -> float:
        return resolution / before if resolution < 10.0 * FINEST_TOLERANCE else 0.0

    def finer(self, pieces: Pieces, _before: float, _resolution: float) -> Pieces:
        return pieces

    def first(self, tolerance: float) -> float:
        return max(0.1 * tolerance, FINEST_TOLERANCE)

    def pair(self, resolution: float) -> tuple[Steps, Steps]:
        # Where the largest step rules, the tolerance does not tell the two runs apart; so it must differ, too.
        largest = LARGEST_STEP * self.t_end
        return Steps(largest, resolution), Steps(0.7 * largest, 0.1 * resolution)

    def next(self, resolution: float, excess: float) -> float:
        return max(resolution * min(max(0.3 / excess, 1e-4), 0.3), FINEST_TOLERANCE)

    def is_finest(self, resolution: float) -> bool:
        return resolution <= FINEST_TOLERANCE


@dataclass(frozen=True)
class ByStep:
    """Fixed steps. The error is proportional to h^p (Richardson); runs are a little more than a factor of 2 apart.

    The factor is irrational, so that the two runs have no step in common: what is in step with one is not with the
    other. The factors below are those of 2, which is on the safe side. Where forces bend or jump along the way, `sure`
    is 1: a step across such a place is of first order, whatever the method.
    """

    t_end: float
    order: int
    step_limit: int
    sure: int

    @property
    def factor_of_coarse(self) -> float:
        return float(1.8 * 2**self.sure / (2**self.sure - 1))

    @property
    def factor_of_fine(self) -> float:
        return float(max(0.1, 3.0 / (2**self.sure - 1)))

    def least_part(self, _before: float, _resolution: float) -> float:
        return 0.0

    def finer(self, pieces: Pieces, before: float, resolution: float) -> Pieces:
        return pieces.scaled(resolution / before)

    def first(self, tolerance: float) -> float:
        guess = float((tolerance / USUAL_TOLERANCE) ** (1.0 / self.order))
        return self.t_end / FIRST_STEPS * min(max(guess, 0.1), 1.0)

    def pair(self, resolution: float) -> tuple[Steps, Steps]:
        return Steps(resolution), Steps(resolution, ratio=RATIO)

    def next(self, resolution: float, excess: float) -> float:
        shrink = float((0.5 / excess) ** (1.0 / self.order)) if excess < np.inf else UNFINISHED
        return max(resolution * min(max(shrink, 0.02), 0.5), self._finest)

    def is_finest(self, resolution: float) -> bool:
        return resolution <= self._finest

    @property
    def _finest(self) -> float:
        """The finer run of the pair must end within the step limit."""
        return 1.005 * RATIO * self.t_end / self.step_limit
