"""Random test functions at which steps about functionals are verified."""

from __future__ import annotations

import random
from collections.abc import Iterator
from itertools import cycle, islice

from flint import arb, ctx

from ..language.spelling import spell_rate
from .differential_expression import direction
from .domain import Interval
from .functional import Functional
from .points import Place, Point
from .program import number
from .verification import BITS

Fixed = tuple[bool, bool]
ATTEMPTS = 8
# The functions are made larger or smaller by these powers of two, for logarithms, square roots and inverse sines.
SIZES = (0, -2, -6, 4)
RATE = -2  # rates are smaller still, so that the test functions keep their sign


def function_points(functional: Functional, *, fixed: Fixed = (False, False), seed: int = 1) -> tuple[Point, ...]:
    """Jets of test functions with positive values and small rates; directions vanish at fixed ends."""
    with ctx.workprec(BITS):
        return tuple(_points(functional, random.Random(seed), fixed=fixed))


def _points(functional: Functional, source: random.Random, *, fixed: Fixed) -> Iterator[Point]:
    for size in islice(cycle(SIZES), ATTEMPTS):
        point = {symbol.name: _random(source, 0) for symbol in functional.names.symbols}
        for x in functional.functions:
            point |= {spell_rate(x, n): _random(source, size + (RATE if n else 0)) for n in range(3)}
            point |= {direction(x, n).name: _random(source, size) for n in range(3)}
        yield Place(_anchored(functional, point, fixed=fixed))


def _random(source: random.Random, size: int) -> arb:
    """An exact dyadic value between 1/4 and 7/4, times this power of two."""
    return arb(source.randint(2**20, 7 * 2**20)) * arb(2) ** (size - 22)


def _anchored(functional: Functional, point: Point, *, fixed: Fixed) -> Point:
    """The jets taken at the start of the interval; δx is a parabola that is zero at the fixed ends."""
    if not isinstance(functional.domain, Interval):
        return point
    bounds = functional.interval
    lower, upper = number(bounds.lower, point), number(bounds.upper, point)
    anchored = {**point, "t": lower}
    if any(fixed):
        for x in functional.functions:
            jets = _held([point[direction(x, n).name] for n in range(3)], upper - lower, fixed)
            anchored |= {direction(x, n).name: jet for n, jet in enumerate(jets)}
    return anchored


def _held(jets: list[arb], length: arb, fixed: Fixed) -> list[arb]:
    """Value, slope and curvature at the start, changed so that the parabola is zero at the fixed ends."""
    _, slope, curvature = jets
    match fixed:
        case (True, True):
            return [arb(0), -curvature * length / 2, curvature]
        case (True, False):
            return [arb(0), slope, curvature]
        case _:
            return [-slope * length - curvature * length**2 / 2, slope, curvature]
