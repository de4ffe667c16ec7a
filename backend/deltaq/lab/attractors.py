"""Attractors: rests and periodic motions that neighbours come to, and which of them a motion has come to.

A scene is looked at once in each period of its drive, or, where nothing drives it, in equal times: an attractor is a
fixed point of that map, or of its second, third or fourth power, whose Floquet multipliers all are below 1 in size. It
is found by Newton's method from where a motion has settled. Closed orbits of what nothing drives: see `limit_cycle`.
Source: Seydel, Practical Bifurcation and Stability Analysis, ch. 7; McDonald, Grebogi, Ott, Yorke, Physica D 17 (1985).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from ..simulation.ensemble import Ensemble, run_ensemble
from ..simulation.march import Integers, Truths
from ..simulation.problem import Floats, Problem
from .limit_cycle import limit_cycle
from .propagation import Propagation, propagated

LOOKS = 8  # in the span, where nothing drives the scene
PERIODS = 4  # of the drive, after which a motion may repeat itself, at most
NEAR, APART = 0.02, 0.3  # of what the motions cover; of the way to the next attractor
ALIKE = 1e-4  # of what the motions cover: attractors that are closer are one
SETTLED = 0.02  # of what the motions cover: change after a period
NEWTON, SOLVED = 8, 1e-9
NEIGHBOUR = 0.01  # of the largest component: how far away states are that come to the same
BELOW = 1e-6  # 1 less a multiplier that contracts
MOST, MOST_WITHOUT = 16, 12  # attractors; motions near which no closed orbit is found, in vain
IN_VAIN = 24  # looks one after the other that find none, until the motions go on: slow ones seem to settle anywhere
TOLERANCE = 1e-8
NONE, ENDED = -1, -2
AGAIN = 3  # times that what has not settled goes on


@dataclass(frozen=True)
class Attractor:
    """The `states` that it goes through, and the largest Floquet multiplier by its `size`, over so many `seconds`.

    `states` has shape (periods, 2n), or, where the orbit `is_closed` by itself, (points, 2n): then they are the corners
    of a polygon, and nothing repeats before all of them are passed.
    """

    states: Floats
    size: float
    seconds: float
    is_closed: bool = False


@dataclass(frozen=True)
class Stroboscope:
    """A problem that is looked at in equal times: its span is `looks` of them; those of a drive if it `is_driven`."""

    problem: Problem
    looks: int
    is_driven: bool

    @property
    def period(self) -> float:
        """Seconds between two looks."""
        return self.problem.t_end / self.looks

    def apart(self, first: Floats, second: Floats) -> Floats:
        """Differences of states, shape (…, 2n), those of angles without whole turns."""
        found = np.asarray(first - second)
        turning = np.flatnonzero(self.problem.angular)
        found[..., turning] -= math.tau * np.round(found[..., turning] / math.tau)
        return found

    def seen(self, starts: Floats) -> Seen:
        """Where motions from `starts`, shape (motions, 2n), are at the last looks."""
        problem = replace(self.problem, samples=self.looks + 1)
        parameters = np.repeat([problem.parameters], len(starts), axis=0)
        found = run_ensemble(Ensemble(problem, np.ascontiguousarray(starts), parameters), TOLERANCE)
        states = np.concatenate([found.values, found.rates], axis=2)
        errors = np.nan_to_num(found.errors[:, -1].max(axis=1), nan=math.inf)
        return Seen(states[:, -1 - PERIODS :], errors, np.nanmax(np.abs(states), axis=(0, 1)))

    def attractor(self, start: Floats, periods: int) -> Attractor | None:
        """That near a state, shape (2n,); None where Newton's method finds none, or one that does not attract."""
        state = start.copy()
        for _ in range(NEWTON):
            flow = self._flow(state, periods)
            if len(flow.times) < 2 or not np.isfinite(flow.matrices[-1]).all():
                return None
            change = np.linalg.lstsq(
                flow.matrices[-1] - np.eye(len(state)), -self.apart(flow.states[-1], state), rcond=1e-12
            )[0]
            state = state + change
            if np.abs(change).max() <= SOLVED * max(1e-300, float(np.abs(state).max())):
                break
        flow = self._flow(state, periods)
        if len(flow.times) < 2 or not np.isfinite(flow.matrices[-1]).all():
            return None
        size = float(np.abs(np.linalg.eigvals(flow.matrices[-1])).max())
        stops = np.linspace(0, len(flow.times) - 1, periods + 1).astype(int)[:-1]
        return Attractor(flow.states[stops], size, periods * self.period) if size < 1.0 - BELOW else None

    def cycle(self, start: Floats) -> Attractor | None:
        """The closed orbit near a state, shape (2n,), that nothing drives; None where there is none that attracts."""
        found = limit_cycle(self.problem, start, self.apart)
        return Attractor(found.states, found.size, found.period, is_closed=True) if found else None

    def _flow(self, state: Floats, periods: int) -> Propagation:
        n, span = self.problem.degrees, periods * self.period
        values, rates = tuple(map(float, state[:n])), tuple(map(float, state[n:]))
        problem = replace(self.problem, values=values, rates=rates, t_end=span)
        near = NEIGHBOUR * (float(np.abs(state).max()) or 1.0)
        return propagated(problem, 2 * periods + 1, (), np.full(2 * n, near))


@dataclass(frozen=True)
class Seen:
    """The `states` at the last looks, shape (motions, PERIODS + 1, 2n), NaN of a motion that has ended.

    `errors`, shape (motions,), are those at the end; `sizes`, shape (2n,), how large the components have been.
    """

    states: Floats
    errors: Floats
    sizes: Floats


@dataclass(frozen=True)
class Landing:
    """What motions came to, numbers of attractors or NONE or ENDED: `basins`; `errors` at the end: shape (motions,)."""

    basins: Integers
    errors: Floats


class Search:
    """Where motions come to; it keeps the attractors that it has found, and what the motions cover."""

    def __init__(self, stroboscope: Stroboscope, sizes: Floats) -> None:
        self.stroboscope, self.attractors = stroboscope, list[Attractor]()
        self._sizes, self._refused = sizes, list[Floats]()
        self._without_cycle = 0

    def landed(self, starts: Floats) -> Landing:
        """Motions from `starts`, shape (motions, 2n): what has not settled goes on some times."""
        basins, errors = np.full(len(starts), NONE, dtype=np.int64), np.zeros(len(starts))
        states, which = starts, np.arange(len(starts))
        for _ in range(1 + AGAIN):
            seen = self.stroboscope.seen(states)
            self._sizes = np.maximum(self._sizes, np.nan_to_num(seen.sizes))
            found = self._assigned(seen.states)
            basins[which], errors[which] = found, np.maximum(errors[which], seen.errors)
            left = found == NONE
            if not left.any():
                break
            states, which = seen.states[left, -1], which[left]
        return Landing(basins, errors)

    def separation(self) -> float:
        """The least distance of two attractors in their coordinates; infinite if there is but one."""
        n = self.stroboscope.problem.degrees
        pairs = (
            float(np.abs(self.stroboscope.apart(one.states[:, None, :n], other.states[None, :, :n])).max(axis=2).min())
            for place, one in enumerate(self.attractors)
            for other in self.attractors[:place]
        )
        return min(pairs, default=math.inf)

    def _assigned(self, states: Floats) -> Integers:
        """By the attractors known, then by those that the rest leads to."""
        found, in_vain = self._nearest(states), 0
        for place in np.flatnonzero(found == NONE):
            if found[place] != NONE or len(self.attractors) >= MOST or in_vain >= IN_VAIN:
                continue
            if self._is_refused(states[place, -1]):
                continue
            in_vain += 1
            if self._look(states[place]):
                found, in_vain = np.where(found == NONE, self._nearest(states), found), 0
        return found

    def _look(self, states: Floats) -> bool:
        """Whether there is a new attractor near a motion, seen at the last looks, shape (looks, 2n): it is kept.

        Else the state is, so that it is not tried again.
        """
        state, periods = states[-1], self._periods(states)
        if periods and self._keep(state, self.stroboscope.attractor(state, periods)):
            return True
        if not self.stroboscope.is_driven and self._without_cycle < MOST_WITHOUT and np.isfinite(state).all():
            if self._keep(state, self.stroboscope.cycle(state)):
                return True
            self._without_cycle += 1
        if periods:
            self._refused.append(state)
        return False

    def _keep(self, state: Floats, attractor: Attractor | None) -> bool:
        """Keeps an attractor if it is one, new, and near the state that led to it."""
        if attractor is None or self._distance(state[None, :], attractor).min() > 2.0 * NEAR:
            return False
        if any(self._distance(attractor.states[:1], one).min() < ALIKE for one in self.attractors):
            return False
        self.attractors.append(attractor)
        return True

    def _is_refused(self, state: Floats) -> bool:
        scaled = (np.abs(self.stroboscope.apart(state, one)) / self._sizes for one in self._refused)
        return any(float(one.max()) < 0.1 * NEAR for one in scaled)

    def _periods(self, states: Floats) -> int:
        """After how many looks a motion repeats itself; 0 where it does not, shape of `states` (looks, 2n)."""
        for periods in range(1, (PERIODS if self.stroboscope.is_driven else 1) + 1):
            change = np.abs(self.stroboscope.apart(states[-1], states[-1 - periods])) / self._sizes
            if np.isfinite(change).all() and change.max() < SETTLED:
                return periods
        return 0

    def _nearest(self, states: Floats) -> Integers:
        """The number of the attractor at the last look, shape (motions,)."""
        last = states[:, -1]
        found = np.where(np.isfinite(last).all(axis=1), NONE, ENDED)
        if not self.attractors:
            return found
        distances = np.array([self._distance(last, one).min(axis=1) for one in self.attractors])
        order = np.argsort(distances, axis=0)
        nearest = np.take_along_axis(distances, order, axis=0)
        next_one = nearest[1] if len(nearest) > 1 else np.full(len(last), np.inf)
        near: Truths = (nearest[0] < NEAR) & (nearest[0] < APART * next_one) & (found == NONE)
        return np.asarray(np.where(near, order[0], found))

    def _distance(self, states: Floats, attractor: Attractor) -> Floats:
        """From states, shape (motions, 2n), to each of an attractor's, over what motions cover: (motions, states).

        Of a closed orbit it is that to the sides of the polygon.
        """
        apart = self.stroboscope.apart(states[:, None, :], attractor.states[None, :, :]) / self._sizes
        if attractor.is_closed:
            sides = self.stroboscope.apart(np.roll(attractor.states, -1, axis=0), attractor.states) / self._sizes
            squares = np.maximum((sides**2).sum(axis=1), 1e-300)
            apart = apart - np.clip((apart * sides).sum(axis=2) / squares, 0.0, 1.0)[:, :, None] * sides
        return np.asarray(np.max(np.abs(apart), axis=2))


def staged(count: int, coarsest: int = 4) -> Iterator[Integers]:
    """The places of a square grid, every fourth of both sides first: shape (places,)."""
    done = np.zeros((count, count), dtype=bool)
    stride = coarsest
    while stride >= 1:
        new = np.zeros_like(done)
        new[::stride, ::stride] = True
        yield np.flatnonzero(new & ~done)
        done |= new
        stride //= 2
