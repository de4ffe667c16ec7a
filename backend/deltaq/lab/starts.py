"""Starts in a plane of section: a grid over two components of the state, at one energy where it is kept.

The plane gives one component, the energy a rate, in which it is quadratic; all others are those of the scene's own
start. The grid covers what the energy allows around the state of least energy, or, where something drives the scene,
what its own motion covers. A grid that is even in the plane makes parts of the starts parts of its area.
Source: Hénon, Heiles, Astron. J. 69 (1964) 73–79, §3.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..simulation.march import Truths
from ..simulation.problem import Floats, Problem
from .plane import Section

SOLVING = 30  # rounds of Newton's method, and of plane and energy in turn
SOLVED = 1e-9  # what is left of the plane and of the energy, over their scales
SIDE, FINE = 21, 61  # points on a side of the lattices by which the box of the starts is sought
ROUNDS = 40  # of looking for the least energy, and of letting a box grow
FARTHEST, OPEN = 1e3, 2.0  # over what the scene's own motion covers; and where the energy sets no bound
BESIDE = 1.5  # the same, for where the least energy is sought
LEAST = 1e-3  # of a box beside what its coordinate is at the start


@dataclass(frozen=True)
class Starts:
    """`states` (q, q̇), shape (starts, 2n); how many of the grid need more energy, and of how many none was found."""

    states: Floats
    forbidden: int
    unsolved: int


@dataclass(frozen=True)
class Box:
    """The `middle` of a rectangle and `half` its sides, shape (2,) each."""

    middle: Floats
    half: Floats

    def lattice(self, count: int, *, with_edges: bool = True) -> Floats:
        """Points evenly over it, shape (count², 2): up to its edges, or in the middles of so many cells."""
        end = 1.0 if with_edges else 1.0 - 1.0 / count
        side = np.linspace(-end, end, count)
        x, y = np.meshgrid(side, side)
        return self.middle + self.half * np.column_stack([x.ravel(), y.ravel()])


@dataclass(frozen=True)
class Grid:
    """Starts in a section; `path`, shape (steps, 2n + 1), is the motion from the scene's own start as (q, q̇, t)."""

    section: Section
    path: Floats

    @property
    def _problem(self) -> Problem:
        return self.section.problem

    @property
    def own(self) -> Floats:
        """The scene's own start, shape (2n,)."""
        return self._problem.state[: 2 * self._problem.degrees]

    @cached_property
    def by_plane(self) -> int | None:
        """The component that the plane gives: a coordinate, or else a rate; none where only the time decides."""
        places = self.section.function.places
        return places[0] if places and not self.section.is_driven else None

    @cached_property
    def by_energy(self) -> int | None:
        """The rate that the energy gives: that of the plane's coordinate, or of one beside it."""
        n, plane = self._problem.degrees, self.by_plane
        if self.section.is_driven:
            return None
        if plane is not None and plane < n:
            return n + plane
        plotted = self.section.places
        free = [place for place in range(n, 2 * n) if place != plane]
        return next((place for place in free if place not in plotted), free[0])

    @cached_property
    def across(self) -> tuple[int, int]:
        """The two components over which the grid is spread: those plotted, as far as they are free."""
        n = self._problem.degrees
        free = [place for place in range(2 * n) if place not in (self.by_plane, self.by_energy)]
        plotted = [place for place in self.section.places if place in free]
        first, second, *_ = dict.fromkeys([*plotted, *free])
        return first, second

    def energy_at(self, states: Floats) -> Floats:
        """The energy of states, shape (…, 2n), at the time 0."""
        rows = np.column_stack([states, np.zeros(len(states))])
        return self.section.at(rows)[:, 2]

    def starts(self, count: int, energy: float | None) -> Starts:
        """A grid of so many starts on a side, at an energy if there is one."""
        width = len(self.own)
        if count == 0:
            return Starts(np.zeros((0, width)), 0, 0)
        if energy is None:
            states = np.tile(self.own, (count * count, 1))
            states[:, list(self.across)] = self.covered.lattice(count, with_edges=False)
            return Starts(states, 0, 0)
        box = self.allowed(energy)
        states, needed = self.solved(box.lattice(count, with_edges=False), energy)
        forbidden = needed > energy
        good = np.isfinite(states).all(axis=1)
        return Starts(states[good], int(forbidden.sum()), int((~good & ~forbidden).sum()))

    @cached_property
    def covered(self) -> Box:
        """What the scene's own motion covers, at least a little; of an angle no more than a turn."""
        seen = self.path[:, list(self.across)]
        low, high = seen.min(axis=0), seen.max(axis=0)
        middle, half = 0.5 * (low + high), 0.5 * (high - low)
        half = np.where(half > LEAST * np.maximum(1.0, np.abs(middle)), half, 1.0)
        winds = (half > math.pi) & self._is_angle
        return Box(np.where(winds, 0.0, middle), np.where(winds, math.pi, half))

    @property
    def _is_angle(self) -> Truths:
        n = self._problem.degrees
        return np.array([place < n and self._problem.angular[place] for place in self.across])

    @cached_property
    def lowest(self) -> tuple[Floats, float]:
        """Where near the scene's own motion the least energy is needed, shape (2,), and that energy.

        A lattice that shrinks finds it.
        """
        whole = Box(self.covered.middle, BESIDE * self.covered.half)
        middle, least, half = whole.middle, math.inf, whole.half
        for _ in range(ROUNDS):
            points = np.clip(Box(middle, half).lattice(SIDE), whole.middle - whole.half, whole.middle + whole.half)
            _, needed = self.solved(points, math.inf)
            best = int(np.argmin(needed))
            if needed[best] < least:
                middle, least = points[best], float(needed[best])
            half = 0.5 * half
        return middle, least

    def allowed(self, energy: float) -> Box:
        """The rectangle around what the energy allows, as far as it hangs together with where the least is needed."""
        middle, least = self.lowest
        if not energy > least:
            return Box(middle, np.zeros(2))
        limit = np.where(self._is_angle, math.pi, FARTHEST * np.maximum(self.covered.half, 1.0))
        box = Box(middle, np.minimum(1e-2 * self.covered.half, limit))
        for _ in range(ROUNDS):
            grows = self._is_open(box, energy) & (box.half < limit)
            if not grows.any():
                break
            box = Box(middle, np.minimum(np.where(grows, 1.5 * box.half, box.half), limit))
        is_bounded = self._is_angle | (box.half < limit)
        return self._shrunk(Box(middle, np.where(is_bounded, box.half, OPEN * self.covered.half)), energy)

    def _is_open(self, box: Box, energy: float) -> Truths:
        """Whether the energy allows anything on the sides across and upwards."""
        _, needed = self.solved(box.lattice(SIDE), energy)
        is_in = (needed <= energy).reshape(SIDE, SIDE)
        return np.array([is_in[:, [0, -1]].any(), is_in[[0, -1], :].any()])

    def _shrunk(self, box: Box, energy: float) -> Box:
        """The rectangle around all points of a lattice that are allowed, half a cell wider."""
        points = box.lattice(FINE)
        _, needed = self.solved(points, energy)
        is_in = points[needed <= energy]
        if not len(is_in):
            return box
        low, high = is_in.min(axis=0), is_in.max(axis=0)
        cell = 2.0 * box.half / (FINE - 1)
        return Box(0.5 * (low + high), np.minimum(0.5 * (high - low) + 0.5 * cell, box.half))

    def solved(self, points: Floats, energy: float) -> tuple[Floats, Floats]:
        """States in the plane at an energy over points, shape (points, 2), and the energy that each needs at least.

        A state that is not found is NaN; the energy needed where the plane is not met is infinite.
        """
        states = np.tile(self.own, (len(points), 1))
        states[:, list(self.across)] = points
        needs_rounds = any(place >= self._problem.degrees for place in self.section.function.places)
        with np.errstate(all="ignore"):
            for _ in range(SOLVING if needs_rounds else 1):
                states = self._in_plane(states)
                states, needed = self._at_energy(states, energy)
            values = self._plane(states)
            left = np.abs(values[:, 0]) > SOLVED * (np.abs(values[:, 1:-1]) * np.abs(states)).sum(axis=1) + 1e-15
            apart = np.abs(self.energy_at(states) - energy) > SOLVED * np.maximum(abs(energy), np.abs(needed))
        missed = ~np.isfinite(needed) | (left if self.by_plane is not None else False)
        needed = np.where(missed, math.inf, needed)
        states[missed | apart | (needed > energy)] = np.nan
        return states, needed

    def _plane(self, states: Floats) -> Floats:
        """h with its derivatives at the time 0."""
        return self.section.function.jet.table(np.column_stack([states, np.zeros(len(states))]))

    def _in_plane(self, states: Floats) -> Floats:
        """The component that the plane gives, by Newton's method."""
        place, found = self.by_plane, states.copy()
        if place is None:
            return found
        for _ in range(SOLVING):
            values = self._plane(found)
            change = values[:, 0] / values[:, 1 + place]
            found[:, place] -= change
            if not (np.abs(change) > 1e-16 * np.maximum(1.0, np.abs(found[:, place]))).any():
                break
        return found

    def _at_energy(self, states: Floats, energy: float) -> tuple[Floats, Floats]:
        """The rate that the energy gives, by the root with which h goes the way wanted; and the energy needed."""
        place = self.by_energy
        if place is None:
            raise LookupError("what is driven keeps no energy")
        found, values = states.copy(), []
        for rate in (0.0, 1.0, -1.0):
            found[:, place] = rate
            values.append(self.energy_at(found))
        c, a, b = values[0], 0.5 * (values[1] + values[2]) - values[0], 0.5 * (values[1] - values[2])
        needed = c - b * b / (4.0 * a)
        if math.isinf(energy):
            found[:, place] = -b / (2.0 * a)
            return found, needed
        root = np.sqrt(np.maximum(energy - needed, 0.0) / a)
        for sign in (-1.0, 1.0):
            other = states.copy()
            other[:, place] = -b / (2.0 * a) + sign * root
            better = self._goes_right(other) if sign > 0.0 else np.ones(len(other), dtype=bool)
            found = np.where(better[:, None], other, found) if sign > 0.0 else other
        return found, needed

    def _goes_right(self, states: Floats) -> Truths:
        """Whether h goes the way wanted: by what of ḣ the rates make, that of the accelerations left out."""
        n = self._problem.degrees
        values = self._plane(states)
        speed = (values[:, 1 : 1 + n] * states[:, n:]).sum(axis=1)
        return np.asarray(speed * (self.section.surface.direction or 1) >= 0.0)
