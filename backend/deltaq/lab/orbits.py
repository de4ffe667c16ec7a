"""Orbits in a section, each with the error of its points, its horizon, and whether it is chaotic.

Each orbit is followed twice, by steps of unlike size and from starts some units in the last place apart: what lies
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
from ..simulation.section import LARGEST_STEP, ORDER, TOLERANCE, Crossings, Standing, follow, nearest
from ..vocabulary import RungStatus
from .plane import Section

TOGETHER = 64  # orbits that are followed side by side
FACTOR, ROUNDING = 4.0, 2.0**-51  # of the difference of two runs that are both as wrong; of a point by itself
LOST = 1e-3  # of the picture: a point that is farther from where it belongs stands elsewhere
PAUSE = 0.5  # seconds between two reports of what has come
FEW = 20  # points that tell nothing of how errors grow
GROWS = 1e-12  # of the picture, times the square of the number of points: more than regular motions lose
LARGEST = 1e100  # on an axis
ONE_POINT = 1e-9  # of the distance from the origin


@dataclass(frozen=True)
class Orbit:
    """The points of one motion from a `start`, shape (2n,): `rows` (q, q̇, t) and `seen` (x, y, energy).

    These have shape (points, …); `errors`, shape (points,), are absolute below 1 and relative above.
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


def extent_of(points: Floats) -> float:
    """The larger side of the picture of points, shape (points, 2): by it errors are judged.

    Where all are one point, as on a motion that repeats with each crossing, it is how far that is from the origin.
    """
    if not len(points):
        return 1.0
    side, farthest = float(np.ptp(points, axis=0).max()), float(np.abs(points).max())
    return side if side > ONE_POINT * farthest else farthest or 1.0


def steps_of(problem: Problem, *, is_driven: bool) -> Steps:
    """How to step: to rounding, with bounds where the time alone moves the forces."""
    pieces = Audit(problem, get_method("taylor")).before(1e-12) if is_driven else Pieces.whole(problem.t_end)
    return Steps(LARGEST_STEP * problem.t_end, TOLERANCE, pieces, order=ORDER)


def followed(
    section: Section, starts: Floats, steps: Steps, most: int, cancelled: Flag
) -> Iterator[tuple[float, list[Orbit]]]:
    """Orbits from `starts`, shape (orbits, 2n), as they come, with the part of the work that is done."""
    parts, told = list[Crossings](), -math.inf
    found = follow(section.problem, section.surface, starts, steps, most, cancelled, twins=True)
    for crossings, standing in found:
        parts.append(crossings)
        goes_on = bool((standing.outcomes < 0).any())
        if goes_on and monotonic() - told < PAUSE:
            continue
        done = np.maximum(standing.reached / section.problem.t_end, standing.crossed / most)
        share = float(np.where(standing.outcomes < 0, np.minimum(done, 1.0), 1.0).mean())
        yield share, _orbits(section, starts, parts, standing)
        told = monotonic()


def _orbits(section: Section, starts: Floats, parts: list[Crossings], standing: Standing) -> list[Orbit]:
    """The orbits so far, judged by their twins; a point that its twin has not come to yet is left out."""
    count, ends = len(starts), standing.reached
    motions = np.concatenate([one.motions for one in parts])
    rows = np.concatenate([one.rows for one in parts])
    order = np.lexsort((rows[:, -1], motions))
    motions, rows = motions[order], rows[order]
    places = np.searchsorted(motions, np.arange(1, 2 * count))
    seen, rows_of = np.split(section.at(rows), places), np.split(rows, places)
    found = []
    for index in range(count):
        mine, theirs, view, other = rows_of[index], rows_of[count + index], seen[index], seen[count + index]
        if standing.outcomes[count + index] < 0:
            known = mine[:, -1] <= ends[count + index] - (theirs[-1, -1] - theirs[-2, -1] if len(theirs) > 1 else 0.0)
            mine, view = mine[known], view[known]
        has_place = (np.abs(view[:, :2]) <= LARGEST).all(axis=1)  # an axis may have no value somewhere
        mine, view = mine[has_place], view[has_place]
        code, errors = int(standing.outcomes[index]), errors_between(section, mine, view, theirs, other)
        status: RungStatus = "ok" if code < 0 else outcome_of(code, {}).status
        found.append(Orbit(starts[index], mine, view, errors, status, float(standing.reach[index])))
    return found


def errors_between(section: Section, mine: Floats, seen: Floats, theirs: Floats, other: Floats) -> Floats:
    """How far each point is from that of its twin next to it in time, shape (points,); infinite where there is none.

    `mine` and `theirs` are rows (q, q̇, t), shape (points, 2n + 1), `seen` and `other` what is seen of them, shape
    (points, 3).
    """
    if not len(theirs) or not len(mine):
        return np.full(len(mine), math.inf)
    times, others = mine[:, -1], theirs[:, -1]
    which = nearest(times, others)
    apart = np.abs(other[which, :2] - seen[:, :2])
    for column, turns in enumerate(section.turns):
        if turns:
            apart[:, column] = np.minimum(apart[:, column], math.tau - apart[:, column])
    sizes = np.maximum(1.0, np.abs(seen[:, :2]).max(axis=1))
    spacing = float(np.median(np.diff(times))) if len(times) > 1 else math.inf
    is_paired = np.abs(others[which] - times) <= 0.25 * spacing
    return np.where(is_paired, FACTOR * apart.max(axis=1) / sizes + ROUNDING, math.inf)
