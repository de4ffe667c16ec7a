"""Every method from coarse to fine: the runs that work–precision and convergence are charted from.

A method is run finer until its errors are rounding, until a run takes too long, or until the finest setting.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field

from ..simulation.method import Method
from ..simulation.problem import Problem
from ..simulation.reference import Reference
from ..simulation.stiffness import spectrum
from .measurement import Point, Runs, Setting, floor_of, too_slow

SAMPLES = 41  # steps end on samples, so that no interpolation adds to the error
TOLERANCES = tuple(10.0**-k for k in range(1, 14))
LEVELS = 14
ROUGHEST = 1.5  # radians of the fastest motion in the first step
WORSE = 2  # runs without gain, after which finer ones only add rounding

Runner = Callable[[Setting], Point]


def fixed_steps(problem: Problem) -> tuple[Setting, ...]:
    """Steps, each half of the one before, that divide the time between two samples."""
    between = problem.t_end / (SAMPLES - 1)
    fastest = spectrum(Runs.of(problem).between_events, 0.0, problem.state).size
    least = max(1, round(between * fastest / ROUGHEST))
    return tuple(Setting("step", between / (least * 2**level)) for level in range(LEVELS))


def settings_of(problem: Problem, method: Method) -> tuple[Setting, ...]:
    """The settings of a method from coarse to fine: tolerances if it has step control, else steps."""
    if method.is_adaptive:
        return tuple(Setting("tolerance", tolerance) for tolerance in TOLERANCES)
    return fixed_steps(problem)


@dataclass
class Track:
    """The runs of one method, from coarse to fine."""

    name: str
    settings: Sequence[Setting]
    measure: Runner
    points: list[Point] = field(default_factory=list)

    def go(self, level: int, floor: float) -> None:
        """The next run, unless it is in vain; what is too slow is said once."""
        if level >= len(self.settings) or self._is_done(floor):
            return
        setting = self.settings[level]
        if self.points and self.points[-1].is_slow:
            self.points.append(too_slow(self.name, setting))
        else:
            self.points.append(self.measure(setting))

    def _is_done(self, floor: float) -> bool:
        if self.points and self.points[-1].status == "too_slow":
            return True
        known = [(point.error, point.evaluations) for point in self.points if point.error is not None]
        if not known:
            return False
        least, work = min(known, key=lambda one: one[0])
        after = known[known.index((least, work)) + 1 :]
        in_vain = sum(evaluations > work for _, evaluations in after)  # what takes the same steps is no finer
        return known[-1][0] <= floor or in_vain >= WORSE


def sweep(tracks: Sequence[Track], reference: Reference) -> Iterator[tuple[int, int]]:
    """All tracks side by side, so that a chart grows evenly. Yields how many runs are done, and of how many."""
    levels, floor = max(len(track.settings) for track in tracks), floor_of(reference)
    total = levels * len(tracks)
    for level in range(levels):
        for index, track in enumerate(tracks):
            track.go(level, floor)
            yield level * len(tracks) + index + 1, total
