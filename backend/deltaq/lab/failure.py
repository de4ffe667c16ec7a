"""The step at which a method fails: predicted from its linearization, and measured by running it.

A method fails where it makes a small deviation grow in each step by one percent, and where deviations grow by
themselves, by one percent more than half as fast again. Where one linearization holds along the motion, the growth of
a step of the method on it against e^{h Re λ} predicts that, and two runs a little apart measure it. Elsewhere nothing
is predicted, and the distance of the two runs is held against their true one; where the method has made another motion
of it before it fails, it is accuracy that limits the step, and no step of failure can be told.
Source: Hairer, Wanner, Solving Ordinary Differential Equations II, IV.2.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import Enum
from typing import Final

import numpy as np

from ..contract.experiments.stability import Basis, Cause
from ..simulation.kernels.motion import FINE, NEWTON_FAILED, STEP_LIMIT
from ..simulation.method import Method
from ..simulation.outcome import OUT_OF_REACH
from ..simulation.problem import Floats
from ..simulation.stability import largest_stable_step
from .neighbours import KICK, SMALL, STEPS, Neighbours, Pair
from .step_matrix import step_growth

FAILING = 0.01  # growth in one step, above 1
ROUNDING = 1e-6  # of a growth that is 1 on paper, where eigenvalues of a step may be double
FASTER = 1.5  # times the rate at which deviations grow by themselves: less is an error, no failure
ALONG = 600  # steps in one run along a motion that the linearization changes on
FEWEST = 80  # steps that a deviation stays small, else it grows by ten percent in each
ENOUGH = 2 * FEWEST  # steps for which it must stay small by itself to tell
LINEARIZATION: Final = "linearization"  # what a method is held against
FLOW: Final = "flow"


class Verdict(Enum):
    """What a run with some step shows; the last three tell nothing of stability."""

    HOLDS = "holds"
    FAILS = "fails"
    LOST = "motion-lost"
    SPREADS = "motion-spreads"
    UNKNOWN = "motion-unknown"


@dataclass(frozen=True)
class Grid:
    """Steps looked at, in even ratios and times the largest |λ|, and the precision of the step that is found."""

    finest: float
    coarsest: float
    per_decade: int
    precision: float

    def first(self, verdict: Callable[[float], Verdict], fastest: float) -> tuple[float, Verdict]:
        """The first step that does not hold, and why: from fine to coarse, then halved between the last two."""
        count = int(self.per_decade * math.log10(self.coarsest / self.finest))
        low = 0.0
        for high in map(float, np.geomspace(self.finest, self.coarsest, count) / fastest):
            found = verdict(high)
            if found is not Verdict.HOLDS:
                return self._between(verdict, low, high, found) if low else (high, found)
            low = high
        return math.inf, Verdict.HOLDS

    def _between(
        self, verdict: Callable[[float], Verdict], low: float, high: float, last: Verdict
    ) -> tuple[float, Verdict]:
        while high - low > self.precision * high:
            middle = 0.5 * (low + high)
            found = verdict(middle)
            if found is Verdict.HOLDS:
                low = middle
            else:
                high, last = middle, found
        return 0.5 * (low + high), last


GRIDS: Mapping[Basis, Grid] = {LINEARIZATION: Grid(1e-3, 1e2, 24, 2e-3), FLOW: Grid(3e-3, 1e1, 12, 1e-2)}


@dataclass(frozen=True)
class Failure:
    """Steps in seconds; infinite where the method holds for every step looked at, None where it cannot be told.

    `bound` is the largest step for which nothing grows at all, `cause` how the failing run ended. `basis` says what the
    method was held against; `reason` why no step was measured, and `limit` is the step from which on that is so.
    """

    bound: float | None
    predicted: float | None
    measured: float | None
    cause: Cause
    basis: Basis = LINEARIZATION
    reason: str = ""
    limit: float | None = None

    @property
    def deviation(self) -> float | None:
        """(measured − predicted) / predicted, where both are there and about the same: growth."""
        if self.predicted is None or self.measured is None or self.cause == "newton_failed":
            return None
        if not (math.isfinite(self.predicted) and math.isfinite(self.measured)):
            return None
        return self.measured / self.predicted - 1.0


def failure(neighbours: Neighbours, method: Method) -> Failure:
    """Where a method with fixed steps fails on a motion."""
    if neighbours.fastest == 0.0:
        return Failure(largest_stable_step(method.scheme, neighbours.eigenvalues), math.inf, math.inf, "")
    basis: Basis = LINEARIZATION if neighbours.is_constant else FLOW
    bound, predicted = _predicted(neighbours, method) if basis == LINEARIZATION else (None, None)
    trial = _Trial(neighbours, method, basis)
    limit, verdict = GRIDS[basis].first(trial.verdict, neighbours.fastest)
    if verdict in (Verdict.HOLDS, Verdict.FAILS):
        return Failure(bound, predicted, limit, trial.cause(limit), basis)
    return Failure(bound, predicted, None, "", basis, verdict.value, limit)


def _predicted(neighbours: Neighbours, method: Method) -> tuple[float, float]:
    """The largest step with which nothing grows, and the first with which something grows too much."""

    grown = step_growth(method.scheme, neighbours.linear)

    def first(least: float) -> float:
        def verdict(h: float) -> Verdict:
            return Verdict.FAILS if grown(h) / _alone(h * neighbours.drive) - 1.0 > least else Verdict.HOLDS

        return GRIDS[LINEARIZATION].first(verdict, neighbours.fastest)[0]

    by_eigenvalues = method.is_explicit or neighbours.drive > 0.0
    bound = largest_stable_step(method.scheme, neighbours.eigenvalues) if by_eigenvalues else first(ROUNDING)
    return bound, first(FAILING)


def _alone(power: float) -> float:
    """What a deviation that grows by e^power in a step may grow by."""
    return math.exp(min(FASTER * max(power, 0.0), 700.0))


@dataclass(frozen=True)
class _Trial:
    """A method on two motions a little apart, and how their distance grows."""

    neighbours: Neighbours
    method: Method
    basis: Basis

    def verdict(self, h: float) -> Verdict:
        return self._by_linearization(h) if self.basis == LINEARIZATION else self._along_the_motion(h)

    def cause(self, h: float) -> Cause:
        """How the run at a step that fails ended."""
        if not math.isfinite(h):
            return ""
        pair = self.neighbours.by(self.method, 1.02 * h)
        return "newton_failed" if NEWTON_FAILED in _outcomes(pair) else "grows"

    def _by_linearization(self, h: float) -> Verdict:
        """Held against e^{t Re λ}."""
        drive = self.neighbours.drive
        if drive * h * ENOUGH > SMALL:
            return Verdict.SPREADS
        pair = self.neighbours.by(self.method, h)
        if not self.neighbours.is_at_start(pair.first, max(pair.small, FEWEST)):
            return Verdict.LOST
        exact = KICK * np.exp(np.minimum(drive * h * np.arange(STEPS + 1), 600.0))
        return _judged(pair, exact, STEPS) if _ran(pair) else Verdict.FAILS

    def _along_the_motion(self, h: float) -> Verdict:
        """Held against the exact flow, while deviations are small and the motion is the same."""
        exact = self.neighbours.exact(h, ALONG)
        if not _ran(exact):
            return Verdict.UNKNOWN
        if exact.small < ENOUGH:
            return Verdict.SPREADS
        pair = self.neighbours.by(self.method, h, ALONG)
        count = min(exact.small, max(pair.small, FEWEST))
        if not self.neighbours.is_kept(exact.first, pair.first, count):
            return Verdict.LOST
        return _judged(pair, exact.distances, exact.small) if _ran(pair) else Verdict.FAILS


def _judged(pair: Pair, exact: Floats, most: int) -> Verdict:
    """Whether the distance grows faster than it would, as long as it is small."""
    count = min(pair.small, most)
    if count < FEWEST:
        return Verdict.FAILS
    alone = _alone(math.log(growth_in_a_step(exact[:count])))
    return Verdict.FAILS if growth_in_a_step(pair.distances[:count]) / alone - 1.0 > FAILING else Verdict.HOLDS


def _outcomes(pair: Pair) -> tuple[int, int]:
    return int(pair.first.result.outcome), int(pair.second.result.outcome)


def _ran(pair: Pair) -> bool:
    """Whether both runs came to their ends."""
    return all(outcome in (FINE, STEP_LIMIT, OUT_OF_REACH) for outcome in _outcomes(pair))


def growth_in_a_step(distances: Floats) -> float:
    """The factor by which distances grow per step, from the largest of the second and of the last quarter.

    `distances` has shape (steps,).
    """
    quarter = len(distances) // 4
    early = distances[quarter : 2 * quarter].max(initial=1e-300)
    late = distances[3 * quarter :].max(initial=1e-300)
    return float((late / early) ** (1.0 / (2 * quarter)))
