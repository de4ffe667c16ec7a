"""Random test functions at which steps about functionals are verified.

They are polynomials, given by their values and rates at the start of the interval. Over an interval of the length L
the rate times L is a quarter of the value, and higher ones are smaller still: then what is integrated has no
singularity near the interval, not even in the complex plane, and Gauss quadrature is good to more than the tolerance.
The integrand has to be real on the interval and for half its length on either side; functions and parameters are made
larger, smaller and negative until it is.
"""

from __future__ import annotations

import math
import random
from itertools import islice

from flint import arb, ctx

from ..language.spelling import spell_rate
from .differential_expression import direction
from .domain import Instant, Interval
from .evaluation import components
from .functional import Functional
from .points import HIGHEST, Place, Point, along_motion
from .program import number
from .verification import BITS

Held = tuple[int, int]
ATTEMPTS, WANTED = 96, 8
# Everything is made larger or smaller by these powers of two, for logarithms, square roots and inverse sines.
SIZES = (0, -2, -6, 4)
POSITIVE = 12  # attempts before signs and sizes of parameters are drawn too
RATE, CURVATURE = -2, -8  # powers of two for the rate, and for all higher ones
INSIDE = (arb(0), arb(1) / 2, arb(1))  # of the interval
PLACE = arb(3) / 8  # where in the interval formulas without an integral are looked at
AROUND = (arb(-1) / 2, *INSIDE, arb(3) / 2)


def function_points(functional: Functional, *, held: Held = (0, 0), seed: int = 1) -> tuple[Point, ...]:
    """Jets of test functions; δx and δẋ vanish at the ends as far as they are `held` there.

    Those where the integrand is real on a wider interval, else where it is on the interval itself, else any.
    """
    with ctx.workprec(BITS):
        source = random.Random(seed)
        candidates = [_candidate(functional, source, attempt) for attempt in range(ATTEMPTS)]
        for places in (AROUND, INSIDE):
            real = (point for point in candidates if _is_real(functional, point, places))
            if chosen := tuple(islice(real, WANTED)):
                return tuple(_within(functional, _held(functional, point, held)) for point in chosen)
        return tuple(candidates[:WANTED])


def _candidate(functional: Functional, source: random.Random, attempt: int) -> Point:
    """Values of all names: parameters first, as the interval may depend on them, then functions and directions."""
    signs, sizes = ((-1, 1), (0, -3, 3)) if attempt >= POSITIVE else ((1,), (0,))
    size = SIZES[attempt % len(SIZES)]
    point = {s.name: source.choice(signs) * _random(source, source.choice(sizes)) for s in functional.names.symbols}
    length = arb(1)
    if isinstance(functional.domain, Interval):
        lower, upper = _ends(functional, point)
        point["t"], length = lower, upper - lower
    for x in functional.functions:
        sign = source.choice(signs)
        for n in range(_orders(functional) + 1):
            smaller = (0, RATE, CURVATURE)[min(n, 2)]
            point[spell_rate(x, n)] = sign * _random(source, size + smaller) / length**n
            point[_direction(x, n)] = _random(source, size) / length**n
    return Place(point)


def _orders(functional: Functional) -> int:
    """The highest rate that is needed: an equation has twice the order of its integrand."""
    return min(HIGHEST, max(2, 2 * functional.highest))


def _direction(function: str, order: int) -> str:
    return spell_rate(direction(function).name, order)


def _random(source: random.Random, size: int) -> arb:
    """An exact dyadic value between 1/4 and 7/4, times this power of two."""
    return arb(source.randint(2**20, 7 * 2**20)) * arb(2) ** (size - 22)


def _ends(functional: Functional, point: Point) -> tuple[arb, arb]:
    bounds = functional.interval
    return number(bounds.lower, point), number(bounds.upper, point)


def _is_real(functional: Functional, point: Point, places: tuple[arb, ...]) -> bool:
    """Whether the expression has a value at all of these places of its interval, or where else it is looked at."""
    match functional.domain:
        case Interval():
            lower, upper = _ends(functional, point)
            times = [lower + place * (upper - lower) for place in places]
        case Instant(at):
            times = [number(functional.expression(at), point)]
        case _:
            times = [point["t"]]
    along = (along_motion(point, time - point["t"]) for time in times)
    return all(value.is_finite() for there in along for value in components(functional.value, there))


def _within(functional: Functional, point: Point) -> Point:
    """The same functions, seen from a time inside the interval: at its start terms may vanish that count elsewhere."""
    if not isinstance(functional.domain, Interval):
        return point
    lower, upper = _ends(functional, point)
    return Place(along_motion(point, PLACE * (upper - lower)))


def _held(functional: Functional, point: Point, held: Held) -> Point:
    """The point with directions (s/L)ᵃ (1 − s/L)ᵇ p(s), where a and b of δx, δẋ, … are zero at the ends."""
    if not any(held) or not isinstance(functional.domain, Interval):
        return point
    lower, upper = _ends(functional, point)
    length, highest = upper - lower, _orders(functional)
    zeros = [min(number_held, highest // 2) for number_held in held]
    jets: dict[str, arb] = {}
    for x in functional.functions:
        rest = [point[_direction(x, n)] for n in range(highest + 1 - sum(zeros))]
        whole = _product(rest, *([[arb(0), 1 / length]] * zeros[0]), *([[arb(1), -1 / length]] * zeros[1]))
        jets |= {_direction(x, n): math.factorial(n) * coefficient for n, coefficient in enumerate(whole)}
    return Place({**point, **jets})


def _product(first: list[arb], *others: list[arb]) -> list[arb]:
    """The coefficients of a product of polynomials, the lowest power first."""
    for other in others:
        total = [arb(0)] * (len(first) + len(other) - 1)
        for i, a in enumerate(first):
            for k, b in enumerate(other):
                total[i + k] += a * b
        first = total
    return first
