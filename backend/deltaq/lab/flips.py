"""The time until an angle turns over, for a plane of initial values.

Source: J. S. Heyl, The Double Pendulum Fractal (2008).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import product

import numpy as np

from ..simulation.audited import audited_run
from ..simulation.integration import Flag
from ..simulation.library import get_method
from ..simulation.problem import Floats, Problem
from ..simulation.run import Steps
from .engine import engine, while_wanted

METHOD, TOLERANCE, PER_SECOND = "dormand-prince-54", 1e-6, 25
COARSEST = 4
ROUNDS = 12  # of a motion, each by shorter steps where the one before was blind
CHUNK = 64  # points that are worked out at a time

Place = tuple[int, int]


@dataclass(frozen=True)
class Plane:
    """Initial values of two coordinates (by their places); all else is the problem's.

    `x`, shape (columns,), are those of the `first`, `y`, shape (rows,), those of the `second`.
    """

    problem: Problem
    first: int
    second: int
    x: Floats
    y: Floats
    cancelled: Flag = field(default_factory=lambda: np.zeros(1, dtype=np.int64))

    def refined(self) -> Iterator[Floats]:
        """Times of the first flip in seconds, shape (rows, columns): rough, then finer.

        Infinite where nothing turns over, NaN where not known yet.
        """
        found, stride = np.full((self.y.size, self.x.size), np.nan), COARSEST
        with engine() as executor:
            while stride >= 1:
                places = product(range(0, self.y.size, stride), range(0, self.x.size, stride))
                missing = [place for place in places if np.isnan(found[place])]
                parts = [missing[first : first + CHUNK] for first in range(0, len(missing), CHUNK)]
                for part, times in zip(parts, executor.map(self._times, parts), strict=True):
                    for place, time in zip(part, times, strict=True):
                        found[place] = time
                yield found.copy()
                stride //= 2

    def _times(self, places: Sequence[Place]) -> list[float]:
        with while_wanted(self.cancelled) as flag:
            return [first_flip(self._begun_at(place), flag) for place in places]

    def _begun_at(self, place: Place) -> Problem:
        values = list(self.problem.values)
        values[self.first], values[self.second] = float(self.x[place[1]]), float(self.y[place[0]])
        return replace(self.problem, values=tuple(values))


def first_flip(problem: Problem, cancelled: Flag) -> float:
    """The first time at which an angle that began between −π and π lies outside; infinite if none does in time."""
    samples = max(2, round(PER_SECOND * problem.t_end) + 1)
    times = np.linspace(0.0, problem.t_end, samples)
    steps = Steps(problem.t_end / 10, TOLERANCE)
    found, blind = audited_run(problem, get_method(METHOD), times, steps, TOLERANCE, cancelled, ROUNDS)
    if blind:
        return math.nan
    angles = [place for place, is_angle in enumerate(problem.angular) if is_angle]
    over = np.abs(found.states[:, angles]) > math.pi
    if not over.any():
        return math.inf if found.is_complete else math.nan
    return _crossing(found.times, found.states[:, angles], int(np.argmax(over.any(axis=1))))


def _crossing(times: Floats, angles: Floats, index: int) -> float:
    """Between two samples, by the secant of whichever angle crosses first."""
    if index == 0:
        return 0.0
    before, after = np.abs(angles[index - 1]), np.abs(angles[index])
    parts = [(math.pi - a) / (b - a) for a, b in zip(before, after, strict=True) if b > math.pi]
    return float(times[index - 1] + min(parts) * (times[index] - times[index - 1]))
