"""The step at which a method fails: predicted from its stability function, and measured by running it.

A small deviation from the motion is multiplied by growth(hλ) in each step (for nonlinear scenes while the linearized
motion hardly changes). A method fails where a deviation grows by more than one percent in a step beyond what the
motion itself does.
Source: Hairer, Wanner, Solving Ordinary Differential Equations II, IV.2.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ..simulation.kernels.motion import FINE, NEWTON_FAILED, STEP_LIMIT
from ..simulation.method import Method
from ..simulation.problem import Floats, Problem
from ..simulation.run import Run, Steps, run
from ..simulation.stability import Complexes, growth, largest_stable_step

FAILING = 0.01  # growth in one step, above 1
FINEST, COARSEST, PER_DECADE = 1e-3, 1e2, 24  # steps looked at, times the largest |λ|
STEPS = 1200  # in one run
KICK, LINEAR = 1e-6, 1e-1  # deviations: at first, and as long as they follow the linearized motion
NOISE = 1e-9  # of the state; below, deviations are those of rounding and of Newton iterations
FEWEST = 80  # steps that a deviation stays small, else it grows by ten percent in each
PRECISION = 2e-3  # of the step found


@dataclass(frozen=True)
class Failure:
    """Steps in seconds; infinite where the method holds for every step looked at.

    `bound` is the largest step for which nothing grows at all, `cause` how the failing run ended.
    """

    bound: float
    predicted: float
    measured: float
    cause: str

    @property
    def deviation(self) -> float | None:
        """(measured − predicted) / predicted, where both are there."""
        if not (math.isfinite(self.predicted) and math.isfinite(self.measured)):
            return None
        return self.measured / self.predicted - 1.0


def failure(problem: Problem, method: Method, eigenvalues: Complexes) -> Failure:
    """Where a method with fixed steps fails on a motion with these eigenvalues at its start."""
    fastest = float(np.abs(eigenvalues).max(initial=0.0))
    bound = largest_stable_step(method.tableau, eigenvalues)
    if fastest == 0.0:
        return Failure(bound, math.inf, math.inf, "")
    drive = max(0.0, float(eigenvalues.real.max()))
    predicted = _first(lambda h: _excess(method, eigenvalues, h) > FAILING, fastest)
    trial = _Trial(problem, method, drive, fastest)
    measured = _first(trial.fails, fastest)
    return Failure(bound, predicted, measured, trial.cause(measured))


def _excess(method: Method, eigenvalues: Complexes, h: float) -> float:
    """The growth in one step, beyond that of the motion itself."""
    drive = max(0.0, float(eigenvalues.real.max()))
    return float(growth(method.tableau, h * eigenvalues).max()) / math.exp(min(h * drive, 700.0)) - 1.0


def _first(fails: Callable[[float], bool], fastest: float) -> float:
    """The first step that fails: looked for from fine to coarse, then halved between the last two."""
    steps = np.geomspace(FINEST, COARSEST, int(PER_DECADE * math.log10(COARSEST / FINEST))) / fastest
    low = 0.0
    for high in steps:
        if fails(float(high)):
            return _between(fails, low, float(high)) if low else float(high)
        low = float(high)
    return math.inf


def _between(fails: Callable[[float], bool], low: float, high: float) -> float:
    while high - low > PRECISION * high:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if fails(middle) else (middle, high)
    return 0.5 * (low + high)


@dataclass(frozen=True)
class _Trial:
    """Two runs a little apart, and how their distance grows."""

    problem: Problem
    method: Method
    drive: float
    fastest: float

    def fails(self, h: float) -> bool:
        first, second = self._pair(h)
        if first.result.outcome not in (FINE, STEP_LIMIT) or second.result.outcome not in (FINE, STEP_LIMIT):
            return True
        distances = np.linalg.norm((first.states - second.states)[:, : self._scales.size] / self._scales, axis=1)
        distances = np.maximum(distances, NOISE * np.abs(first.states[:, : self.problem.degrees]).max(axis=1))
        small = int((distances < LINEAR).cumprod().sum())
        if small < FEWEST:
            return True
        grown = growth_in_a_step(distances[:small])
        return grown / math.exp(min(h * self.drive, 700.0)) - 1.0 > FAILING

    @property
    def _scales(self) -> Floats:
        """Of coordinates and rates: so a vibration of the fastest part does not change its size while it turns."""
        return np.repeat([1.0, self.fastest], self.problem.degrees)

    def cause(self, h: float) -> str:
        """How the run at a step that fails ended."""
        if not math.isfinite(h):
            return ""
        outcomes = [int(one.result.outcome) for one in self._pair(1.02 * h)]
        return "newton_failed" if NEWTON_FAILED in outcomes else "grows"

    def _pair(self, h: float) -> tuple[Run, Run]:
        n, t_end = self.problem.degrees, STEPS * h
        apart = KICK * self._scales * np.random.default_rng(0).normal(size=2 * n)
        start = self.problem.state[: 2 * n] + apart
        problem = replace(self.problem, t_end=t_end, step_limit=2 * STEPS)
        other = replace(problem, values=tuple(map(float, start[:n])), rates=tuple(map(float, start[n:])))
        times, flag = np.linspace(0.0, t_end, STEPS + 1), np.zeros(1, dtype=np.int64)
        return run(problem, self.method, times, flag, Steps(h)), run(other, self.method, times, flag, Steps(h))


def growth_in_a_step(distances: Floats) -> float:
    """The factor by which distances grow per step, from the largest of the second and of the last quarter."""
    quarter = len(distances) // 4
    early = distances[quarter : 2 * quarter].max(initial=1e-300)
    late = distances[3 * quarter :].max(initial=1e-300)
    return float((late / early) ** (1.0 / (2 * quarter)))
