"""Branches of periodic motions over a parameter, step by step along their arc, and the bifurcations on them.

A step goes along the tangent; Newton's method leads back, across it (pseudo-arclength). Where on the way a multiplier
becomes −1 the period doubles, where it becomes 1 the branch turns back (saddle-node) or another one crosses it; where a
pair of complex ones leaves the unit circle a torus is born. Each is located by false position, and from doublings and
crossings the new branches are followed, too.
Sources: H. B. Keller, in: Applications of Bifurcation Theory (1977) 359–384; Seydel, Practical Bifurcation and
Stability Analysis, 3rd ed., §4.5, §5.4, §7.4 to §7.6.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Literal

import numpy as np

from ..simulation.problem import Floats
from .closing import Closed, Closing

Kind = Literal["period-doubling", "saddle-node", "branching", "torus"]
Test = Callable[[Closed], float]
FIRST, LONGEST, SHORTEST = 2e-3, 0.03, 1e-7  # steps, over the scales
BENT = 0.97  # the cosine between tangents, below which a step is halved
FARTHEST = 30.0  # over the scales: a branch that goes farther leaves the picture
WILDEST = 1e5  # |μ| beyond which nothing can be told
BESIDE = 4e-3  # over the scales: how far beside a bifurcation its new branch is sought
LOCATING, FLAT = 60, 1e-12
HALVINGS, ASIDE = 4, 0.53  # of a step with a crossing, whose middle is avoided: symmetry puts crossings there
AROUND, REACHES = (
    (-1.0, -0.6, -0.2, 0.2, 0.6, 1.0),
    (0.1, 0.05),
)  # where beside a crossing, and in which parts of a step
COARSER = 2.0  # neighbours of a second search: what is wrong by differences is 15 times the first one's there
UPRIGHT = 1e-7  # how little of the parameter's range a branch of five points covers that is no branch over it


@dataclass(frozen=True)
class Point:
    """A periodic motion: its `unknown` (y, [τ,] p), its `tangent` over scales, and what its equations say there.

    Both have shape (2n + 1,), or (2n + 2,) without a drive.
    """

    unknown: Floats
    tangent: Floats
    closed: Closed

    @property
    def value(self) -> float:
        """Of the parameter."""
        return float(self.unknown[-1])


@dataclass(frozen=True)
class Bifurcation:
    """Where a branch changes: the point there, and how far the value may be off."""

    kind: Kind
    point: Point
    error: float


@dataclass(frozen=True)
class Branch:
    """Periodic motions of as many folds that follow one another, and the bifurcations between them."""

    closing: Closing
    points: tuple[Point, ...]
    bifurcations: tuple[Bifurcation, ...]

    @property
    def folds(self) -> int:
        """Periods, or passages, after which its motions close."""
        return self.closing.folds


@dataclass(frozen=True)
class Range:
    """From where to where the parameter goes, and how many points a branch may have."""

    low: float
    high: float
    most: int = 600

    def holds(self, value: float) -> bool:
        """Whether a value lies within."""
        return self.low <= value <= self.high


def begun(closing: Closing, near: Floats, normal: Floats) -> Point | None:
    """The periodic motion near an unknown, across a normal, both of shape (2n + 1,) or (2n + 2,)."""
    found = closing.root(near, normal)
    return None if found is None else Point(found[0], closing.tangent(found[1], normal), found[1])


def at_value(closing: Closing, near: Floats) -> Point | None:
    """The periodic motion near an unknown, shape (2n + 1,) or (2n + 2,), at its value of the parameter."""
    return begun(closing, near, _last(len(near)))


def followed(closing: Closing, start: Point, limits: Range, *, both: bool = True) -> Branch:
    """The branch through a point, in the direction of its tangent or in both."""
    ahead = _one_way(closing, start, limits)
    if both:
        back = _one_way(closing, replace(start, tangent=-start.tangent), limits)
        points = [*(replace(one, tangent=-one.tangent) for one in reversed(back[1:])), *ahead]
    else:
        points = ahead
    found = [each for pair in pairwise(points) for each in _between(closing, *pair)]
    inside = [each for each in found if limits.holds(each.point.value)]
    return Branch(closing, tuple(points), tuple(inside))


def _one_way(closing: Closing, start: Point, limits: Range) -> list[Point]:
    points, step = [start], FIRST
    while len(points) < limits.most and step > SHORTEST and _is_near(closing, points[-1]):
        before = points[-1]
        near = before.unknown + closing.scales * step * before.tangent
        found = begun(closing, near, before.tangent)
        if found is not None and found.tangent @ before.tangent < 0.0:
            found = replace(found, tangent=-found.tangent)
        if found is None or found.tangent @ before.tangent < BENT or _jumps(closing, before, found, step):
            step *= 0.5
            continue
        if not limits.holds(found.value):
            edge = limits.low if found.value < limits.low else limits.high
            share = (edge - before.value) / (found.value - before.value)
            last = at_value(closing, _with_value(before.unknown + share * (found.unknown - before.unknown), edge))
            if last is not None and last.value != before.value:
                turned = last.tangent @ before.tangent < 0.0
                points.append(replace(last, tangent=-last.tangent) if turned else last)
            break
        points.append(found)
        if _stays(points, limits):
            break
        if len(points) > 8 and _apart(closing, start, found) < 0.7 * step:
            break  # it has come round
        step = min(LONGEST, 1.4 * step)
    return points


def _jumps(closing: Closing, before: Point, found: Point, step: float) -> bool:
    """Whether Newton's method has come to another branch."""
    return _apart(closing, before, found) > 2.0 * step


def _apart(closing: Closing, one: Point, other: Point) -> float:
    apart = (one.unknown - other.unknown) / closing.scales
    return float(np.linalg.norm(apart))


def _is_near(closing: Closing, point: Point) -> bool:
    """Whether a point is within the picture, and its neighbours tell it from others."""
    size = np.abs(closing.state(point.unknown) / closing.scales[: closing.width])
    rates = size[closing.width // 2 :]
    far = max(float(rates.max()), float(size[: closing.width // 2][~closing.turns].max(initial=0.0)))
    return far < FARTHEST and bool(np.abs(point.closed.multipliers).max(initial=0.0) < WILDEST)


def _between(closing: Closing, one: Point, other: Point) -> list[Bifurcation]:
    """The bifurcations between neighbouring points."""
    found: list[Bifurcation] = []
    turns_back = one.tangent[-1] * other.tangent[-1] < 0.0
    tests: tuple[tuple[Kind, Test], ...] = (
        ("period-doubling", lambda closed: closed.doubling),
        ("saddle-node" if turns_back else "branching", lambda closed: closed.folding),
        ("torus", lambda closed: closed.turning),
    )
    for kind, test in tests:
        values = test(one.closed), test(other.closed)
        if not np.isfinite(values).all() or values[0] * values[1] >= 0.0:
            continue
        seek = _crossed if kind == "branching" else _located
        point = seek(_Chord(closing, one, other), test)
        coarser = replace(closing, flow=closing.flow.coarser(COARSER))
        again = None if point is None else seek(_Chord(coarser, one, other), test)
        if point is not None and again is not None:
            error = 0.25 * abs(point.value - again.value) + 4.0 * float(np.spacing(abs(point.value)))
            found.append(Bifurcation(kind, point, error))
    return found


@dataclass(frozen=True)
class _Chord:
    """The way from a point to the next one: roots are sought across it."""

    closing: Closing
    one: Point
    other: Point

    @property
    def way(self) -> Floats:
        return self.other.unknown - self.one.unknown

    def at(self, share: float) -> Point | None:
        """The point next to a part of the way."""
        normal = self.way / self.closing.scales
        return begun(self.closing, self.one.unknown + share * self.way, normal / np.linalg.norm(normal))


def _located(chord: _Chord, test: Test) -> Point | None:
    """The point between two at which a test is zero, by false position (Illinois)."""
    a, b, left, right = 0.0, 1.0, test(chord.one.closed), test(chord.other.closed)
    scale, side, last = max(abs(left), abs(right)), 0, math.nan
    found = None
    for _ in range(LOCATING):
        share = (a * right - b * left) / (right - left)
        found = chord.at(share)
        if found is None:
            return None
        value = test(found.closed)
        if not math.isfinite(value) or abs(share - last) < FLAT or abs(value) < FLAT * scale:
            break
        last = share
        if value * left > 0.0:
            a, left = share, value
            right, side = (0.5 * right if side == -1 else right), -1
        else:
            b, right = share, value
            left, side = (0.5 * left if side == 1 else left), 1
    return found


def _crossed(chord: _Chord, test: Test) -> Point | None:
    """The point between two at which another branch crosses: there Newton's method fails, so it lies between others.

    The test and the points are polynomials along the way, through some on both sides of the crossing.
    """
    middle = _halved(chord, test)
    for reach in REACHES:
        shares, points = middle + reach * np.array(AROUND), list[Point]()
        for share in map(float, shares):
            point = chord.at(share)
            if point is None:
                return None
            points.append(point)
        local = np.array(AROUND)
        course = np.polyfit(local, [test(point.closed) for point in points], len(AROUND) - 1)
        roots = np.roots(course)
        real = roots[np.abs(roots.imag) < 1e-9].real
        if not len(real):
            return None
        near = float(real[np.argmin(np.abs(real))])
        if abs(near) > 1.0:
            return None
        unknown = np.array(
            [np.polyval(np.polyfit(local, values, len(AROUND) - 1), near) for values in _unknowns(points)]
        )
        middle += reach * near
    closed = chord.closing.at(unknown)
    return None if closed is None else Point(unknown, chord.one.tangent, closed)


def _halved(chord: _Chord, test: Test) -> float:
    """About where on the way a test changes its sign: the secant through the ends of an interval halved some times."""
    a, b, left, right = 0.0, 1.0, test(chord.one.closed), test(chord.other.closed)
    for _ in range(HALVINGS):
        middle = a + ASIDE * (b - a)
        point = chord.at(middle)
        if point is None:
            break
        value = test(point.closed)
        if value * left > 0.0:
            a, left = middle, value
        else:
            b, right = middle, value
    return (a * right - b * left) / (right - left)


def _unknowns(points: list[Point]) -> Floats:
    """The components of several unknowns, shape (components, points)."""
    return np.array([point.unknown for point in points]).T


def sprung(found: Bifurcation, closing: Closing, limits: Range) -> list[Branch]:
    """The branches that spring from a bifurcation: of twice the folds, or that cross there."""
    if found.kind == "period-doubling":
        doubled = replace(closing, folds=2 * closing.folds)
        directions = [_alternating(found.point, closing)]
    elif found.kind == "branching":
        doubled, way = closing, np.append(np.linalg.svd(found.point.closed.slopes[:, :-1])[2][-1], 0.0)
        directions = [way, -way]
    else:
        return []
    unknown = found.point.unknown.copy()
    if closing.period is None and doubled is not closing:
        unknown[closing.width] *= 2.0
    branches = []
    for way in directions:
        start = begun(doubled, unknown + doubled.scales * BESIDE * way, way)
        if start is None or _is_same(found.point, start, closing):
            continue
        start = start if start.tangent @ way > 0.0 else replace(start, tangent=-start.tangent)
        branch = followed(doubled, start, limits, both=False)
        if len(branch.points) > 1 and not _stays(branch.points, limits):
            branches.append(branch)
    return branches


def _is_same(point: Point, start: Point, closing: Closing) -> bool:
    """Whether a start lies on the branch that it was to spring from."""
    width = closing.width
    way = (start.unknown - point.unknown) / closing.scales
    along = way - (way @ point.tangent) * point.tangent
    return bool(np.linalg.norm(along[:width]) < 0.1 * BESIDE)


def _stays(points: list[Point] | tuple[Point, ...], limits: Range) -> bool:
    """Whether points stay at one value of the parameter, as motions of linear scenes do."""
    values = [point.value for point in points]
    return len(values) > 4 and float(np.ptp(values)) < UPRIGHT * (limits.high - limits.low)


def _alternating(point: Point, closing: Closing) -> Floats:
    """The direction with the multiplier −1, over scales, of length 1."""
    values, vectors = np.linalg.eig(point.closed.image.by_state)
    way = vectors[:, int(np.argmin(np.abs(values + 1.0)))].real / closing.scales[: closing.width]
    whole = np.concatenate([way, np.zeros(len(closing.scales) - closing.width)])
    return np.asarray(whole / np.linalg.norm(whole))


def _last(width: int) -> Floats:
    return np.append(np.zeros(width - 1), 1.0)


def _with_value(unknown: Floats, value: float) -> Floats:
    return np.append(unknown[:-1], value)
