"""Where many motions of one scene cross a plane, by the Taylor series of their steps.

All motions go their steps side by side, each its own, as arrays; the series are those of ensembles, so that no kernel
has to be compiled. At the ends of some parts of each step it is looked at the plane's function and its derivative by
time: in a part it changes its sign, or its cubic touches zero and turns back. There its root is sought on the step's
own polynomial, by Newton's method inside a bracket.
Sources: M. Hénon, Physica D 5 (1982) 412–414 (sections); Press et al., Numerical Recipes, 3rd ed., §9.4 (bracket).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from .integration import Flag
from .kernels.motion import CANCELLED
from .march import Integers, March, Polynomials, Truths
from .problem import Floats, Problem
from .run import Steps

PARTS = 4  # of a step, at whose ends the plane's function is looked at
AT_ONCE = 256  # crossings whose roots are sought together
ROUNDS = 64  # steps of all motions after which what was found is told
MOST_ROOT_STEPS = 60
NEAR = 0.1  # what the cubic says of a minimum, over the values beside it, for which it is looked at itself
UNSEEN = 0.1  # how far a cubic may be from the function, over its size in the step
STILL = 8.0  # times the change of h in a step that its fastest part may suggest
ZERO = 1e-12  # h of a start over its rounding scale, for the start to lie in the plane


@dataclass(frozen=True)
class Surface:
    """Where h(q, q̇, t) = 0 and h rises (`direction` 1), falls (−1) or does either (0).

    `values` takes rows (q, q̇, t), shape (rows, 2n + 1), to h with its derivatives by each of them, shape (rows,
    2n + 2); h means the same after a `turn`.
    """

    values: Callable[[Floats], Floats]
    direction: int = 1
    turn: float = math.inf

    def slopes(self, rows: Floats, rates: Floats) -> tuple[Floats, Floats]:
        """h and ḣ, shape (…,), at rows (q, q̇, t) where (q, q̇) have these time derivatives."""
        count = rows.shape[-1]
        found = self.values(rows.reshape(-1, count)).reshape(*rows.shape[:-1], count + 1)
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
) -> Iterator[tuple[Crossings, Standing]]:
    """The crossings of motions from `starts`, shape (motions, 2n), as they come, with where all stand.

    A motion ends at the problem's t_end, or with so many crossings. A start that lies in the plane is the first.
    With `twins` (`march.March`) each motion has one, whose number is as much larger as there are motions.
    """
    march = March(problem, starts, steps, twins=twins)
    search = _Search(surface, march)
    rounds = 0
    while march.goes_on:
        search.look()
        rounds += 1
        if cancelled[0] != 0:
            march.end_all(CANCELLED)
        march.end(search.crossed >= most)
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


@dataclass(frozen=True)
class _Looked:
    """A step of all lanes as the plane sees it: at the ends of its parts, the beginning with them."""

    which: Integers
    theta: Floats
    values: Floats
    slopes: Floats
    lengths: Floats


class _Search:
    """Looks at each step of all motions and keeps where they cross."""

    def __init__(self, surface: Surface, march: March) -> None:
        self.surface, self.march, self.pending = surface, march, 0
        self.crossed, self._reach = np.zeros(march.count, dtype=np.int64), np.zeros(march.count)
        self._kept: list[Brackets] = []
        rows, rates = march.rows()
        found = surface.values(rows)
        scale = (np.abs(found[:, 1:-1]) * np.abs(rows[:, :-1])).sum(axis=1)
        value, shift = found[:, 0], surface.shift(found[:, 0])
        is_zero = np.abs(value - shift) <= ZERO * np.maximum(scale, np.abs(value))
        self._value, self._slope = np.where(is_zero, shift, value), (found[:, 1:-1] * rates).sum(axis=1) + found[:, -1]
        begun = np.flatnonzero(is_zero & (self._slope * (surface.direction or np.sign(self._slope)) > 0.0))
        self._begun = Crossings(begun, rows[begun, -1], rows[begun, :-1], self._slope[begun])
        self.crossed[begun] = 1

    def look(self) -> None:
        """A step of all motions: those that see the plane well enough are accepted, and searched for crossings."""
        theta, rows, rates, lengths = self.march.step(PARTS)
        which = self.march.which
        values, slopes = self.surface.slopes(rows, rates)
        values, slopes = np.vstack([self._value[which], values]), np.vstack([self._slope[which], slopes])
        taken = self.march.accept(self._is_unseen(values, slopes, lengths))
        done = which[taken]
        self._reach[done] = np.maximum(self._reach[done], np.abs(values).max(axis=0)[taken])
        self._value[done], self._slope[done] = values[-1][taken], slopes[-1][taken]
        self._bracket(_Looked(which, np.vstack([np.zeros(len(which)), theta]), values, slopes, lengths), taken)

    def _is_unseen(self, values: Floats, slopes: Floats, lengths: Floats) -> Truths:
        """Whether h does in a step what its values at the ends of parts do not show: cubics through two miss others."""
        size = np.abs(values).max(axis=0)
        middle = 0.5 * (values[:-2:2] + values[2::2]) + 0.25 * lengths * (slopes[:-2:2] - slopes[2::2])
        is_missed = (np.abs(middle - values[1::2]) > UNSEEN * size).any(axis=0)
        # values that are alike while h moves fast: it has turned back as often between them
        return np.asarray(
            is_missed | (lengths * np.abs(slopes).max(axis=0) > STILL * np.ptp(values, axis=0) + ZERO * size)
        )

    def _bracket(self, seen: _Looked, taken: Truths) -> None:
        """Parts in which h changes its sign, or touches zero and turns back."""
        shift = self.surface.shift(0.5 * (seen.values[:-1] + seen.values[1:]))
        left, right = seen.values[:-1] - shift, seen.values[1:] - shift
        part, lane = np.nonzero(self.surface.is_crossed(left, right) & taken)
        if len(part):
            ends = seen.theta[part, lane], seen.theta[part + 1, lane]
            values = (each[part, lane] for each in (left, right, shift))
            self._keep(seen.which[lane], self.march.polynomials(lane), *ends, *values)
        turned = (left * right > 0.0) & (left * seen.slopes[:-1] < 0.0) & (right * seen.slopes[1:] > 0.0) & taken
        if turned.any():
            part, lane = np.nonzero(turned)
            self._touch(seen, part, lane, left, right, shift)

    def _keep(self, which: Integers, series: Polynomials, *arrays: Floats) -> None:
        """Keeps brackets, of the motions of these numbers."""
        self._kept.append(Brackets(which, series, *arrays))
        self.pending += len(which)
        np.add.at(self.crossed, which, 1)

    def _touch(self, seen: _Looked, part: Integers, lane: Integers, left: Floats, right: Floats, shift: Floats) -> None:
        """Where the cubic's extremum is near zero or behind it, h there decides; both halves may be crossings."""
        left, right, shift = left[part, lane], right[part, lane], shift[part, lane]
        falls, rises = seen.slopes[part, lane] * seen.lengths[lane], seen.slopes[part + 1, lane] * seen.lengths[lane]
        x, extremum = _extremum(left, right, falls, rises)
        near = extremum * np.sign(left) <= NEAR * np.minimum(np.abs(left), np.abs(right))
        if not near.any():
            return
        part, lane = part[near], lane[near]
        x, left, right, shift = (each[near] for each in (x, left, right, shift))
        a, b = seen.theta[part, lane], seen.theta[part + 1, lane]
        series = self.march.polynomials(lane)
        middle, value = _lowest(series, self.surface, a, b, a + x * (b - a), np.sign(left))
        value = value - shift
        for half in ((a, middle, left, value), (middle, b, value, right)):
            is_in = self.surface.is_crossed(*half[2:])
            if is_in.any():
                self._keep(seen.which[lane[is_in]], series.chosen(is_in), *(each[is_in] for each in (*half, shift)))

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


def _lowest(
    series: Polynomials, surface: Surface, a: Floats, b: Floats, x: Floats, sign: Floats
) -> tuple[Floats, Floats]:
    """Place and value of the extremum of h between a and b, where `sign` ḣ turns from negative to positive."""
    value = np.zeros_like(x)
    for _ in range(MOST_ROOT_STEPS):
        value, slope = surface.slopes(*series.at(x))
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
    """The root in each bracket to rounding: Newton's step where it stays inside, else the middle."""
    a, b, series = found.a.copy(), found.b.copy(), found.series
    theta = a + (b - a) * found.left / (found.left - found.right)
    for _ in range(MOST_ROOT_STEPS):
        values, slopes = surface.slopes(*series.at(theta))
        values = values - found.shift
        is_left = values * np.sign(found.left) > 0.0
        a, b = np.where(is_left, theta, a), np.where(is_left, b, theta)
        with np.errstate(divide="ignore", invalid="ignore"):
            following = theta - values / (slopes * series.units)
        following = np.where((following >= a) & (following <= b), following, 0.5 * (a + b))
        change, theta = np.abs(following - theta), following
        if (change <= 4.0 * np.spacing(theta)).all():
            break
    rows, rates = series.at(theta)
    return Crossings(found.motions, rows[:, -1], rows[:, :-1], surface.slopes(rows, rates)[1])


def path_of(problem: Problem, steps: Steps, most: int, cancelled: Flag) -> Floats:
    """The ends of the steps of the problem's own motion, `most` at most, as rows (q, q̇, t), shape (steps, 2n + 1)."""
    march = March(problem, problem.state[None, : 2 * problem.degrees], steps)
    rows = [march.rows()[0]]
    while march.goes_on and len(rows) < most and cancelled[0] == 0:
        march.step(1)
        if march.accept(np.zeros(1, dtype=bool))[0]:
            rows.append(march.rows()[0])
    return np.concatenate(rows)
