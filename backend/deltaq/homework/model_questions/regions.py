"""Claims about parameters: whether two of them hold in the same region.

A claim tells for a set of parameters what it says there. Two are compared at random sets and, wherever one of them
changes between two sets, close to the boundary on either side: so no boundary can be another one by more than
`NEAR`.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise

import sympy as sp

from ...derivation.compiled import compiled
from ...derivation.system import System
from ...language.memory import cached_method

COUNT = 160
SPREAD = math.log(4)
BISECTIONS = 40
MOST_BORDERS = 60
NEAR = 1e-6
NOTHING = 1e-9  # of an entry, relative to the largest

Point = tuple[float, ...]
Valued = Callable[[Sequence[float]], float]
Says = Callable[[Point], str]  # "" where it says nothing


@cached_method
def points(model: System) -> tuple[Point, ...]:
    """The scene's own parameters, then sets around them of the same signs, always the same."""
    source = random.Random(41)
    own = tuple(float(value) for value in model.parameter_values.values())
    drawn = (tuple(value * math.exp(source.uniform(-SPREAD, SPREAD)) for value in own) for _ in range(COUNT))
    return (own, *drawn)


@dataclass(frozen=True)
class Inequality:
    """smaller < larger as a function of the parameters."""

    model: System
    smaller: sp.Expr
    larger: sp.Expr

    def holds(self, point: Point) -> bool:
        """Not where one side is not defined."""
        gap = self._gap(point)
        return math.isfinite(gap) and gap > 0

    def _gap(self, point: Point) -> float:
        return valued(self.model, self.larger - self.smaller)(point)


@cached_method
def valued(model: System, expression: sp.Expr) -> Valued:
    """An expression in the parameters as a function of them."""
    return compiled(expression, {symbol: slot for slot, symbol in enumerate(model.parameter_values)})


@dataclass(frozen=True)
class Place:
    """A set of parameters, and what is true there."""

    point: Point
    word: str


def places(true: Says, model: System) -> tuple[Place, ...]:
    """Where something is known: at the points, and close to every change between two of them, on either side."""
    known = [Place(point, true(point)) for point in points(model)]
    known = [place for place in known if place.word]
    borders = [(a.point, b.point) for a, b in pairwise(known) if a.word != b.word][:MOST_BORDERS]
    beside = (Place(point, true(point)) for a, b in borders for point in _beside(true, a, b))
    return (*known, *(place for place in beside if place.word))


def says_the_same(given: Says, known: Sequence[Place]) -> bool:
    """Whether a claim says what is true wherever that is known."""
    return all(given(place.point) == place.word for place in known)


def _beside(says: Says, one: Point, other: Point) -> tuple[Point, Point]:
    """Two points on either side of where a claim changes between two others."""
    low, high, start = 0.0, 1.0, says(one)
    for _ in range(BISECTIONS):
        middle = (low + high) / 2
        low, high = (middle, high) if says(_between(one, other, middle)) == start else (low, middle)
    return _between(one, other, low - NEAR), _between(one, other, high + NEAR)


def _between(one: Point, other: Point, share: float) -> Point:
    return tuple(a + share * (b - a) for a, b in zip(one, other, strict=True))


def definiteness(matrix: Sequence[Sequence[float]]) -> int:
    """1 for a positive definite symmetric matrix, −1 for one with a negative eigenvalue, 0 where that is open.

    The largest element of the diagonal is eliminated as long as it is positive. What is left then has no positive
    element there: it has a negative eigenvalue unless it is zero.
    Source: Golub, Van Loan, Matrix Computations, 4th ed., §4.2 (Schur complements and inertia).
    """
    rest = [list(row) for row in matrix]
    if not all(math.isfinite(entry) for row in rest for entry in row):
        return 0
    small = NOTHING * max(abs(entry) for row in rest for entry in row)
    while rest:
        pivot = max(range(len(rest)), key=lambda k: rest[k][k])
        if rest[pivot][pivot] <= small:
            return -any(abs(entry) > small for row in rest for entry in row)
        rest = _complement(rest, pivot)
    return 1


def _complement(matrix: list[list[float]], pivot: int) -> list[list[float]]:
    others = [k for k in range(len(matrix)) if k != pivot]
    size = matrix[pivot][pivot]
    return [[matrix[i][k] - matrix[i][pivot] * matrix[pivot][k] / size for k in others] for i in others]
