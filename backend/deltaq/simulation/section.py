"""Where many motions of one scene cross a plane, by the Taylor series of their steps.

All motions go some steps side by side, each its own, in one call (`march`). At the ends of some parts of each step it
is looked at the plane's function and its derivative by time: in a part it changes its sign, or its cubic touches zero
and turns back. There its root is sought on the step's own polynomial, by Newton's method inside a bracket.
Sources: M. Hénon, Physica D 5 (1982) 412–414 (sections); Press et al., Numerical Recipes, 3rd ed., §9.4 (bracket).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from .integration import Flag
from .kernels.motion import CANCELLED
from .march import Gone, Integers, March, Polynomials, Truths
from .problem import Floats, Problem
from .run import Steps

TOLERANCE, ORDER = 1e-16, 36  # local, and of the series, of motions that are followed to rounding
LARGEST_STEP = 0.05  # of these, over the span
STAYS = 1e-9  # |h| over its scale, below which a motion is in the surface all the time
PARTS = 4  # of a step, at whose ends the plane's function is looked at
AT_ONCE = 256  # crossings whose roots are sought together
ROUNDS = 8  # of some steps of all motions, after which what was found is told
MOST_ROOT_STEPS = 60
NEAR = 0.1  # what the cubic says of a minimum, over the values beside it, for which it is looked at itself
UNSEEN = 0.1  # how far a cubic may be from the function, over its size in the step
STILL = 8.0  # times the change of h in a step that its fastest part may suggest
ZERO = 1e-12  # h of a start over its rounding scale, for the start to lie in the plane


@dataclass(frozen=True)
class Surface:
    """Where h(q, q̇, t) = 0 and h rises (`direction` 1), falls (−1) or does either (0).

    `values` takes rows (q, q̇, t), shape (rows, 2n + 1), to h with its derivatives by each of them, shape (rows,
    2n + 2); h means the same after a `turn`. Where h has numbers of its own for each motion, `parameters`, shape
    (motions, count), they stand behind the time in what `values` takes.
    """

    values: Callable[[Floats], Floats]
    direction: int = 1
    turn: float = math.inf
    parameters: Floats | None = None

    def at(self, rows: Floats, motions: Integers) -> Floats:
        """h with its derivatives, shape (rows, 2n + 2), at rows (q, q̇, t) of motions of these numbers, shape (rows,).

        Twins are numbered behind all motions, and have the same parameters.
        """
        if self.parameters is None:
            return self.values(rows)
        return self.values(np.column_stack([rows, self.parameters[motions % len(self.parameters)]]))

    def slopes(self, rows: Floats, rates: Floats, motions: Integers) -> tuple[Floats, Floats]:
        """h and ḣ, shape (…,), at rows (q, q̇, t) where (q, q̇) have these time derivatives.

        `motions` are the numbers of the motions along the last axis but that of a row.
        """
        count = rows.shape[-1]
        each = np.broadcast_to(motions, rows.shape[:-1]).ravel()
        found = self.at(rows.reshape(-1, count), each).reshape(*rows.shape[:-1], count + 1)
        return found[..., 0], (found[..., 1:-1] * rates).sum(axis=-1) + found[..., -1]

    def shift(self, values: Floats) -> Floats:
        """The whole turns next to each of the values, which have any shape (…,)."""
        return np.zeros_like(values) if math.isinf(self.turn) else np.asarray(self.turn * np.round(values / self.turn))

    def is_crossed(self, left: Floats, right: Floats) -> Truths:
        """Whether h goes through zero in the direction wanted between values of it, shape (…,); zero counts once."""
        rises, falls = (left < 0.0) & (right >= 0.0), (left > 0.0) & (right <= 0.0)
        return np.asarray({1: rises, -1: falls}.get(self.direction, rises | falls))


@dataclass(frozen=True)
class Crossings:
    """Where `motions` of these numbers crossed: `times`, `states` (q, q̇) and `speeds` ḣ, shape (crossings, …)."""

    motions: Integers
    times: Floats
    states: Floats
    speeds: Floats

    @property
    def rows(self) -> Floats:
        """Rows (q, q̇, t), shape (crossings, 2n + 1)."""
        return np.column_stack([self.states, self.times])

    @property
    def none(self) -> Crossings:
        """No crossing, of the same shape."""
        return Crossings(self.motions[:0], self.times[:0], self.states[:0], self.speeds[:0])


@dataclass(frozen=True)
class Standing:
    """What became of each motion so far, shape (motions,): the time `reached`, how often it `crossed`, its `reach` |h|.

    `outcomes` are those of the kernels, −1 of one that goes on.
    """

    reached: Floats
    crossed: Integers
    outcomes: Integers
    reach: Floats


def follow(
    problem: Problem,
    surface: Surface,
    starts: Floats,
    steps: Steps,
    most: int,
    cancelled: Flag,
    *,
    twins: bool = False,
    parameters: Floats | None = None,
) -> Iterator[tuple[Crossings, Standing]]:
    """The crossings of motions from `starts`, shape (motions, 2n), as they come, with where all stand.

    A motion ends at the problem's t_end, or with so many crossings. A start that lies in the plane is the first.
    With `twins` and `parameters` see `march.March`; the number of a twin is as much larger as there are motions.
    """
    march = March(problem, starts, steps, PARTS, twins=twins, parameters=parameters)
    search = _Search(surface, march, most)
    rounds = 0
    while march.goes_on:
        search.look()
        rounds += 1
        if cancelled[0] != 0:
            march.end_all(CANCELLED)
        if rounds % ROUNDS == 0 or search.pending >= AT_ONCE:
            yield search.found(), search.standing()
    yield search.found(), search.standing()


@dataclass(frozen=True)
class Brackets:
    """Parts of steps in which h − `shift` changes its sign, from `left` to `right`, at places θ from `a` to `b`.

    All have shape (parts,), `motions` are the numbers of motions.
    """

    motions: Integers
    series: Polynomials
    a: Floats
    b: Floats
    left: Floats
    right: Floats
    shift: Floats

    def chosen(self, which: Truths) -> Brackets:
        """Some of them."""
        rest = (each[which] for each in (self.a, self.b, self.left, self.right, self.shift))
        return Brackets(self.motions[which], self.series.chosen(which), *rest)


@dataclass(frozen=True)
class _Looked:
    """Steps of all lanes as the plane sees them, at the ends of their parts, with their beginning.

    `values` and `slopes` of h have shape (steps, parts + 1, lanes).
    """

    gone: Gone
    taken: Truths
    values: Floats
    slopes: Floats

    def ends(self, step: Integers, part: Integers, lane: Integers) -> tuple[Floats, Floats]:
        """Places θ at which parts begin and end."""
        theta = self.gone.theta[step, lane]
        return part * theta, (part + 1) * theta


@dataclass(frozen=True)
class _Places:
    """Brackets with the step and the lane that each lies in, shape (parts,)."""

    step: Integers
    lane: Integers
    brackets: Brackets

    def chosen(self, which: Truths) -> _Places:
        """Some of them."""
        return _Places(self.step[which], self.lane[which], self.brackets.chosen(which))


def nearest(times: Floats, others: Floats) -> Integers:
    """For each time the number of the other time next to it, the earlier of two as near: shape (times,).

    Both ascend; of `others`, shape (others,), there is at least one.
    """
    after = np.minimum(np.searchsorted(others, times), len(others) - 1)
    before = np.maximum(after - 1, 0)
    return np.where(np.abs(others[before] - times) <= np.abs(others[after] - times), before, after)


class _Search:
    """Looks at each step of all motions and keeps where they cross, up to so many times."""

    def __init__(self, surface: Surface, march: March, most: int) -> None:
        self.surface, self.march, self.most, self.pending = surface, march, most, 0
        self.crossed, self._reach = np.zeros(march.count, dtype=np.int64), np.zeros(march.count)
        self._kept: list[Brackets] = []
        rows, rates = march.rows()
        found = surface.at(rows, np.arange(len(rows)))
        scale = (np.abs(found[:, 1:-1]) * np.abs(rows[:, :-1])).sum(axis=1)
        value, shift = found[:, 0], surface.shift(found[:, 0])
        is_zero = np.abs(value - shift) <= ZERO * np.maximum(scale, np.abs(value))
        slope = (found[:, 1:-1] * rates).sum(axis=1) + found[:, -1]
        self._last = np.array([np.where(is_zero, shift, value), slope])
        begun = np.flatnonzero(is_zero & (slope * (surface.direction or np.sign(slope)) > 0.0))
        self._begun = Crossings(begun, rows[begun, -1], rows[begun, :-1], slope[begun])
        self.crossed[begun] = 1

    def look(self) -> None:
        """Some steps of all motions: those that see the plane well enough are taken, and searched for crossings."""
        gone = self.march.go()
        with np.errstate(all="ignore"):  # steps that are not taken may end anywhere
            found = np.stack(self.surface.slopes(gone.rows, gone.rates, gone.which))
        values, slopes = self._with_beginnings(gone, found)
        taken = self.march.settle(gone, self._is_unseen(values, slopes, gone.lengths))
        seen = _Looked(gone, taken, values, slopes)
        places = [each for each in (self._signs(seen), *self._touches(seen)) if len(each.step)]
        last = self._keep(gone, places)
        taken = taken & (np.arange(len(taken))[:, None] <= last)
        has = taken.any(axis=0)
        largest = np.where(taken, np.abs(values).max(axis=1), 0.0).max(axis=0)[has]
        which, (lanes,) = gone.which[has], np.nonzero(has)
        step = len(taken) - 1 - np.argmax(taken[::-1, lanes], axis=0)
        self._reach[which] = np.maximum(self._reach[which], largest)
        self._last[:, which] = values[step, -1, lanes], slopes[step, -1, lanes]

    def _with_beginnings(self, gone: Gone, found: Floats) -> Floats:
        """h and ḣ, shape (2, steps, parts, lanes), with what they were where each step began before them.

        Steps that were not taken have what they began with.
        """
        now, all_found = self._last[:, gone.which], np.empty((*found.shape[:2], found.shape[2] + 1, found.shape[3]))
        for step, taken in enumerate(gone.taken):
            all_found[:, step] = now[:, None]
            all_found[:, step, 1:] = np.where(taken, found[:, step], all_found[:, step, 1:])
            now = all_found[:, step, -1]
        return all_found

    def _is_unseen(self, values: Floats, slopes: Floats, lengths: Floats) -> Truths:
        """Whether h does in a step what its values at the ends of parts do not show: cubics through two miss others."""
        size, fastest = np.abs(values).max(axis=1), np.abs(slopes).max(axis=1)
        turned = 0.25 * lengths[:, None] * (slopes[:, :-2:2] - slopes[:, 2::2])
        middle = 0.5 * (values[:, :-2:2] + values[:, 2::2]) + turned
        is_missed = (np.abs(middle - values[:, 1::2]) > UNSEEN * size[:, None]).any(axis=1)
        has_none = np.isnan(values)  # beside where h has no value it may have crossed already
        is_missed |= has_none.any(axis=1) & ~has_none.all(axis=1)
        # values that are alike while h moves fast: it has turned back as often between them
        return np.asarray(is_missed | (lengths * fastest > STILL * np.ptp(values, axis=1) + ZERO * size))

    def _signs(self, seen: _Looked) -> _Places:
        """Parts in which h changes its sign at a root.

        Where a slope at an end goes against the change it may do so at a pole, which would count as a crossing.
        """
        left, right, shift = self._sides(seen)
        at = np.nonzero(self.surface.is_crossed(left, right) & seen.taken[:, None])
        found = self._places(seen, at, *seen.ends(*at), left[at], right[at], shift[at])
        change, before, behind = right[at] - left[at], seen.slopes[:, :-1][at], seen.slopes[:, 1:][at]
        is_odd = (change * before < 0.0) | (change * behind < 0.0)
        if not is_odd.any():
            return found
        is_odd[is_odd] = ~_root_of(found.brackets.chosen(is_odd), self.surface)[1]
        return found.chosen(~is_odd)

    def _sides(self, seen: _Looked) -> tuple[Floats, Floats, Floats]:
        """h at the beginnings and ends of all parts, less the whole turns next to it, and these."""
        left, right = seen.values[:, :-1], seen.values[:, 1:]
        shift = self.surface.shift(0.5 * (left + right))
        return left - shift, right - shift, shift

    def _places(self, seen: _Looked, at: tuple[Integers, ...], *arrays: Floats) -> _Places:
        """Brackets in parts of steps of lanes, as `at` tells."""
        step, _, lane = at
        series = self.march.polynomials(step, lane)
        return _Places(step, lane, Brackets(seen.gone.which[lane], series, *arrays))

    def _touches(self, seen: _Looked) -> list[_Places]:
        """Parts in which h touches zero and turns back.

        Where the cubic's extremum is near zero or behind it, or the tangents at both ends meet there, which is as far
        as a kink can go, h itself decides; both halves may be crossings.
        """
        left, right, shift = self._sides(seen)
        turned = (left * right > 0.0) & (left * seen.slopes[:, :-1] < 0.0) & (right * seen.slopes[:, 1:] > 0.0)
        step, part, lane = np.nonzero(turned & seen.taken[:, None])
        if not len(step):
            return []
        left, right, shift = (each[step, part, lane] for each in (left, right, shift))
        length = seen.gone.lengths[step, lane]
        falls, rises = seen.slopes[step, part, lane] * length, seen.slopes[step, part + 1, lane] * length
        x, extremum = _extremum(left, right, falls, rises)
        tangents = left + falls * (right - left - rises) / (falls - rises)
        lowest = np.minimum(extremum * np.sign(left), tangents * np.sign(left))
        near = lowest <= NEAR * np.minimum(np.abs(left), np.abs(right))
        at = step[near], part[near], lane[near]
        if not near.any():
            return []
        x, left, right, shift = (each[near] for each in (x, left, right, shift))
        a, b = seen.ends(*at)
        series = self.march.polynomials(at[0], at[2])
        brackets = Brackets(seen.gone.which[at[2]], series, a, b, left, right, shift)
        middle, value = _lowest(brackets, self.surface, a + x * (b - a))
        value = value - shift
        halves = ((a, middle, left, value), (middle, b, value, right))
        found = (self._places(seen, at, *half, shift).chosen(self.surface.is_crossed(*half[2:])) for half in halves)
        return list(found)

    def _keep(self, gone: Gone, places: list[_Places]) -> Integers:
        """Keeps brackets; motions that have crossed often enough end. Returns the last step of each lane."""
        last = np.full(len(gone.which), len(gone.taken))
        if not places:
            return last
        counts = np.zeros(gone.taken.shape, dtype=np.int64)
        for each in places:
            np.add.at(counts, (each.step, each.lane), 1)
        total = self.crossed[gone.which] + np.cumsum(counts, axis=0)
        (full,) = np.nonzero((total[-1] >= self.most) & (gone.which >= 0))
        if len(full):
            last[full] = np.argmax(total[:, full] >= self.most, axis=0)
            self.march.stop_behind(last[full], full)
        for each in places:
            kept = each.chosen(each.step <= last[each.lane])
            self._kept.append(kept.brackets)
            self.pending += len(kept.step)
            np.add.at(self.crossed, kept.brackets.motions, 1)
        return last

    def found(self) -> Crossings:
        """The crossings since it was last asked, motion by motion in their order."""
        kept, self._kept, self.pending = self._kept, [], 0
        parts = [self._begun, *(refined(each, self.surface) for each in _joined(kept))]
        self._begun = self._begun.none
        names = ("motions", "times", "states", "speeds")
        motions, times, states, speeds = (np.concatenate([getattr(p, name) for p in parts]) for name in names)
        order = np.lexsort((times, motions))
        order = order[times[order] <= self.march.end_time]
        return Crossings(motions[order], times[order], states[order], speeds[order])

    def standing(self) -> Standing:
        """Where all motions stand."""
        return Standing(self.march.reached(), self.crossed.copy(), self.march.outcomes.copy(), self._reach.copy())


def _extremum(left: Floats, right: Floats, falls: Floats, rises: Floats) -> tuple[Floats, Floats]:
    """Place in 0 … 1 and value of the extremum between two values with slopes of unlike sign (Hermite's cubic)."""
    rise = right - left
    a, b = falls + rises - 2.0 * rise, 3.0 * rise - 2.0 * falls - rises
    root = np.sqrt(np.maximum(b * b - 3.0 * a * falls, 0.0))
    with np.errstate(divide="ignore", invalid="ignore"):
        # of the two roots of 3a x² + 2b x + c that in which the slope turns from that of the left to that of the right
        x = np.where(falls < 0.0, -falls / (b + root), -falls / (b - root))
    x = np.clip(np.nan_to_num(x, nan=0.5), 0.0, 1.0)
    return x, left + x * (falls + x * (b + x * a))


def _lowest(found: Brackets, surface: Surface, x: Floats) -> tuple[Floats, Floats]:
    """Place and value of the extremum of h in each bracket, where |h| turns from falling to rising; x is near it."""
    a, b, sign, value = found.a, found.b, np.sign(found.left), np.zeros_like(x)
    for _ in range(MOST_ROOT_STEPS):
        value, slope = surface.slopes(*found.series.at(x), found.motions)
        is_before = slope * sign < 0.0
        a, b = np.where(is_before, x, a), np.where(is_before, b, x)
        x = 0.5 * (a + b)
    return x, value


def _joined(kept: list[Brackets]) -> list[Brackets]:
    """The brackets together, as one for all."""
    if len(kept) < 2:
        return kept
    arrays = {n: np.concatenate([getattr(k, n) for k in kept]) for n in ("motions", "a", "b", "left", "right", "shift")}
    return [Brackets(series=Polynomials.joined([k.series for k in kept]), **arrays)]


def refined(found: Brackets, surface: Surface) -> Crossings:
    """Where h is zero in each bracket that has a root."""
    theta, root = _root_of(found, surface)
    rows, rates = found.series.at(theta)
    _, slopes = surface.slopes(rows, rates, found.motions)
    return Crossings(found.motions[root], rows[root, -1], rows[root, :-1], slopes[root])


def _root_of(found: Brackets, surface: Surface) -> tuple[Floats, Truths]:
    """The root in each bracket to rounding: Newton's step where it stays inside, else the middle; and if it is one.

    Where h changes its sign at a pole it has none: there it is farther from zero than at both ends.
    """
    a, b, series = found.a.copy(), found.b.copy(), found.series
    theta = a + (b - a) * found.left / (found.left - found.right)
    for _ in range(MOST_ROOT_STEPS):
        values, slopes = surface.slopes(*series.at(theta), found.motions)
        values = values - found.shift
        is_left = values * np.sign(found.left) > 0.0
        a, b = np.where(is_left, theta, a), np.where(is_left, b, theta)
        with np.errstate(divide="ignore", invalid="ignore"):
            following = theta - values / (slopes * series.units)
        following = np.where((following >= a) & (following <= b), following, 0.5 * (a + b))
        change, theta = np.abs(following - theta), following
        if (change <= 4.0 * np.spacing(theta)).all():
            break
    values, _ = surface.slopes(*series.at(theta), found.motions)
    return theta, ~(np.abs(values - found.shift) > np.maximum(np.abs(found.left), np.abs(found.right)))


def path_of(problem: Problem, steps: Steps, most: int, cancelled: Flag) -> Floats:
    """The ends of the steps of the problem's own motion, `most` at most, as rows (q, q̇, t), shape (steps, 2n + 1)."""
    march = March(problem, problem.state[None, : 2 * problem.degrees], steps, 1)
    rows = [march.rows()[0]]
    while march.goes_on and sum(map(len, rows)) < most and cancelled[0] == 0:
        gone = march.go()
        taken = march.settle(gone, np.zeros(gone.taken.shape, dtype=bool))[:, 0]
        rows.append(gone.rows[taken, 0, 0])
    return np.concatenate(rows)[:most]
