"""How far two motions are apart, in one norm for all rungs: metres, in the metric of the kinetic energy,

    d² = Δqᵀ M(q) Δq / m,   Δq = q of the rung − q of the full model,   m the mass of all bodies;

for angles the chord 2 sin(Δφ/2), so that one that is off by a whole turn is right. Coordinates may jump where nothing
else does, as the azimuth at a pole: where all bodies are particles, d is no more than thrice the distance in space.

E = ½ q̇ᵀ M q̇ makes M the metric of the configuration space, so to first order d is the root mean square distance, over
all mass, between where a particle is and where the rung puts it. Angles and lengths come in one unit, heavy parts
count for more, and no coordinate is invisible, as the spin of a top is in the position of its centre of mass.

What an error is measured against must not depend on the observer: see `Yardstick.extent` and `drift.py`.
Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §8.6 (the metric); Lurie, Analytical Mechanics, ch. 4.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from ...simulation.problem import Floats, Problem
from .drift import Directions, directions, drift

IN_SPACE = 3.0  # times the distance in space that one by coordinates may be
NOISE = 1e-13  # rounding of a coordinate, relative to its size


@dataclass(frozen=True)
class Accuracy:
    """How finely motions are computed: the tolerance of the integration, and the number of even samples."""

    tolerance: float
    samples: int


@dataclass(frozen=True)
class Yardstick:
    """The full motion at `times`, shape (samples,), that rungs are measured against, and how accurate it is.

    `states` (q, q̇) has shape (samples, 2n); `mass` is that of all bodies. `floor` is the error of the integration as
    it measures it: absolute for coordinates below 1, relative above. `radians` holds for each coordinate how many there
    are in its unit, 0 for lengths. `accuracy` is that of the rungs to compare. `particles` are the masses of the bodies
    by name if all of them are particles, else there are none.
    """

    problem: Problem
    mass: float
    times: Floats
    states: Floats
    floor: float
    radians: tuple[float, ...]
    accuracy: Accuracy
    particles: Mapping[str, float] = field(default_factory=dict)

    def errors(self, values: Mapping[str, Floats]) -> Floats:
        """d in metres at each sample that a rung has in common with the full motion: shape (samples,).

        `values` has the rung's coordinates by name, shape (samples,) each.
        """
        count = min(len(self.times), *(len(each) for each in values.values()))
        rung = np.column_stack([values[name][:count] for name in self.problem.model.layout.free])
        return self.distances(rung)

    def distances(self, rung: Floats) -> Floats:
        """d in metres at each of the first samples, from coordinates of shape (samples, n): shape (samples,)."""
        found = self.lengths(rung - self.values[: len(rung)])
        return np.asarray(np.minimum(found, IN_SPACE * self._in_space(rung))) if self.particles else found

    def until(self, end: float, floor: float) -> Yardstick:
        """The motion up to a time, with the error that the integration makes up to there."""
        kept = self.times <= end
        return replace(self, times=self.times[kept], states=self.states[kept], floor=floor)

    def at(self, places: np.ndarray) -> Yardstick:
        """The motion at some of its samples, given by their numbers, shape (chosen,)."""
        return replace(self, times=self.times[places], states=self.states[places])

    def steps(self, lengths: Floats, places: np.ndarray) -> Floats:
        """Changes of each coordinate that move the mass by `lengths`, shape (chosen,), at these samples.

        `places` are their numbers, shape (chosen,); returns shape (chosen, n), no angle more than a radian.
        """
        arms = np.sqrt(np.maximum(np.einsum("tii->ti", self.masses[places]), 0.0) / self.mass)
        wide = np.broadcast_to(self.wide_units, arms.shape)
        return np.asarray(np.minimum(wide, np.divide(lengths[:, None], arms, out=wide.copy(), where=arms > 0.0)))

    def _in_space(self, values: Floats) -> Floats:
        """The root mean square distance, over all mass, between the particles and where other values put them."""
        count, n = len(values), self.problem.degrees
        there, here = self._positions(np.hstack([values, self.states[:count, n : 2 * n]])), self._positions(self.states)
        squares = (
            mass * np.sum((there[name] - here[name][:count]) ** 2, axis=1) for name, mass in self.particles.items()
        )
        return np.asarray(np.sqrt(sum(squares) / self.mass))

    def _positions(self, states: Floats) -> Mapping[str, Floats]:
        inputs = self.problem.inputs(self.times[: len(states)], states[:, : 2 * self.problem.degrees])
        return self.problem.model.observe(inputs).positions

    @property
    def end(self) -> float:
        """When the motion ends; 0 if it could not begin."""
        return float(self.times[-1]) if len(self.times) else 0.0

    @cached_property
    def extent(self) -> float:
        """How far the motion gets from uniform motion, in metres; 0 where no more is left than the integration errs by.

        Uniform motion that a moving observer would not see, and the even drift of coordinates on whose values nothing
        depends, is taken away (`drift.py`): it would grow with the span and make every error small beside it.
        """
        found = self._reach(self.values - np.outer(self.times, self._drift))
        return found if found > max(self.uncertainty(self.floor), self._noise) else 0.0

    def uncertainty(self, worst: float) -> float:
        """An error in the measure of the integration's tolerance, in metres: no less than it can be."""
        sizes = np.maximum(1.0, np.abs(self.values).max(axis=0, initial=0.0))
        return worst * float(self._arms @ sizes)

    @cached_property
    def size(self) -> float:
        """A length to measure by: the extent or, at rest, that of a turn by a radian or of the coordinates' values;
        not finite where masses or motions are beyond all numbers.
        """
        if self.extent > 0.0:
            return self.extent
        turns = self._arms * self._in_radians
        values = np.abs(self.values).max(axis=0, initial=0.0)
        candidates = (turns.max(initial=0.0), self._reach(self.values), (self._arms * values).max(initial=0.0), 1.0)
        return float(next((each for each in candidates if each > self._noise), self._noise))

    @cached_property
    def units(self) -> Floats:
        """For each coordinate the change that moves the mass by `size`; no more than a radian: shape (n,)."""
        return self._units(self.size)

    def apart(self, one: Floats, other: Floats) -> float:
        """√(Δqᵀ M Δq / m) in metres of two places, shape (n,) each, M that of the start; angles count in full."""
        step = one - other
        return float(np.sqrt(max(0.0, step @ self.masses[0] @ step) / self.mass))

    def tolerance(self, usual: float, enough: float) -> float:
        """The tolerance at which each coordinate is right to `enough` of its unit; the usual one if that will do."""
        sizes = np.maximum(1.0, np.abs(self.values).max(axis=0, initial=0.0))
        return float(min(usual, enough * np.min(self.units / sizes, initial=1.0)))

    @cached_property
    def wide_units(self) -> Floats:
        """For each angle a radian; for each length what moves the mass as far, or by `size` if that is more.

        Returns shape (n,).
        """
        turns = self._in_radians
        wide = self._units(max(self.size, float((self._arms * turns).max(initial=0.0))))
        return np.where(turns > 0.0, turns, wide)

    @property
    def can_be_boosted(self) -> np.ndarray:
        """Which coordinates may be given another rate without any other consequence: shape (n,)."""
        return self._directions.can_be_boosted()

    @cached_property
    def _directions(self) -> Directions:
        return directions(self.problem, self.times, self.states, self._raw_units, self._in_radians == 0.0)

    @cached_property
    def _raw_units(self) -> Floats:
        """By all of the motion, its drift included."""
        wide = self._reach(self.values)
        return self._units(wide if wide > self._noise else 1.0)

    @cached_property
    def _drift(self) -> Floats:
        """The rates of the uniform motion that is no extent."""
        along = self._raw_units[:, None] * self._directions.both
        return drift(self.times, self.states, self.masses, along)

    @property
    def values(self) -> Floats:
        """The coordinates q: shape (samples, n)."""
        return self.states[:, : self.problem.degrees]

    @cached_property
    def masses(self) -> Floats:
        """M(q, t) along the motion: shape (samples, n, n)."""
        return self.problem.system(self.times, self.states).mass

    @cached_property
    def _arms(self) -> Floats:
        """Metres for each unit of a coordinate: √(Mᵢᵢ/m), the largest of the motion."""
        diagonals = np.einsum("tii->ti", self.masses)
        return np.asarray(np.sqrt(np.maximum(diagonals, 0.0).max(axis=0, initial=0.0) / self.mass))

    @property
    def _in_radians(self) -> Floats:
        """1 rad in the unit of each angle, 0 for lengths."""
        radians = np.array(self.radians)
        return np.asarray(np.divide(1.0, radians, out=np.zeros_like(radians), where=radians > 0.0))

    def _units(self, size: float) -> Floats:
        arms = self._arms
        found = np.divide(size, arms, out=np.full_like(arms, size), where=arms > 0.0)
        return np.where(self._in_radians > 0.0, np.minimum(found, self._in_radians), found)

    @property
    def _noise(self) -> float:
        """What rounding alone makes of the coordinates, in metres."""
        return NOISE * float(self._arms @ np.abs(self.values).max(axis=0, initial=0.0))

    def _reach(self, values: Floats) -> float:
        """How far values get from the first of them."""
        return float(self.lengths(values - values[:1]).max(initial=0.0))

    def lengths(self, steps: Floats, places: np.ndarray | None = None) -> Floats:
        """The lengths in metres of differences `steps`, shape (count, n), from the full motion: shape (count,).

        They are those from its first samples, or from those at `places`, shape (count,).
        """
        masses = self.masses[: len(steps)] if places is None else self.masses[places]
        radians = np.array(self.radians)
        turn = np.where(radians > 0.0, radians, 1.0)
        apart = np.where(radians > 0.0, 2.0 / turn * np.sin(steps * turn / 2.0), steps)
        squares = np.einsum("ti,tij,tj->t", apart, masses, apart)
        return np.asarray(np.sqrt(np.maximum(squares, 0.0) / self.mass))
