"""Where a scene can rest, or move steadily: Newton's method for the places at which forces vanish.

Nothing here depends on units or on where coordinates begin: all is told in how far a motion goes.
Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §6.1; Lurie, Analytical Mechanics, ch. 7 (steady motion).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...mechanics.coordinate import Coordinate
from ...mechanics.scene import Scene
from ...simulation.problem import Floats, Problem
from ...simulation.stiffness import eigenvalues
from .distance import Yardstick
from .mean import Mean
from .momenta import Conserved

# In the units in which coordinates change by as much as the motion does (`Yardstick.units`):
TRIES, NUDGE, CLOSE, STILL = 120, 1e-6, 1e-10, 1e-7
FAR, SMALL = 100.0, 1e-8  # where the search ends; a value that is zero but for rounding
GROWS = 1e-3  # real part of an eigenvalue, relative to the largest, that differences cannot explain
REGULAR = 1e10  # condition of M


@dataclass(frozen=True)
class Steady:
    """The forces on a scene at rest except for its cyclic coordinates, whose momenta are given."""

    scene: Scene
    full: Yardstick
    conserved: Conserved
    mean: Mean

    @classmethod
    def of(cls, scene: Scene, full: Yardstick) -> Steady:
        """The steady motions of a scene whose motion is `full`."""
        return cls(scene, full, Conserved.of(scene), Mean.of(scene, full.problem.t_end))

    @property
    def problem(self) -> Problem:
        """The initial value problem of the full motion."""
        return self.full.problem

    @cached_property
    def _units(self) -> Floats:
        """How far to go at once."""
        return self.full.wide_units

    @cached_property
    def _moving(self) -> np.ndarray:
        return np.flatnonzero(~self._is_cyclic)

    @cached_property
    def _moments(self) -> tuple[Floats, Floats]:
        """Times and weights of the mean; one time where nothing changes."""
        here = self.full.states[0, : self.problem.degrees]
        return (self.mean.times, self.mean.weights) if self._changes(here) else (np.zeros(1), np.ones(1))

    @cached_property
    def _strength(self) -> float:
        """The largest force, times the unit of its coordinate, that is met where the search begins."""
        works = (np.abs(self.force(start)).max(initial=0.0) for start in self.starts())
        return max((work for work in works if np.isfinite(work)), default=0.0)

    @cached_property
    def _is_cyclic(self) -> np.ndarray:
        return np.array([each.name in self.conserved.names for each in self.scene.free])

    def rates(self, place: Floats, rates: Floats) -> Floats:
        """The rates given, but those of the cyclic coordinates such that their momenta are as they were.

        `place` (q), `rates` and what is returned have shape (n,).
        """
        found = self.conserved.rates(np.zeros(1), np.concatenate([place, rates])[None])
        return np.asarray(found[0])

    def force(self, place: Floats) -> Floats:
        """The mean over time of the forces on the coordinates that are not cyclic, times the units of these, in J.

        `place` (q) has shape (n,); returns shape (moving,).
        """
        rates = self.rates(place, np.zeros(len(place)))
        times, weights = self._moments
        states = np.tile(np.concatenate([place, rates]), (len(times), 1))
        forces = self.problem.system(times, states).forces
        return np.asarray((weights @ forces * self._units)[self._moving])

    def settled(self, start: Floats) -> Floats | None:
        """Where the forces vanish, by Newton's method from a start, shape (n,); None if it does not get there.

        Far away forces only fade; and where M has no inverse nothing can be said of the motion.
        """
        if self._is_cyclic.all():
            return start
        place = start
        for _ in range(TRIES):
            force = self.force(place)
            if not np.isfinite(force).all() or np.abs((place - start) / self._units).max() > FAR:
                return None
            moved = self._stepped(place, force)
            if np.all(np.abs(moved - place) <= CLOSE * (self._units + np.abs(place))):
                is_still = np.abs(force).max() <= STILL * self._strength
                rounded = np.where(np.abs(moved) < SMALL * self._units, 0.0, moved)
                return rounded if is_still and self._is_regular(moved) else None
            place = moved
        return None

    def _is_regular(self, place: Floats) -> bool:
        state = np.concatenate([place, np.zeros(len(place))])[None]
        mass = self.problem.system(np.zeros(1), state).mass[0] * np.outer(self._units, self._units)
        return bool(np.isfinite(mass).all() and np.linalg.cond(mass) < REGULAR)

    def _stepped(self, place: Floats, force: Floats) -> Floats:
        """One step, no longer than half a unit."""
        step = -np.linalg.lstsq(self._slopes(place), force, rcond=1e-9)[0]
        shrink = min(1.0, 0.5 / max(float(np.abs(step).max()), 1e-300))
        moved = place.copy()
        moved[self._moving] += shrink * step * self._units[self._moving]
        return moved

    def _slopes(self, place: Floats) -> Floats:
        """Of the forces, over the coordinates that are not cyclic, both in units."""
        nudges = (NUDGE * np.diag(self._units))[self._moving]
        columns = [(self.force(place + nudge) - self.force(place - nudge)) / (2 * NUDGE) for nudge in nudges]
        slopes = np.array(columns).T
        return slopes if np.isfinite(slopes).all() else np.zeros_like(slopes)

    def lasts(self, place: Floats) -> bool:
        """Whether no small deviation from `place`, shape (n,), grows, as far as the laws at the start tell.

        Unasked where they change.
        """
        if self._changes(place):
            return True
        found = eigenvalues(self.problem, 0.0, np.concatenate([place, self.rates(place, np.zeros(len(place)))]))
        return bool(found.real.max() <= GROWS * np.abs(found).max())

    def _changes(self, place: Floats) -> bool:
        """Whether the laws depend on time; guides that turn evenly need not make them so."""
        times, n = self.mean.times, self.problem.degrees
        states = np.tile(np.concatenate([place + 0.1 * self._units, np.zeros(n)]), (len(times), 1))
        table = self.problem.model.motion.table(self.problem.inputs(times, states))[:, : n * (n + 1) // 2 + n]
        rows, columns = np.tril_indices(n)
        scaled = table * np.concatenate([self._units[rows] * self._units[columns], self._units])
        return any(np.ptp(part, axis=0).max() > CLOSE * np.abs(part).max() for part in np.split(scaled, [-n], axis=1))

    def starts(self) -> Iterator[Floats]:
        """The initial q, shape (n,), and others within the motion and within the ranges of the coordinates.

        None of them depends on where the coordinates begin.
        """
        places = self.full.states[:, : self.problem.degrees]
        for found in self._somewhere(places):
            yield np.where(self._is_cyclic, places[0], found)

    def _somewhere(self, places: Floats) -> Iterator[Floats]:
        yield places[0]
        yield places.mean(axis=0)
        ranges = np.array([_range(each, unit) for each, unit in zip(self.scene.free, self._units, strict=True)])
        for low, high in ((places.min(axis=0), places.max(axis=0)), (ranges[:, 0], ranges[:, 1])):
            yield from (low + part * (high - low) for part in (0.25, 0.5, 0.75))


def _range(coordinate: Coordinate, unit: float) -> tuple[float, float]:
    low = coordinate.value - unit if coordinate.min is None else coordinate.min
    high = coordinate.value + unit if coordinate.max is None else coordinate.max
    return low, high
