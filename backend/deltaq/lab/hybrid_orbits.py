"""Orbits of motions that go on behind events (impacts, sticking and slipping, kinks), as they cross a section.

Between events a motion is smooth: there, between neighbouring samples, it is the quintic through positions, rates and
accelerations at both, those of the mode that it is in, and the plane's root is sought on that. Where a rate jumps over
the plane nothing is crossed. Where the plane is the gap of a contact each impact counts: falling before it, rising (or
both) behind it.
Sources: di Bernardo, Budd, Champneys, Kowalczyk, Piecewise-smooth Dynamical Systems, §1.4 (impact maps);
Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, II.6 (Hermite interpolation).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from time import monotonic

import numpy as np

from ..mechanics.scene import Scene
from ..model.modes import Modes
from ..model.observables import Observables
from ..simulation.audit import Audit
from ..simulation.hybrid import run_on
from ..simulation.integration import Flag
from ..simulation.library import get_method
from ..simulation.march import Truths
from ..simulation.outcome import outcome_of
from ..simulation.problem import Floats, Problem
from ..simulation.run import Run, Steps
from ..simulation.section import LARGEST_STEP, ORDER, TOLERANCE, ZERO, Brackets, Surface, refined
from ..simulation.transitions import with_signs
from .interpolation import quintics
from .orbits import LARGEST, PAUSE, Orbit, errors_between
from .plane import Section

APART = 1.2  # the steps of a motion over those of its twin
LEAST, MOST = 2000, 400_000  # samples of a motion
PER_STEP, PER_PERIOD = 64, 96  # samples of a motion, at least
TOUCHING = 1e-12  # a gap, by which a start may be behind a contact


@dataclass(frozen=True)
class Part:
    """A motion between two events, in its mode: `rows` (q, q̇, t), shape (≥ 2, 2n + 1), from the one to the other."""

    problem: Problem
    rows: Floats


@dataclass(frozen=True)
class HybridMotions:
    """Motions of a problem in modes, all followed with the same steps and at `samples` + 1 times."""

    problem: Problem
    modes: Modes
    samples: int
    cancelled: Flag

    def run(self, start: Floats, *, is_twin: bool = False) -> Run:
        """The motion from a start, shape (2n,); its twin steps otherwise, and is shaken."""
        n, size, count = self.problem.degrees, LARGEST_STEP * self.problem.t_end, self.samples
        if is_twin:
            size, count = size / APART, count + count // 7
        own = replace(
            self.problem,
            model=self.modes.model,
            values=tuple(start[:n].tolist()),
            rates=tuple(start[n : 2 * n].tolist()),
        )
        method, times = get_method("taylor"), np.linspace(0.0, own.t_end, count + 1)
        pieces = Audit(with_signs(own, self.modes), method).before(TOLERANCE)
        steps = Steps(size, TOLERANCE, pieces, order=ORDER, is_recorded=True, shaken=int(is_twin))
        return run_on(own, self.modes, method, times, self.cancelled, steps)

    def following(self, start: Floats, period: float) -> HybridMotions:
        """The same with samples as close as a motion from this start, or a period of a drive in seconds, asks for.

        `start` has shape (2n,).
        """
        wanted = max(PER_STEP * self.run(start).result.steps, PER_PERIOD * self.problem.t_end / period, LEAST)
        return replace(self, samples=int(min(wanted, MOST)))


def parts_of(run: Run) -> Iterator[Part]:
    """The parts of a run on which it is smooth."""
    ends = [mesh.start for mesh in run.meshes[1:]] + [math.inf]
    for mesh, end in zip(run.meshes, ends, strict=True):
        n = mesh.problem.degrees
        inside = (run.times > mesh.start) & (run.times < end)
        begin = np.array([[*mesh.problem.values, *mesh.problem.rates, mesh.start]])
        rows = [begin, np.column_stack([run.states[inside, : 2 * n], run.times[inside]])]
        if math.isfinite(end) and len(mesh.mesh_times):
            rows.append(np.append(mesh.mesh_states[-1], mesh.mesh_times[-1])[None, :])
        found = np.concatenate(rows)
        found = found[np.append(True, np.diff(found[:, -1]) > 0.0)]
        if len(found) > 1:
            yield Part(mesh.problem, found)


def path_of(run: Run) -> Floats:
    """A run as rows (q, q̇, t), shape (samples, 2n + 1), both sides of events among them."""
    parts = [part.rows for part in parts_of(run)]
    width = 2 * run.meshes[0].problem.degrees
    return np.concatenate(parts) if parts else np.column_stack([run.states[:, :width], run.times])


def clear_of_contacts(scene: Scene, observables: Observables, states: Floats) -> Truths:
    """Which of the states (q, q̇) at the time 0, shape (states, 2n), are behind no contact: shape (states,)."""
    rows, clear = np.column_stack([states, np.zeros(len(states))]), np.ones(len(states), dtype=bool)
    for event in scene.events:
        gaps = observables.observable(event.value).jet.table(rows)
        scale = (np.abs(gaps[:, 1:-1]) * np.abs(states)).sum(axis=1)
        clear &= gaps[:, 0] >= -TOUCHING * np.maximum(scale, 1.0)
    return clear


def followed(
    section: Section, motions: HybridMotions, starts: Floats, most: int
) -> Iterator[tuple[float, list[Orbit]]]:
    """Orbits from `starts`, shape (orbits, 2n), as they come, with the part of the work that is done."""
    orbits, told = list[Orbit](), -math.inf
    for number, start in enumerate(starts):
        orbits.append(_orbit(section, motions, start, most))
        if number + 1 == len(starts) or monotonic() - told >= PAUSE:
            yield (number + 1) / len(starts), list(orbits)
            told = monotonic()


def _orbit(section: Section, motions: HybridMotions, start: Floats, most: int) -> Orbit:
    run, twin = motions.run(start), motions.run(start, is_twin=True)
    rows, theirs = (crossings_of(each, section.surface)[:most] for each in (run, twin))
    seen = section.at(rows)
    has_place = (np.abs(seen[:, :2]) <= LARGEST).all(axis=1)
    rows, seen = rows[has_place], seen[has_place]
    reach = float(np.abs(section.surface.values(path_of(run))[:, 0]).max())
    errors = errors_between(section, rows, seen, theirs, section.at(theirs))
    return Orbit(start, rows, seen, errors, outcome_of(run.result.outcome, {}).status, reach)


def crossings_of(run: Run, surface: Surface) -> Floats:
    """Where a run crosses a surface: rows (q, q̇, t), shape (crossings, 2n + 1), in their order.

    A part that ends in the surface crosses it there, unless the next one begins with a crossing.
    """
    found, width = list[Floats](), 2 * run.meshes[0].problem.degrees + 1
    ended = False
    for part in parts_of(run):
        rows, begins, ends = _crossings(part, surface)
        if begins and ended:
            found[-1] = found[-1][:-1]
        found.append(rows)
        ended = ends
    return np.concatenate([np.zeros((0, width)), *found])


def _crossings(part: Part, surface: Surface) -> tuple[Floats, bool, bool]:
    """The crossings of a part, and whether the first is its beginning, and the last its end."""
    rows, jet = part.rows, surface.values(part.rows)
    # by the size of all the part: what lies on a table that comes through z = 0 is known no better there
    scale = max(float((np.abs(jet[:, 1:-1]) * np.abs(rows[:, :-1])).sum(axis=1).max()), float(np.abs(jet[:, 0]).max()))
    turns = surface.shift(jet[:, 0])
    values = np.where(np.abs(jet[:, 0] - turns) <= ZERO * scale, turns, jet[:, 0])
    shift = surface.shift(0.5 * (values[:-1] + values[1:]))
    left, right = values[:-1] - shift, values[1:] - shift
    (where,) = np.nonzero(surface.is_crossed(left, right) & np.isfinite(left + right))
    found = rows[:0]
    if len(where):
        series = quintics(part.problem, rows[where], rows[where + 1])
        ends = np.zeros(len(where)), np.ones(len(where))
        found = refined(Brackets(where, series, *ends, left[where], right[where], shift[where]), surface).rows
    n = part.problem.degrees
    change = rows[1] - rows[0]
    slope = float(jet[0, 1 : 1 + n] @ rows[0, n : 2 * n] + jet[0, -1] + jet[0, 1 + n : -1] @ change[n:-1] / change[-1])
    begins = bool(values[0] == turns[0] and slope * (surface.direction or np.sign(slope)) > 0.0)
    if begins:
        found = np.concatenate([rows[:1], found])
    return found, begins, bool(len(where) and where[-1] == len(left) - 1 and right[-1] == 0.0)
