"""One run of one method, measured: its error against a reference, its right-hand sides, its seconds.

Errors are in the measure of a tolerance: the largest of any coordinate at any sample, absolute below 1 and relative
above. Times are medians of repeated runs of the stepping loop alone; compiling and reading results do not count. Where
a motion goes on behind events (impacts, sticking and slipping, kinks), what it takes to find and pass them does.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from statistics import median
from time import perf_counter

import numpy as np

from ..model.modes import Modes, modes_of_model
from ..simulation.hybrid import run_on
from ..simulation.integration import Flag
from ..simulation.kernels.motion import FINE
from ..simulation.method import Method
from ..simulation.outcome import outcome_of
from ..simulation.problem import Floats, Problem
from ..simulation.reference import Reference
from ..simulation.run import Run, Steps, run
from ..simulation.transitions import with_signs
from .report import Document, rounded, significant

SLOW = 0.3  # seconds of the fastest run, beyond which a finer one is not tried
REPEATS, BRIEF = 7, 0.01  # short runs are repeated so often, long ones less


@dataclass(frozen=True)
class Setting:
    """The resolution of a run: the local tolerance of a method with step control, or the step in seconds."""

    kind: str
    value: float

    def steps(self, longest: float) -> Steps:
        """How to step with this setting; adaptive steps are no longer than `longest` seconds."""
        return Steps(longest, self.value) if self.kind == "tolerance" else Steps(self.value)


@dataclass(frozen=True)
class Point:
    """What one run cost and its error; None if it did not reach the end, for which `status` gives the reason."""

    method: str
    setting: Setting
    status: str
    error: float | None
    evaluations: int = 0
    steps: int = 0
    seconds: tuple[float, ...] = ()
    preparation: float | None = None  # seconds for code that was made for this run alone

    @property
    def time(self) -> float:
        """The median of the seconds that its runs took; 0 if there were none."""
        return median(self.seconds) if self.seconds else 0.0

    @property
    def is_slow(self) -> bool:
        """Whether even the fastest run took so long that a finer one is not tried."""
        return min(self.seconds, default=0.0) > SLOW

    @property
    def described(self) -> Document:
        """The point as plain data for JSON."""
        return {
            "method": self.method,
            self.setting.kind: significant(self.setting.value),
            "status": self.status,
            "error": None if self.error is None else significant(self.error),
            "evaluations": self.evaluations,
            "steps": self.steps,
            "time": significant(self.time),
            "times": rounded(sorted(self.seconds), 4),
        } | ({} if self.preparation is None else {"preparation": significant(self.preparation)})


def too_slow(method: str, setting: Setting) -> Point:
    """A point for a run that is not tried, because the one before took too long."""
    return Point(method, setting, "too_slow", None)


@dataclass(frozen=True)
class Runs:
    """What is run: a problem, and its modes where its motions go on behind events."""

    problem: Problem
    modes: Modes | None
    cancelled: Flag

    @classmethod
    def of(cls, problem: Problem) -> Runs:
        """The runs of a problem, as a simulation has them."""
        modes = modes_of_model(problem.model)
        own = problem if modes is None else replace(problem, model=modes.model)
        return cls(own, modes, np.zeros(1, dtype=np.int64))

    @classmethod
    def over_kinks(cls, problem: Problem) -> Runs:
        """The runs of one set of equations, whose steps go over kinks."""
        return cls(problem, None, np.zeros(1, dtype=np.int64))

    @property
    def goes_on(self) -> bool:
        """Whether motions go on behind events: impacts, kinks, sticking and slipping."""
        return self.modes is not None

    @property
    def between_events(self) -> Problem:
        """The problem with the signs of all jumps and kinks as they are on one side of them, so that it is smooth."""
        return self.problem if self.modes is None else with_signs(self.problem, self.modes)

    def run(self, method: Method, times: Floats, steps: Steps) -> tuple[Run, float]:
        """The run of a method with samples at `times`, shape (samples,), and what it took in seconds."""
        if self.modes is None:
            found = run(self.problem, method, times, self.cancelled, steps)
            return found, found.wall_time
        start = perf_counter()
        found = run_on(self.problem, self.modes, method, times, self.cancelled, steps)
        return found, perf_counter() - start


def warm(runs: Runs, *methods: Method) -> None:
    """Loads the kernels of methods, so that no measured run has to."""
    short = 1e-3 * runs.problem.t_end
    for method in methods:
        runs.run(method, np.array([0.0, short]), Steps(short, 1e-3 if method.is_adaptive else 0.0))


def measure(runs: Runs, method: Method, reference: Reference, setting: Setting, *, repeats: int) -> Point:
    """Runs a method and measures its time; `repeats` 1 measures once."""
    problem = runs.problem
    problem.model.settle()

    def once() -> tuple[Run, float]:
        return runs.run(method, reference.times, setting.steps(0.05 * problem.t_end))

    first, took = once()
    status = outcome_of(int(first.result.outcome), {}).status
    seconds = repeated(lambda: once()[1], took, repeats)
    evaluations, steps = int(first.result.evaluations), int(first.result.steps + first.result.rejected)
    error = error_of(first.states[:, : problem.degrees], reference) if first.result.outcome == FINE else None
    return Point(method.id, setting, status, error, evaluations, steps, seconds)


def repeated(again: Callable[[], float], first: float, repeats: int) -> tuple[float, ...]:
    """The seconds of several runs: `repeats` of short ones, up to three of long ones.

    The first of short ones is left out, since it warms up. Two are enough where both are slow; where the second is not,
    the first was interrupted.
    """
    if first <= BRIEF and repeats > 1:
        return tuple(again() for _ in range(repeats))
    seconds = [first]
    while len(seconds) < max(2 if first > SLOW else 1, min(3, repeats)):
        seconds.append(again())
        if min(seconds) > max(SLOW, 0.5 * first):
            break
    return tuple(seconds)


def error_of(values: Floats, reference: Reference) -> float | None:
    """The largest error at any sample, or None where the run or the reference is not complete.

    `values` has shape (samples, n). The error is not known to be less than the reference's own: what is closer to the
    reference shares its errors.
    """
    if values.shape != reference.values.shape:
        return None
    apart = float(np.max(np.abs(values - reference.values) / np.maximum(1.0, np.abs(reference.values))))
    return max(apart, floor_of(reference))


def floor_of(reference: Reference) -> float:
    """The error of the reference itself, below which nothing can be measured."""
    return float(np.max(reference.errors / np.maximum(1.0, np.abs(reference.values).max(axis=1))))


def order_of(points: list[Point], x: Callable[[Point], float], floor: float) -> float | None:
    """The measured order: −d log(error)/d log(x) by least squares, where errors are small but not yet rounding.

    None if too few points show it.
    """
    chosen = [
        (x(point), point.error)
        for point in points
        if point.error is not None and 30.0 * floor < point.error < 1e-2 and x(point) > 0.0
    ]
    logs = _falling(np.log(np.array(sorted(chosen)).reshape(-1, 2)))
    if len(logs) < 3 or np.ptp(logs[:, 0]) < np.log(3.0):
        return None
    return significant(-float(np.polyfit(logs[:, 0], logs[:, 1], 1)[0]), 3)


def _falling(logs: Floats) -> Floats:
    """Rows (log x, log error) without those at the end where the error hardly falls: a method's own rounding, which
    may lie far above that of the reference.
    """
    while len(logs) > 2:
        slopes = np.diff(logs[:, 1]) / np.maximum(np.diff(logs[:, 0]), 1e-300)
        if slopes[-1] < 0.5 * float(np.median(slopes)):  # both are negative
            break
        logs = logs[:-1]
    return logs
