"""Orbits in a section, each with the error of its points, its horizon, and whether it is chaotic.

Each orbit is followed twice, by series of unlike order and from starts some units in the last place apart: what lies
between the points of both is what rounding and the method do to them. In a regular motion that grows like a power of
the time, in a chaotic one exponentially.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from time import monotonic

import numpy as np

from ..simulation.audit import Audit
from ..simulation.integration import Flag
from ..simulation.library import get_method
from ..simulation.outcome import outcome_of
from ..simulation.pieces import Pieces
from ..simulation.problem import Floats, Problem
from ..simulation.run import Steps
from ..simulation.section import Crossings, Standing, follow
from ..vocabulary import RungStatus
from .plane import Section

TOLERANCES, ORDERS = (1e-16, 1e-18), (26, 30)  # of the two runs; the first has the points
LARGEST_STEP = 0.05  # over the span
TOGETHER = 64  # orbits that are followed side by side
FACTOR, ROUNDING = 4.0, 2.0**-51  # of the difference of two runs that are both as wrong; of a point by itself
LOST = 1e-3  # of the picture: a point that is farther from where it belongs stands elsewhere
PAUSE = 0.5  # seconds between two reports of what has come
FEW = 20  # points that tell nothing of how errors grow
GROWS = 1e-12  # of the picture, times the square of the number of points: more than regular motions lose
MEETS = 1e-9  # |h| over its scale, below which a motion is in the plane all the time


@dataclass(frozen=True)
class Orbit:
    """The points of one motion: `rows` (q, q̇, t) and `seen` (x, y, energy), shape (points, …).

    `errors`, shape (points,), are absolute below 1 and relative above; empty as long as nobody knows.
    """

    start: Floats
    rows: Floats
    seen: Floats
    errors: Floats
    status: RungStatus
    reach: float

    def horizon(self, extent: float) -> int:
        """The number of its points that stand where they belong; a single one that grazes the plane may not."""
        lost = self.errors > LOST * extent
        lasting = lost & np.append(lost[1:], [True])
        return int(np.argmax(lasting)) if lasting.any() else len(self.rows)

    def is_chaotic(self, extent: float) -> bool | None:
        """Whether it loses its digits faster than regular motions; None where too few points tell."""
        known, count = self.horizon(extent), len(self.errors)
        if known < count:
            return True
        if count < FEW:
            return None
        return bool(np.median(self.errors[-count // 4 :]) > GROWS * count**2 * extent)


def steps_of(problem: Problem, *, is_driven: bool) -> tuple[Steps, Steps]:
    """How both runs step: to rounding, with bounds where the time alone moves the forces."""
    whole = Pieces.whole(problem.t_end)
    pieces = Audit(problem, get_method("taylor")).before(1e-12) if is_driven else whole
    size = LARGEST_STEP * problem.t_end
    first, second = (
        Steps(part * size, tolerance, pieces.scaled(part), order=order, is_nudged=part < 1.0)
        for tolerance, order, part in zip(TOLERANCES, ORDERS, (1.0, 0.9), strict=True)
    )
    return first, second


def followed(
    section: Section, starts: Floats, steps: tuple[Steps, Steps], most: int, cancelled: Flag
) -> Iterator[tuple[float, list[Orbit]]]:
    """Orbits from `starts`, shape (orbits, 2n), as they come, with the part of the work that is done."""
    parts, told = [_Part(section, starts), _Part(section, starts)], -math.inf
    for number, (part, way) in enumerate(zip(parts, steps, strict=True)):
        for crossings, standing in follow(section.problem, section.surface, starts, way, most, cancelled):
            part.take(crossings, standing)
            if monotonic() - told < PAUSE:
                continue
            done = np.maximum(standing.reached / section.problem.t_end, standing.crossed / most)
            share = float(np.where(standing.outcomes < 0, np.minimum(done, 1.0), 1.0).mean())
            yield 0.5 * (number + share), parts[0].orbits(None)
            told = monotonic()
    yield 1.0, parts[0].orbits(parts[1])


class _Part:
    """What one of the two runs has found so far."""

    def __init__(self, section: Section, starts: Floats) -> None:
        self._section, self._starts = section, starts
        self._found: list[Crossings] = []
        self._standing: Standing | None = None

    def take(self, crossings: Crossings, standing: Standing) -> None:
        """More of them."""
        self._found.append(crossings)
        self._standing = standing

    def _rows(self) -> list[Floats]:
        """The points of each orbit as rows (q, q̇, t)."""
        motions = np.concatenate([one.motions for one in self._found])
        rows = np.concatenate([one.rows for one in self._found])
        order = np.lexsort((rows[:, -1], motions))
        return np.split(rows[order], np.searchsorted(motions[order], np.arange(1, len(self._starts))))

    def orbits(self, other: _Part | None) -> list[Orbit]:
        """The orbits, judged by another run where there is one."""
        standing, rows = self._standing, self._rows()
        if standing is None:
            return []
        again = other._rows() if other else [None] * len(rows)  # noqa: SLF001 - one of its own kind
        found = []
        every = np.split(self._section.at(np.concatenate(rows)), np.cumsum([len(each) for each in rows])[:-1])
        for index, (mine, seen, theirs) in enumerate(zip(rows, every, again, strict=True)):
            code = int(standing.outcomes[index])
            errors = np.zeros(0) if theirs is None else self._errors(mine, seen, theirs)
            status: RungStatus = "ok" if code < 0 else outcome_of(code, {}).status
            found.append(Orbit(self._starts[index], mine, seen, errors, status, float(standing.reach[index])))
        return found

    def _errors(self, mine: Floats, seen: Floats, theirs: Floats) -> Floats:
        """How far each point is from that of the other run next to it in time; infinite where there is none."""
        sizes = np.maximum(1.0, np.abs(seen[:, :2]).max(axis=1))
        if not len(theirs) or not len(mine):
            return np.full(len(mine), math.inf)
        times, others = mine[:, -1], theirs[:, -1]
        after = np.clip(np.searchsorted(others, times), 1, max(len(others) - 1, 1)) % max(len(others), 1)
        before = np.maximum(after - 1, 0)
        nearest = np.where(np.abs(others[before] - times) <= np.abs(others[after] - times), before, after)
        apart = np.abs(self._section.at(theirs[nearest])[:, :2] - seen[:, :2])
        for column, turns in enumerate(self._section.turns):
            if turns:
                apart[:, column] = np.minimum(apart[:, column], math.tau - apart[:, column])
        spacing = np.median(np.diff(times)) if len(times) > 1 else math.inf
        is_paired = np.abs(others[nearest] - times) <= 0.25 * spacing
        return np.where(is_paired, FACTOR * apart.max(axis=1) / sizes + ROUNDING, math.inf)
