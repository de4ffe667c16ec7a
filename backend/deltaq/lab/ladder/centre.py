"""The state that amplitudes are counted from: rest, or steady motion where coordinates are cyclic.

The other coordinates stay at values q₀ at which their forces vanish, f(q₀, q̇_c, t) = 0 with the cyclic rates q̇_c that
the conserved momenta p ask for; where the laws depend on time, the mean of f (`mean.py`) vanishes.
Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §6.1; Lurie, Analytical Mechanics, ch. 7 (steady motion).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ...mechanics.coordinate import Coordinate
from ...mechanics.scene import Scene
from ...simulation.problem import Floats, Problem
from ...simulation.service import problem_of
from ...simulation.stiffness import eigenvalues
from .distance import mass_matrices
from .mean import Mean
from .momenta import Conserved

TRIES, NUDGE, CLOSE, STILL = 120, 1e-6, 1e-10, 1e-7
FAR, SMALL = 100.0, 1e-8  # times the size of the start; a value that is zero but for rounding
GROWS = 1e-3  # real part of an eigenvalue, relative to the largest, that differences cannot explain
REGULAR = 1e10  # condition of M


@dataclass(frozen=True)
class Centre:
    """A scene's own initial state, seen from its centre.

    `values` are those of all free coordinates at rest; in steady motion, of those that are not cyclic.
    """

    scene: Scene
    span: float
    values: Mapping[str, float]

    @cached_property
    def _steady(self) -> _Steady:
        return _Steady.of(self.scene, self.span)

    def at(self, amplitude: float) -> Scene:
        """The scene with the deviation from the centre that many times larger, and the same momenta."""
        steady, free = self._steady, self.scene.free
        place = np.array([_scaled(each.value, self.values.get(each.name, each.value), amplitude) for each in free])
        rates = steady.rates(place, amplitude * np.array([each.rate for each in free]))
        found = {c.name: (float(q), float(v)) for c, q, v in zip(free, place, rates, strict=True)}
        return replace(self.scene, coordinates=tuple(_set(each, found) for each in self.scene.coordinates))


def centre_of(scene: Scene, span: float) -> Centre | None:
    """The centre of a scene nearest to its initial state; one at which nothing grows, if there is such a one."""
    steady = _Steady.of(scene, span)
    found = [place for start in steady.starts() if (place := steady.settled(start)) is not None]
    if not found:
        return None
    here = np.array([each.value for each in scene.free])
    nearest = min(found, key=lambda place: (not steady.lasts(place), float(np.abs(place - here).max())))
    stays = not np.any(np.abs(steady.rates(nearest, np.zeros(len(nearest)))) > CLOSE)
    kept = [each.name for each in scene.free if stays or each.name not in steady.conserved.names]
    values = dict(zip((each.name for each in scene.free), nearest.tolist(), strict=True))
    return Centre(scene, span, {name: values[name] for name in kept})


def _scaled(value: float, rest: float, amplitude: float) -> float:
    return value if amplitude == 1.0 else rest + amplitude * (value - rest)


def _set(coordinate: Coordinate, found: Mapping[str, tuple[float, float]]) -> Coordinate:
    """The coordinate with its initial value and rate; the range of the slider gives way."""
    value, rate = found.get(coordinate.name, (coordinate.value, coordinate.rate))
    low = None if coordinate.min is None else min(coordinate.min, value)
    high = None if coordinate.max is None else max(coordinate.max, value)
    return replace(coordinate, value=value, rate=rate, min=low, max=high)


@dataclass(frozen=True)
class _Steady:
    """The forces on a scene that stands still but for its cyclic coordinates, whose momenta are given."""

    scene: Scene
    problem: Problem
    conserved: Conserved
    mean: Mean

    @classmethod
    def of(cls, scene: Scene, span: float) -> _Steady:
        problem = problem_of(scene, span)
        return cls(scene, problem, Conserved.of(scene, problem), Mean.of(scene, span))

    @cached_property
    def _is_cyclic(self) -> np.ndarray:
        return np.array([each.name in self.conserved.names for each in self.scene.free])

    def rates(self, place: Floats, rates: Floats) -> Floats:
        """The rates given, but those of the cyclic coordinates such that their momenta are as they were."""
        found = self.conserved.rates(np.zeros(1), np.concatenate([place, rates])[None])
        return np.asarray(found[0])

    def force(self, place: Floats) -> Floats:
        """The mean over time of the forces on the coordinates that are not cyclic."""
        rates = self.rates(place, np.zeros(len(place)))
        times = self.mean.times
        states = np.tile(np.concatenate([place, rates]), (len(times), 1))
        n = self.problem.degrees
        first = n * (n + 1) // 2
        table = self.problem.model.motion.table(self.problem.inputs(times, states))[:, first : first + n]
        return np.asarray((self.mean.weights @ table)[~self._is_cyclic])

    def settled(self, start: Floats) -> Floats | None:
        """Where the forces vanish, by Newton's method from a start; None if it does not get there.

        Far away forces only fade; and where M has no inverse nothing can be said of the motion.
        """
        if self._is_cyclic.all():
            return start
        place, far = start, FAR * (1.0 + float(np.abs(start).max()))
        first = float(np.abs(self.force(start)).max())
        for _ in range(TRIES):
            force = self.force(place)
            if not np.isfinite(force).all() or np.abs(place).max() > far:
                return None
            moved = self._stepped(place, force)
            if np.abs(moved - place).max() <= CLOSE * (1.0 + np.abs(place).max()):
                is_still = np.abs(force).max() <= STILL * max(first, 1.0)
                return np.where(np.abs(moved) < SMALL, 0.0, moved) if is_still and self._is_regular(moved) else None
            place = moved
        return None

    def _is_regular(self, place: Floats) -> bool:
        state = np.concatenate([place, np.zeros(len(place))])[None]
        mass = mass_matrices(self.problem, np.zeros(1), state)[0]
        return bool(np.isfinite(mass).all() and np.linalg.cond(mass) < REGULAR)

    def _stepped(self, place: Floats, force: Floats) -> Floats:
        """One step, no longer than half a radian or half the size of the place."""
        moving = np.flatnonzero(~self._is_cyclic)
        step = -np.linalg.lstsq(self._slopes(place), force, rcond=1e-9)[0]
        longest = 0.5 * max(1.0, float(np.abs(place).max()))
        shrink = min(1.0, longest / max(float(np.abs(step).max()), 1e-300))
        moved = place.copy()
        moved[moving] += shrink * step
        return moved

    def _slopes(self, place: Floats) -> Floats:
        columns = []
        for index in np.flatnonzero(~self._is_cyclic):
            nudge = NUDGE * np.eye(len(place))[index]
            columns.append((self.force(place + nudge) - self.force(place - nudge)) / (2 * NUDGE))
        slopes = np.array(columns).T
        return slopes if np.isfinite(slopes).all() else np.zeros_like(slopes)

    def lasts(self, place: Floats) -> bool:
        """Whether no small deviation grows, as far as the laws at the start tell; unasked where they change."""
        if self._changes(place):
            return True
        found = eigenvalues(self.problem, 0.0, np.concatenate([place, self.rates(place, np.zeros(len(place)))]))
        return bool(found.real.max() <= GROWS * np.abs(found).max())

    def _changes(self, place: Floats) -> bool:
        """Whether the laws depend on time; guides that turn evenly need not make them so."""
        times = self.mean.times
        states = np.tile(np.concatenate([place + 0.1, np.zeros(len(place))]), (len(times), 1))
        table = self.problem.model.motion.table(self.problem.inputs(times, states))
        return bool(np.ptp(table, axis=0).max() > CLOSE * np.abs(table).max())

    def starts(self) -> Iterator[Floats]:
        """The initial state, the origin, and a few others within the coordinates' ranges."""
        here = np.array([each.value for each in self.scene.free])
        yield here
        yield np.zeros(len(here))
        for part in (0.25, 0.5, 0.75):
            yield np.array([_between(each, part) for each in self.scene.free])


def _between(coordinate: Coordinate, part: float) -> float:
    low = coordinate.value - 1.0 if coordinate.min is None else coordinate.min
    high = coordinate.value + 1.0 if coordinate.max is None else coordinate.max
    return low + part * (high - low)
