"""A parameter swept up and down: at each value the motion goes on where the one before ended, and is seen when settled.

Where two motions attract, the two sweeps stay with different ones as long as they can: hysteresis.
Source: Strogatz, Nonlinear Dynamics and Chaos, 2nd ed., §10.2 and §12.5.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..simulation.outcome import outcome_of
from ..simulation.problem import Floats
from ..vocabulary import RungStatus
from .closing import Closing
from .flow import Passed
from .passages import PER_STEP, View

PUSH = 1e-7  # of the scales: what makes a motion leave an unstable one, at each value
RETURNED = 1e-5  # of the scales: a motion that comes back so near has closed
SETTLED = 1e-9  # the same, for one that need not be waited for: on an unstable one the push would show
PARTS = 4  # of the transient, after each of which it is looked whether it is over
APART = 0.02  # of the picture: motions that differ by less are taken for the same


@dataclass(frozen=True)
class Settled:
    """What a motion does at one value: what is `seen`, shape (points,), and whether and when it repeats.

    `start`, shape (2n,), is a state of it, at the beginning of a period or in the plane; it closes after `folds`
    periods or passages (0: not), which take `span` seconds; where it `is_settled` it has done so to rounding.
    """

    value: float
    start: Floats | None
    seen: Floats
    folds: int
    span: float
    status: RungStatus
    is_settled: bool = False

    @property
    def is_ok(self) -> bool:
        """Whether the motion came to its end."""
        return self.status == "ok"


@dataclass(frozen=True)
class _Transient:
    """Where it has led, shape (2n,); how many periods are `wanted` after it, samples per second, how it ended."""

    end: Floats
    wanted: int
    density: float
    status: int


@dataclass(frozen=True)
class Sweep:
    """How it is looked at: first `skip`, then `count` periods, or passages; `own`, shape (2n,), is the scene's start.

    `unit` gives the period at a value, or about how long it is from passage to passage. `closing` knows when states are
    the same, for motions of one fold.
    """

    view: View
    closing: Closing
    unit: Callable[[float], float]
    own: Floats
    skip: int
    count: int
    most_folds: int

    def visited(self, values: Floats) -> Iterator[Settled]:
        """The values, shape (values,), one after the other; where a motion has ended the next begins at the start."""
        state, density, unit = self.own, 0.0, self.unit(float(values[0]))
        for value in map(float, values):
            unit = self.unit(value) if self.is_driven else unit
            found, state, density = self._settled(value, self._pushed(value, state), unit, density)
            if found.folds and not self.is_driven:
                unit = found.span / found.folds
            yield found

    @property
    def is_driven(self) -> bool:
        """Whether something drives the scene."""
        return self.closing.period is not None

    def _pushed(self, value: float, state: Floats) -> Floats:
        """The state a little beside itself, unless that is behind a contact."""
        width = len(state)
        moved = state + PUSH * self.closing.scales[:width] * np.cos(1.0 + 2.0 * np.arange(width))
        return np.asarray(moved if self.view.flow.admits(value, moved[None, :])[0] else state)

    def _settled(self, value: float, state: Floats, unit: float, density: float) -> tuple[Settled, Floats, float]:
        before = self._transient(value, state, unit)
        if before.status:
            return _ended(value, before.status), self.own, density
        state, density = self._wrapped(before.end), before.density or density
        passed = self.view.passed(value, state, unit, before.wanted, density)
        if passed.status:
            return _ended(value, passed.status), self.own, density
        returns = self._returns(value, state, unit, passed, before.wanted)
        folds = self._folds(returns, RETURNED)
        span = float(returns[-1, -1] - returns[-1 - folds, -1]) if folds else 0.0
        seen = self.view.values(value, self._shown(passed.rows, returns, folds))
        start = returns[-1 - folds, :-1] if folds else returns[0, :-1] if len(returns) else state
        last = returns[-1, :-1] if folds else passed.end
        is_settled = bool(folds) and self._folds(returns, SETTLED) > 0
        return Settled(value, start, seen, folds, span, "ok", is_settled), self._wrapped(last), density

    def _transient(self, value: float, state: Floats, unit: float) -> _Transient:
        """The first periods, or fewer where the motion has settled before."""
        wanted, steps, counts = self.count, 0, _split(self.skip, PARTS if self.is_driven else 1)
        for count in counts:
            times = np.linspace(0.0, unit * count, 1 + (count if self.is_driven else 1))
            found = self.view.flow.traced(np.array([value]), state[None, :], times)
            steps += int(found.steps[0])
            if not found.is_fine:
                return _Transient(state, wanted, 0.0, int(found.outcomes[0]))
            state = self._wrapped(found.states[0, -1])
            folds = self._folds(found.states[0], SETTLED) if self.is_driven else 0
            if folds:
                return _Transient(state, min(wanted, 2 * folds + 1), PER_STEP * steps / (count * unit), 0)
        return _Transient(state, wanted, PER_STEP * steps / (unit * max(self.skip, 1)), 0)

    def _returns(self, value: float, state: Floats, unit: float, passed: Passed, count: int) -> Floats:
        """Rows (q, q̇, t) at the ends of periods, or in the plane: where a motion that repeats is the same again."""
        if not self.is_driven:
            return passed.rows
        if self.view.plane is None:
            return np.vstack([passed.rows, np.append(passed.end, unit * count)])
        times = np.linspace(0.0, unit * count, count + 1)
        return np.column_stack([self.view.flow.traced(np.array([value]), state[None, :], times).states[0], times])

    def _shown(self, rows: Floats, returns: Floats, folds: int) -> Floats:
        """The rows that are seen: of a motion that repeats those of one round, of others as many as are wanted."""
        if folds and self.is_driven:
            begin, end = returns[-1 - folds, -1], returns[-1, -1]
            return np.asarray(rows[(rows[:, -1] >= begin) & (rows[:, -1] < end)])
        return rows[-folds:] if folds else rows[: self.count] if not self.is_driven else rows

    def _folds(self, returns: Floats, near: float) -> int:
        """After how many returns, rows (q, q̇, …), the motion is as near to where it was; 0 where it is not."""
        width = len(self.own)
        states, scales = returns[:, :width], self.closing.scales[:width]
        for folds in range(1, min(self.most_folds, (len(states) - 1) // 2) + 1):
            apart = self.closing.gap(states[-2:], states[-2 - folds : len(states) - folds]) / scales
            if np.abs(apart).max() < near:
                return folds
        return 0

    def _wrapped(self, state: Floats) -> Floats:
        """The state with its angles turned back, where the scene is the same after a turn."""
        return wrapped(state, self.closing.turns)


def _split(count: int, parts: int) -> list[int]:
    """A number in about even parts, those that are zero left out."""
    bounds = [count * part // parts for part in range(parts + 1)]
    return [b - a for a, b in itertools.pairwise(bounds) if b > a]


def _ended(value: float, code: int) -> Settled:
    return Settled(value, None, np.zeros(0), 0, 0.0, outcome_of(code, {}).status)


def wrapped(state: Floats, turns: NDArray[np.bool_]) -> Floats:
    """A state (q, q̇), shape (2n,), with angles between −π and π; `turns` has shape (n,)."""
    found, n = state.copy(), len(turns)
    found[:n] -= np.where(turns, 2.0 * np.pi * np.round(found[:n] / (2.0 * np.pi)), 0.0)
    return found


def differ(up: Settled, down: Settled, extent: float) -> bool:
    """Whether at the same value two motions are seen to be different; what has not settled yet does not count."""
    if not (up.is_ok and down.is_ok):
        return up.is_ok != down.is_ok
    if not (up.is_settled and down.is_settled and len(up.seen) and len(down.seen)):
        return False
    low, high = abs(up.seen.min() - down.seen.min()), abs(up.seen.max() - down.seen.max())
    return bool(max(low, high) > APART * extent)
