"""Many motions of one model going their steps side by side, as arrays, with the series of each step at hand.

The step is that of `taylor` and so is the look at what it really did: a step that is worse than it seemed is taken
again, shorter. All motions share their parameters. Forces with kinks end a step where the argument of their condition
changes its sign; pieces of the span bound the steps where the time alone moves the forces.
"""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from dataclasses import dataclass, fields, replace

import numpy as np
from numpy.typing import NDArray

from ..model.recurrences import nudged
from .kernels.ensemble import aligned
from .kernels.motion import FINE, NOT_FINITE, SINGULAR, SMALLEST_PIVOT, STEP_LIMIT, STEP_UNDERFLOW, TOO_LARGE
from .kernels.step import LARGEST_VALUE
from .kernels.taylor import ALWAYS_UNNOTICED, PLACES, ROOM, SHORTER, UNNOTICED
from .pieces import Pieces
from .problem import Floats, Problem
from .run import Steps
from .series.engine import LANES, jet_of_model
from .series.evaluation import evaluated

Integers = NDArray[np.int64]
Truths = NDArray[np.bool_]
GOES_ON = -1
HALVINGS = 60
ROUNDING = 2.0**-53
BELOW, SHORTER_TWIN = 1e-3, 0.9  # the local tolerance and the bounds of twins' steps over those of the others
LEAST_PART = 1e-6  # of the step that the series allows, or the span: no shorter one is asked for
LEAST_STEP = 1e-10  # over the span
_CALL = ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * 4)


@dataclass(frozen=True)
class Polynomials:
    """Series of steps, each by itself: q, q̇ (and ∫P dt) as polynomials in θ, the time behind `start` in `units`.

    `coefficients` has shape (steps, order + 1, width), `old` and `rest` (steps, width), `start` and `units` (steps,).
    """

    coefficients: Floats
    old: Floats
    rest: Floats
    start: Floats
    units: Floats
    degrees: int

    def at(self, theta: Floats) -> tuple[Floats, Floats]:
        """Rows (q, q̇, t) and the time derivatives of (q, q̇) at places θ, shape (steps,): one in each step."""
        n, c, x = 2 * self.degrees, self.coefficients, theta[:, None]
        values, slopes = c[:, -1], np.zeros_like(c[:, -1])
        for k in range(c.shape[1] - 2, 0, -1):
            slopes = slopes * x + values
            values = values * x + c[:, k]
        states = self.old + (values * x + self.rest)
        rates = (values + slopes * x) / self.units[:, None]
        return np.column_stack([states[:, :n], self.start + theta * self.units]), rates[:, :n]

    def chosen(self, which: Truths) -> Polynomials:
        """Some of them."""
        c, old, rest = (each[which] for each in (self.coefficients, self.old, self.rest))
        return Polynomials(c, old, rest, self.start[which], self.units[which], self.degrees)

    @classmethod
    def joined(cls, parts: Sequence[Polynomials]) -> Polynomials:
        """All of several."""
        names = ("coefficients", "old", "rest", "start", "units")
        arrays = {name: np.concatenate([getattr(part, name) for part in parts]) for name in names}
        return cls(**arrays, degrees=parts[0].degrees)


@dataclass(frozen=True)
class _Lanes:
    """Motions side by side where they begin a step; the last axis of all arrays is theirs.

    `which` are their numbers. `old` with its `rest` (Kahan's) is the state at the time `now`, `coefficients` the series
    there, shape (order + 1, components, lanes), in `units` of time; steps up to `least` may be tried, `tried` were.
    """

    which: Integers
    old: Floats
    rest: Floats
    now: Floats
    least: Floats
    tried: Integers
    units: Floats
    coefficients: Floats

    def chosen(self, kept: Truths) -> _Lanes:
        """Those that are kept."""
        return _Lanes(*(np.ascontiguousarray(getattr(self, one.name)[..., kept]) for one in fields(self)))

    def mixed(self, other: _Lanes, which: Truths) -> _Lanes:
        """The other ones where `which` holds, else these."""
        pairs = ((getattr(self, one.name), getattr(other, one.name)) for one in fields(self))
        return _Lanes(*(np.where(which, theirs, mine) for mine, theirs in pairs))


@dataclass(frozen=True)
class _Trial:
    """A step of all lanes before the verdict on it: sizes, times and states (with rests) at its end, and ẋ there."""

    wanted: Floats
    size: Floats
    end: Floats
    is_cut: Truths
    new: Floats
    rest: Floats
    slopes: Floats


class March:
    """Motions from `starts`, shape (motions, 2n), to the problem's t_end; `steps` has the order and the pieces, too.

    With `twins` each goes along once more, behind all others: by much smaller local errors, with steps that are bounded
    by a little less, and from a start and with constants some units in the last place away.
    """

    def __init__(self, problem: Problem, starts: Floats, steps: Steps, *, twins: bool = False) -> None:
        is_twin = np.repeat([False, True] if twins else [False], len(starts))
        self.problem, self.steps, self.count = problem, steps, len(is_twin)
        self.end_time, self.degrees, self.order = problem.t_end, problem.degrees, steps.order or 0
        self.jet = jet_of_model(problem.model, is_long=True, lanes=LANES)
        self.outcomes = np.full(self.count, GOES_ON, dtype=np.int64)
        recurrences = problem.model.recurrences
        states = np.hstack([starts, np.zeros((len(starts), self.jet.shape.width - 2 * self.degrees))])
        constants = recurrences.constants(np.array(problem.parameters))
        self._constants = np.where(is_twin, recurrences.nudged(constants)[:, None], constants[:, None])
        self._tolerances = steps.tolerance * np.where(is_twin, BELOW, 1.0)
        self._shares = np.where(is_twin, SHORTER_TWIN, 1.0)
        self._call, self._work = _CALL(self.jet.code.address), aligned(self.jet.work)
        self._program = np.array([self.order], dtype=np.int64)
        pieces = steps.pieces or Pieces.whole(self.end_time)
        bounds = pieces.bounded(steps.size)
        self._ends, self._bounds = np.array(pieces.ends), np.where(bounds > 0.0, bounds, np.inf)
        states = np.vstack([states, nudged(states)]) if twins else states
        self._lanes = self._begun(np.ascontiguousarray(states.T), steps.size)
        self._reached = np.zeros(self.count)
        self._last = self._lanes
        self._trial: _Trial | None = None

    @property
    def goes_on(self) -> bool:
        """Whether any motion does."""
        return bool((self.outcomes == GOES_ON).any())

    @property
    def which(self) -> Integers:
        """The numbers of the motions that go on, in the order of the lanes."""
        return self._lanes.which

    def reached(self) -> Floats:
        """The time that each motion has come to, shape (motions,)."""
        self._reached[self._lanes.which] = self._lanes.now
        return self._reached.copy()

    def rows(self) -> tuple[Floats, Floats]:
        """Rows (q, q̇, t) and the time derivatives of (q, q̇) where the lanes are: shape (lanes, …)."""
        n, lanes = 2 * self.degrees, self._lanes
        return np.vstack([lanes.old[:n], lanes.now]).T, (lanes.coefficients[1, :n] / lanes.units).T

    def end(self, which: Truths) -> None:
        """The motions of these numbers have come to their end."""
        self.outcomes[which & (self.outcomes == GOES_ON)] = FINE

    def end_all(self, outcome: int) -> None:
        """No motion goes on."""
        self.outcomes[self.outcomes == GOES_ON] = outcome

    def step(self, parts: int) -> tuple[Floats, Floats, Floats, Floats]:
        """A step of all that go on is tried.

        Returns, at the ends of so many parts of it: places θ, shape (parts, lanes), rows (q, q̇, t) and time derivatives
        of (q, q̇), shape (parts, lanes, …); and the lengths of the parts, shape (lanes,).
        """
        self._drop()
        lanes, n = self._lanes, 2 * self.degrees
        wanted = np.minimum(self._wanted(), self.steps.size)
        size, end = self._fitted(np.minimum(wanted, lanes.least))
        size, is_cut = self._cut(size)
        shares = np.arange(1, parts + 1)[:, None] / parts
        theta = (size / lanes.units) * shares
        values, slopes = evaluated(lanes.coefficients[:, : self.jet.shape.width], theta)
        rates = slopes[:, :n] / lanes.units
        change = values[-1] + lanes.rest
        new = lanes.old + change
        self._trial = _Trial(
            wanted,
            size,
            np.where(is_cut, lanes.now + size, end),
            is_cut,
            new,
            change - (new - lanes.old),
            rates[-1],
        )
        rows = np.empty((parts, n + 1, len(size)))
        rows[:, :n] = lanes.old[:n] + (values[:, :n] + lanes.rest[:n])
        rows[:, n] = lanes.now + size * shares
        return theta, rows.transpose(0, 2, 1), rates.transpose(0, 2, 1), size / parts

    def accept(self, is_unseen: Truths) -> Truths:
        """Whether the step tried is taken, by lane; where it was bad, or `is_unseen` and not too short, it is not."""
        trial, lanes = self._trial, self._lanes
        if trial is None:
            raise LookupError("a step is tried before it is accepted")
        units = _unit_near(trial.size, lanes.units)
        following = self._expanded(lanes.which, trial.new, trial.end, units)
        outcome = self._outcome(following, trial.new)
        refused = self._is_bad(trial, following, units, outcome)
        refused |= is_unseen & (trial.size > LEAST_PART * trial.wanted)
        taken = ~refused & (outcome == FINE)
        ended = ~refused & (outcome != FINE)
        least, count = np.full(len(taken), np.inf), lanes.tried + 1
        following_lanes = _Lanes(lanes.which, trial.new, trial.rest, trial.end, least, count, units, following)
        if not taken.all():
            stays = replace(lanes, least=np.where(refused, SHORTER * trial.size, lanes.least), tried=count)
            following_lanes = stays.mixed(following_lanes, taken)
        self._last, self._lanes, self._trial = lanes, following_lanes, None
        # where steps become so short the motion has a singularity, and never comes to the end of the span
        smallest = np.where(refused, np.minimum(trial.wanted, SHORTER * trial.size), trial.wanted)
        is_stuck = (smallest < LEAST_STEP * self.end_time) | (lanes.now + smallest <= lanes.now)
        ended |= is_stuck
        if ended.any():
            outcome[is_stuck] = STEP_UNDERFLOW
            self.outcomes[lanes.which[ended]] = outcome[ended]
        if count.max() >= self.problem.step_limit:
            self.outcomes[lanes.which[~ended & (count >= self.problem.step_limit)]] = STEP_LIMIT
        self.outcomes[lanes.which[taken & (trial.end >= self.end_time)]] = FINE
        return np.asarray(taken)

    def polynomials(self, lanes: Integers) -> Polynomials:
        """The series of the step looked at last, by place among the lanes that took it."""
        last, width = self._last, self.jet.shape.width
        coefficients = last.coefficients[:, :width, lanes].transpose(2, 0, 1)
        old, rest = last.old[:, lanes].T, last.rest[:, lanes].T
        return Polynomials(coefficients, old, rest, last.now[lanes], last.units[lanes], self.degrees)

    def _drop(self) -> None:
        """Lanes whose motion has ended are left out."""
        goes_on = self.outcomes[self._lanes.which] == GOES_ON
        if not goes_on.all():
            self.reached()
            self._lanes = self._lanes.chosen(goes_on)

    def _begun(self, states: Floats, near: float) -> _Lanes:
        """All motions where they begin; their unit of time is shortened until the coefficients are in range."""
        count = states.shape[1]
        numbers, units, now = np.arange(count), np.full(count, 2.0 ** np.floor(np.log2(near))), np.zeros(count)
        for _ in range(4):
            found = self._expanded(numbers, states, now, units)
            outcome = self._outcome(found, states)
            too_large = (outcome == TOO_LARGE) | (outcome == NOT_FINITE)
            if not too_large.any():
                break
            units = np.where(too_large, units * 2.0**-24, units)
        self.outcomes[outcome != FINE] = outcome[outcome != FINE]
        least = np.full(count, np.inf)
        return _Lanes(numbers, states, np.zeros_like(states), now, least, np.zeros_like(numbers), units, found)

    def _expanded(self, which: Integers, states: Floats, times: Floats, units: Floats) -> Floats:
        """The coefficients at these states, shape (order + 1, components, lanes)."""
        count, width, lanes = len(times), self.jet.shape.width, self.jet.shape.lanes
        blocks = -(-count // lanes)
        rows = np.empty((width + 2 + len(self._constants), blocks * lanes))
        rows[0, :count], rows[1 : width + 1, :count], rows[width + 1, :count] = units, states, times
        rows[width + 2 :, :count] = self._constants[:, which]
        rows[:, count:] = rows[:, count - 1 : count]  # lanes that are left over go along
        given = aligned(blocks, len(rows), lanes)
        given[:] = rows.reshape(-1, blocks, lanes).transpose(1, 0, 2)
        # zeros, for the last coefficients of conditions and all but the first of pivots are not written
        out = aligned(blocks, self.order + 1, self.jet.shape.components, lanes)
        to, of, work, program = (each.ctypes.data for each in (out, given, self._work, self._program))
        for block in range(blocks):
            self._call(to + block * out.strides[0], of + block * given.strides[0], work, program)
        if blocks == 1:
            return out[0] if count == lanes else out[0, ..., :count]
        return out.transpose(1, 2, 0, 3).reshape(*out.shape[1:3], -1)[..., :count]

    def _outcome(self, found: Floats, states: Floats) -> Integers:
        """Whether series can be used, by lane."""
        shape, n = self.jet.shape, 2 * self.degrees
        first = shape.first_pivot
        pivots, diagonals = found[0, first::2], found[0, first + 1 :: 2]
        total = (np.abs(found[1, :n]) + np.abs(found[self.order, :n]) + np.abs(states[:n])).sum(axis=0)
        if (total <= LARGEST_VALUE).all() and (pivots > SMALLEST_PIVOT * diagonals).all():
            return np.full(len(total), FINE)
        outcome = np.where(np.isnan(total), NOT_FINITE, np.where(total <= LARGEST_VALUE, FINE, TOO_LARGE))
        singular = ~(pivots > SMALLEST_PIVOT * diagonals)
        lost = np.isnan(pivots).any(axis=0)
        return np.asarray(np.where(lost, NOT_FINITE, np.where(singular.any(axis=0), SINGULAR, outcome)))

    def _wanted(self) -> Floats:
        """The step by which the last two coefficients shrink to the tolerance, by lane."""
        n, c, order = 2 * self.degrees, self._lanes.coefficients, self.order
        scale = np.maximum(1.0, np.abs(self._lanes.old[:n])) * self._tolerances[self._lanes.which]
        orders = np.array([[order - 1.0], [order]])
        with np.errstate(divide="ignore"):
            steepest = (np.log((np.abs(c[order - 1 : order + 1, :n]) / scale).max(axis=1)) / orders).max(axis=0)
        return np.asarray(self._lanes.units * np.exp(-0.7 / (order - 1.0) - steepest))

    def _fitted(self, wanted: Floats) -> tuple[Floats, Floats]:
        """Steps within the pieces of the span, and the times that they end at."""
        now = self._lanes.now
        piece = np.minimum(np.searchsorted(self._ends, now, side="right"), len(self._ends) - 1)
        ends = self._ends[piece]
        size, left = np.minimum(wanted, self._shares[self._lanes.which] * self._bounds[piece]), ends - now
        is_last = size * (1.0 + 1e-9) >= left
        return np.where(is_last, left, size), np.where(is_last, ends, now + size)

    def _cut(self, size: Floats) -> tuple[Floats, Truths]:
        """Steps up to just behind where the argument of a condition first changes its sign."""
        if not self.jet.shape.conditions:
            return size, np.zeros(len(size), dtype=bool)
        found, lanes = size.copy(), self._lanes
        for row in range(self.jet.shape.width, self.jet.shape.first_pivot):
            for lane in range(len(size)):
                series, unit = lanes.coefficients[:, row, lane], lanes.units[lane]
                at = _first_change(series[::-1], found[lane] / unit) * unit
                if at < found[lane]:
                    found[lane] = min(found[lane], at + ROOM * ROUNDING * max(lanes.now[lane], size[lane]))
        return found, found < size

    def _is_bad(self, trial: _Trial, following: Floats, units: Floats, outcome: Integers) -> Truths:
        """Whether a step was worse than it seemed, and a shorter one may be better."""
        n, allowed = 2 * self.degrees, max(UNNOTICED * self.steps.tolerance, ALWAYS_UNNOTICED)
        apart = trial.size * np.abs(trial.slopes - following[1, :n] / units) / np.maximum(1.0, np.abs(trial.new[:n]))
        worse = (apart.max(axis=0) > allowed) & ~trial.is_cut
        return np.asarray((worse | (outcome != FINE)) & (trial.size > LEAST_PART * trial.wanted))


def _unit_near(size: Floats, units: Floats) -> Floats:
    """A power of two near each step, the one it has where that is near enough."""
    near = (0.25 * units <= size) & (size <= 4.0 * units)
    return np.asarray(np.where(near, units, 2.0 ** np.floor(np.log2(size))))


def _first_change(series: Floats, end: float) -> float:
    """Where up to θ = `end` a polynomial (highest power first) first changes the sign that it begins with."""
    start = float(series[-1])
    places = end * np.arange(1, PLACES + 1) / PLACES
    changed = np.polyval(series, places) * np.sign(start) <= 0.0 if start else np.polyval(series, places) != 0.0
    if not changed.any():
        return end
    first = int(np.argmax(changed))
    below, above = (places[first - 1] if first else 0.0), places[first]
    for _ in range(HALVINGS):
        middle = 0.5 * (below + above)
        is_same = float(np.polyval(series, middle)) * np.sign(start) > 0.0
        below, above = (middle, above) if is_same else (below, middle)
    return float(above)
