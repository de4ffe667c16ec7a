"""Many motions of one model going their steps side by side, several steps a round, with the series of each at hand.

The step is that of `taylor` and so is the look at what it really did: a step that is worse than it seemed is taken
again, shorter. Who looks at the steps may refuse one, too; the motion then goes on from its beginning. Forces with
kinks end a step where the argument of their condition changes its sign; pieces of the span bound the steps where the
time alone moves the forces.
"""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..model.recurrences import nudged
from .audit import Audit
from .kernels.aligned import aligned
from .kernels.ensemble import MARGINS, NEW, NEW_REST, PIVOTS, SIZES, TOLERANCE, UNIT, WANTED
from .kernels.motion import FINE, NOT_FINITE, SINGULAR, STEP_LIMIT, STEP_UNDERFLOW, TOO_LARGE
from .kernels.sight import Meshes
from .kernels.step import LARGEST_VALUE
from .kernels.taylor import ALWAYS_UNNOTICED, PLACES, ROOM, SHORTER, UNNOTICED
from .library import get_method
from .pieces import Pieces
from .problem import Floats, Problem
from .run import Steps
from .series import marching as m
from .series.engine import code_of_steps, jet_of_model
from .series.marching import LANES, LEAST_PART, Layout, marching

Integers = NDArray[np.int64]
Truths = NDArray[np.bool_]
GOES_ON = -1
HALVINGS = 60
ROUNDING = 2.0**-53
BELOW, SHORTER_TWIN = 1e-3, 0.9  # the local tolerance and the bounds of twins' steps over those of the others
LEAST_STEP = 1e-10  # over the span
SEEN = 1e-10  # of the coordinates: what moves them by less may be missed
MOST_STEPS = 8  # of a round
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
class Gone:
    """Steps of a round, shape (steps, lanes): whether each was `taken`, its `size`, its `start`, and what was `wanted`.

    `theta`, the lengths of its parts in units of its series, and `lengths`, in seconds, have that shape, too. At the
    ends of parts are `rows` (q, q̇, t) and `rates` of (q, q̇), shape (steps, parts, lanes, …). `which` are the numbers of
    the motions, shape (lanes,), −1 where a lane has none.
    """

    which: Integers
    taken: Truths
    size: Floats
    start: Floats
    wanted: Floats
    theta: Floats
    lengths: Floats
    rows: Floats
    rates: Floats


class March:
    """Motions from `starts`, shape (motions, 2n), to the problem's t_end; `steps` has the order and the pieces, too.

    Each step is looked at in so many equal `parts`. With `twins` each motion goes along once more, behind all others:
    by much smaller local errors, with steps that are bounded by a little less, and from a start and with constants some
    units in the last place away. The motions have the problem's parameters, or each its own, shape (motions, count).
    """

    def __init__(
        self,
        problem: Problem,
        starts: Floats,
        steps: Steps,
        parts: int,
        *,
        twins: bool = False,
        parameters: Floats | None = None,
    ) -> None:
        is_twin = np.repeat([False, True] if twins else [False], len(starts))
        self.problem, self.steps, self.count = problem, steps, len(is_twin)
        self.end_time, self.degrees, self.order = problem.t_end, problem.degrees, steps.order or 0
        self.jet = jet_of_model(problem.model, is_long=True, lanes=LANES)
        self.outcomes = np.full(self.count, GOES_ON, dtype=np.int64)
        self._shares = np.where(is_twin, SHORTER_TWIN, 1.0)
        pieces = steps.pieces or Pieces.whole(self.end_time)
        bounds = pieces.bounded(steps.size)
        self._ends, self._bounds = np.array(pieces.ends), np.where(bounds > 0.0, bounds, np.inf)
        recurrences = problem.model.recurrences
        self._conditions = len(recurrences.conditions)
        self._depth = self._most = 1 if self._conditions else MOST_STEPS
        shared = np.array(problem.parameters)[None, :]
        own = np.repeat(shared, len(starts), axis=0) if parameters is None else parameters
        constants = recurrences.constants(own.T).T.reshape(len(starts), -1)
        self._layout = Layout(self.jet.shape.width, self.degrees, constants.shape[1], self._most, parts)
        self._marching = marching()  # kept while it runs: another thread may have made its own for the next one
        self._call, self._jet = _CALL(self._marching.address), _CALL(self.jet.code.addresses["jet"])
        self._steps = code_of_steps(self.jet.shape)  # kept while it runs
        self._measure, self._work = _CALL(self._steps.addresses["measure"]), aligned(self.jet.work)
        self._reached = np.zeros(self.count)
        self._watcher = Audit(problem, get_method("taylor")).watcher(self._most + 1)
        self._parameters = np.tile(own, (1 + twins, 1))
        constants = np.vstack([constants, recurrences.nudged(constants)]) if twins else constants
        states = np.hstack([starts, np.zeros((len(starts), self._layout.width - 2 * self.degrees))])
        states = np.vstack([states, nudged(states)]) if twins else states
        tolerances = steps.tolerance * np.where(is_twin, BELOW, 1.0)
        self._take_in(np.arange(self.count), self._first_rows(states, constants.T, tolerances))
        self._begin(steps.size)

    def _first_rows(self, states: Floats, constants: Floats, tolerances: Floats) -> Floats:
        """What stands in the rows at first, shape (rows, motions); the states have shape (motions, width)."""
        layout, size, tolerance = self._layout, self.steps.size, self.steps.tolerance
        rows = np.zeros((layout.total, self.count))
        rows[layout.states + NEW * layout.width :][: layout.width] = states.T
        rows[layout.width + 2 :][: len(constants)] = constants
        rows[layout.told + TOLERANCE] = tolerances
        plans = {m.LEAST: np.inf, m.STATUS: m.RESTS, m.CAP: size, m.CUT: np.inf, m.SMALLEST: LEAST_STEP * self.end_time}
        plans |= {m.ALLOWED: max(UNNOTICED * tolerance, ALWAYS_UNNOTICED)}
        for row, value in plans.items():
            rows[layout.plans + row] = value
        return rows

    @property
    def goes_on(self) -> bool:
        """Whether any motion does."""
        return bool((self.outcomes == GOES_ON).any())

    def reached(self) -> Floats:
        """The time that each motion has come to, shape (motions,)."""
        has = self._which >= 0
        self._reached[self._which[has]] = self._plan(m.NOW).reshape(-1)[has]
        return self._reached.copy()

    def rows(self) -> tuple[Floats, Floats]:
        """Rows (q, q̇, t) and the time derivatives of (q, q̇) where all motions begin: shape (motions, …)."""
        n, layout = 2 * self.degrees, self._layout
        rows = np.concatenate([self._states(NEW)[:, :n], self._rows[:, layout.plans + m.NOW, None]], axis=1)
        rates = self._series[:, 0, 1, :n] / self._rows[:, :1]
        each = (found.transpose(0, 2, 1).reshape(-1, found.shape[1])[: self.count] for found in (rows, rates))
        return next(each), next(each)

    def end_all(self, outcome: int) -> None:
        """No motion goes on."""
        self.outcomes[self.outcomes == GOES_ON] = outcome

    def go(self) -> Gone:
        """Some steps of all that go on."""
        self._drop()
        self._enter_pieces()
        if self._conditions:
            self._cut()
        layout = self._layout
        records = self._rows[:, layout.records :].reshape(-1, self._most, layout.record, LANES)
        records[:, :, m.TAKEN] = 0.0
        self._program[:, m.STEPS] = self._depth
        to, of, work, program = (each.ctypes.data for each in (self._series, self._rows, self._work, self._program))
        strides = [each.strides[0] for each in (self._series, self._rows, self._program)]
        for block in range(len(self._rows)):
            self._call(to + block * strides[0], of + block * strides[1], work, program + block * strides[2])
        done = int(self._program[:, m.SLOT].max())
        self._records = records[:, :done].transpose(1, 2, 0, 3).reshape(done, layout.record, -1)
        return self._told(self._records)

    def _told(self, found: Floats) -> Gone:
        """What the records of steps say, shape (steps, record, lanes)."""
        layout, n = self._layout, 2 * self.degrees
        seen = found[:, m.RECORDED + 2 * layout.width :]
        seen = seen.reshape(len(found), layout.parts, 2 * n + 1, -1).transpose(0, 1, 3, 2)
        taken = found[:, m.TAKEN] > 0.0
        size, units = (np.where(taken, found[:, row], 1.0) for row in (m.SIZE, m.UNITS))  # else some round before
        lengths = size / layout.parts
        return Gone(
            self._which,
            taken,
            size,
            found[:, m.STARTED],
            np.minimum(found[:, m.WISHED], self.steps.size),
            lengths / units,
            lengths,
            seen[..., : n + 1],
            seen[..., n + 1 :],
        )

    def settle(self, gone: Gone, is_unseen: Truths) -> Truths:
        """Which steps are taken: up to the first that `is_unseen`, shape (steps, lanes), unless it is very short.

        Where a motion may have passed over something between the ends of its steps, the first of them counts as unseen.
        From there it goes on in shorter ones. What has come to its end is told apart.
        """
        is_unseen = is_unseen | self._blind(gone)
        refused = gone.taken & is_unseen & (gone.size > LEAST_PART * gone.wanted)
        if refused.any():
            lanes = np.flatnonzero(refused.any(axis=0))
            steps = np.argmax(refused[:, lanes], axis=0)
            self._go_back(gone, steps, lanes)
            taken = gone.taken & ~np.logical_or.accumulate(refused, axis=0)
            self._depth = max(1, self._depth // 2)
        else:
            taken = gone.taken
            self._depth = min(self._most, 2 * self._depth)
        self._conclude()
        return np.asarray(taken)

    def _blind(self, gone: Gone) -> Truths:
        """The first steps taken in lanes where some may have missed what forces do: shape (steps, lanes)."""
        n, lanes = 2 * self.degrees, np.arange(gone.taken.shape[1])
        order = np.argsort(~gone.taken, axis=0, kind="stable")  # the steps taken come first
        begins = np.vstack([self._records[0, m.RECORDED : m.RECORDED + n], gone.start[:1]])
        ends = gone.rows[order, -1, lanes]
        rows = np.concatenate([begins.T[:, None, :], ends.transpose(1, 0, 2)], axis=1)
        meshes = Meshes(np.ascontiguousarray(rows), gone.taken.sum(axis=0) + 1)
        found, parameters = np.zeros_like(gone.taken), self._parameters[np.maximum(gone.which, 0)]
        found[order[0], lanes] = self._watcher.blind(meshes, parameters, lanes, SEEN)
        return found

    def stop_behind(self, steps: Integers, lanes: Integers) -> None:
        """The motions in these lanes end where these steps did."""
        self._plan(m.NOW)[lanes // LANES, lanes % LANES] = self._records[steps, m.ENDS, lanes]
        self._plan(m.STATUS)[lanes // LANES, lanes % LANES] = m.ENDED
        self.outcomes[self._which[lanes]] = FINE

    def polynomials(self, steps: Integers, lanes: Integers) -> Polynomials:
        """The series of steps of the last round, each in its lane."""
        width, found = self._layout.width, self._records
        coefficients = self._series[lanes // LANES, steps, :, :width, lanes % LANES]
        old, rest = (found[steps, m.RECORDED + i * width : m.RECORDED + (i + 1) * width, lanes] for i in (0, 1))
        return Polynomials(
            coefficients, old, rest, found[steps, m.STARTED, lanes], found[steps, m.UNITS, lanes], self.degrees
        )

    def _plan(self, row: int) -> Floats:
        """A row of plans, shape (blocks, LANES); what is written there is written."""
        return self._rows[:, self._layout.plans + row]

    def _states(self, row: int) -> Floats:
        """States, shape (blocks, width, LANES)."""
        first = self._layout.states + row * self._layout.width
        return self._rows[:, first : first + self._layout.width]

    def _take_in(self, which: Integers, rows: Floats) -> None:
        """Motions of these numbers, with their rows, shape (rows, motions), in as many blocks as they need."""
        layout, count = self._layout, len(which)
        blocks = -(-count // LANES)
        places = np.minimum(np.arange(blocks * LANES), count - 1)  # lanes that are left over have a motion's numbers
        self._which = np.where(np.arange(blocks * LANES) < count, which[places], -1)
        self._rows = aligned(blocks, layout.total, LANES)
        self._rows[:] = rows[:, places].reshape(layout.total, blocks, LANES).transpose(1, 0, 2)
        self._plan(m.STATUS)[self._which.reshape(blocks, LANES) < 0] = m.ENDED
        # zeros, for the last coefficients of conditions and all but the first of pivots are not written
        self._series = aligned(blocks, self._most + 1, self.order + 1, self.jet.shape.components, LANES)
        addresses = {**self.jet.code.addresses, **self._steps.addresses}
        told = {m.ORDER: self.order, m.PARTS: layout.parts, m.WIDTH: layout.width, m.RATED: 2 * self.degrees}
        told |= {m.COMPONENTS: self.jet.shape.components, m.AT_STATES: layout.states, m.AT_TOLD: layout.told}
        told |= {m.AT_PLANS: layout.plans, m.AT_RECORDS: layout.records, m.RECORD: layout.record}
        told |= {m.JET: addresses["jet"], m.ADVANCE: addresses["advance"], m.MEASURE: addresses["measure"]}
        self._program = np.zeros((blocks, m.PROGRAM), dtype=np.int64)
        for place, value in told.items():
            self._program[:, place] = value

    def _drop(self) -> None:
        """Lanes whose motion has ended rest; they are left out when so many have that a block less is enough."""
        has = self._which >= 0
        goes_on = has & (self.outcomes[np.maximum(self._which, 0)] == GOES_ON)
        if goes_on.all():
            return
        self._plan(m.STATUS)[~goes_on.reshape(-1, LANES)] = m.ENDED
        left = np.flatnonzero(goes_on)
        if -(-len(left) // LANES) == len(self._rows):
            return
        self.reached()
        rows = self._rows.transpose(1, 0, 2).reshape(self._layout.total, -1)[:, left]
        series = self._series[left // LANES, self._program[left // LANES, m.SLOT], ..., left % LANES]
        self._take_in(self._which[left], rows)
        places = np.minimum(np.arange(self._which.size), len(left) - 1)
        self._series[:, 0] = series[places].reshape(-1, LANES, *series.shape[1:]).transpose(0, 2, 3, 1)

    def _begin(self, near: float) -> None:
        """The first series of all; their unit of time is shortened until the coefficients are in range."""
        self._rows[:, 0] = 2.0 ** np.floor(np.log2(near))
        outcome = np.empty(0, dtype=np.int64)
        for _ in range(4):
            self._expand()
            outcome = self._outcome()
            too_large = (outcome == TOO_LARGE) | (outcome == NOT_FINITE)
            if not too_large.any():
                break
            self._rows[:, 0][too_large] *= 2.0**-24
        outcome = outcome.reshape(-1)[: self.count]
        self.outcomes[outcome != FINE] = outcome[outcome != FINE]

    def _expand(self) -> None:
        """The series where the lanes are."""
        layout = self._layout
        self._rows[:, 1 : 1 + layout.width] = self._states(NEW)
        self._rows[:, layout.told + UNIT] = self._rows[:, 0]
        for series, rows, program in zip(self._series, self._rows, self._program, strict=True):
            to, of, work, orders = (each.ctypes.data for each in (series, rows, self._work, program))
            self._jet(to, of, work, orders)
            states, told = (rows[place:].ctypes.data for place in (layout.states, layout.told))
            self._measure(to, states, told, orders)

    def _outcome(self) -> Integers:
        """Whether the series where the lanes are can be used, shape (blocks, LANES)."""
        sizes, margins, pivots = (self._rows[:, self._layout.told + row] for row in (SIZES, MARGINS, PIVOTS))
        outcome = np.where(np.isnan(sizes), NOT_FINITE, np.where(sizes <= LARGEST_VALUE, FINE, TOO_LARGE))
        outcome = np.where(margins > 0.0, outcome, SINGULAR)
        return np.asarray(np.where(np.isnan(pivots), NOT_FINITE, outcome))

    def _conclude(self) -> None:
        """Motions that cannot go on, or have come to the end, are told."""
        status, now, has = self._plan(m.STATUS), self._plan(m.NOW), self._which.reshape(-1, LANES) >= 0
        limit = self.problem.step_limit
        tried = self._plan(m.TRIED) >= limit
        if not ((status != m.GOES) | tried).any():
            return
        outcome = np.where(tried, STEP_LIMIT, GOES_ON)
        outcome = np.where(status == m.FAILED, self._outcome(), outcome)
        outcome = np.where(status == m.STUCK, STEP_UNDERFLOW, outcome)
        outcome = np.where((now >= self.end_time) & (status != m.FAILED), FINE, outcome)
        ended = has & (outcome != GOES_ON) & (status != m.ENDED)
        which = self._which.reshape(-1, LANES)[ended]
        going = self.outcomes[which] == GOES_ON
        self.outcomes[which[going]] = outcome[ended][going]

    def _go_back(self, gone: Gone, steps: Integers, lanes: Integers) -> None:
        """These lanes are again where these steps began, and try shorter ones."""
        block, lane, width, found = lanes // LANES, lanes % LANES, self._layout.width, self._records
        for place, row in ((0, NEW), (1, NEW_REST)):
            first = m.RECORDED + place * width
            self._states(row)[block, :, lane] = found[steps, first : first + width, lanes]
        self._rows[block, 0, lane] = found[steps, m.UNITS, lanes]
        self._rows[block, self._layout.told + WANTED, lane] = found[steps, m.WISHED, lanes]
        self._series[block, self._program[block, m.SLOT], ..., lane] = self._series[block, steps, ..., lane]
        now, shorter, wanted = gone.start[steps, lanes], SHORTER * gone.size[steps, lanes], gone.wanted[steps, lanes]
        self._plan(m.NOW)[block, lane], self._plan(m.LEAST)[block, lane] = now, shorter
        following = np.minimum(wanted, shorter)
        is_stuck = (following < LEAST_STEP * self.end_time) | (now + following <= now)
        self._plan(m.STATUS)[block, lane] = np.where(is_stuck, m.STUCK, m.GOES)

    def _enter_pieces(self) -> None:
        """Lanes that have come to the end of a piece of the span, or begin, go on with the next one."""
        status = self._plan(m.STATUS)
        if not (status == m.RESTS).any():
            return
        piece = np.minimum(np.searchsorted(self._ends, self._plan(m.NOW), side="right"), len(self._ends) - 1)
        shares = self._shares[np.maximum(self._which, 0)].reshape(-1, LANES)
        self._plan(m.END)[:], self._plan(m.BOUND)[:] = self._ends[piece], shares * self._bounds[piece]
        status[status == m.RESTS] = m.GOES

    def _cut(self) -> None:
        """Steps go up to just behind where the argument of a condition first changes its sign."""
        width = self._layout.width
        plans = [self._plan(row).reshape(-1) for row in (m.NOW, m.LEAST, m.BOUND, m.CAP, m.END, m.STATUS)]
        wanted, units = self._rows[:, self._layout.told + WANTED].reshape(-1), self._rows[:, 0].reshape(-1)
        for index, (now, least, bound, cap, end, status) in enumerate(zip(*plans, strict=True)):
            size = found = min(wanted[index], cap, least, bound, end - now)
            block, lane = divmod(index, LANES)
            slot = self._series[block, self._program[block, m.SLOT], :, :, lane]
            for row in range(width, width + self._conditions if status == m.GOES else width):
                at = _first_change(slot[::-1, row], found / units[index]) * units[index]
                if at < found:
                    found = min(found, at + ROOM * ROUNDING * max(now, size))
            self._plan(m.CUT)[block, lane] = found if found < size else np.inf


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
