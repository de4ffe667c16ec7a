"""Ball arithmetic (Arb, by python-flint): the value of an expression at a point with a rigorous error bound."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Mapping
from functools import reduce
from math import prod
from types import MappingProxyType
from typing import Any, Literal

import flint
import sympy

from .functions import FUNCTIONS, KINKED

PRECISIONS = (96, 400, 4000)
POINTS = 12
ENOUGH_POINTS = 4
MANY_POINTS, LARGEST_POWER = 150, 3
# A value is called zero if all balls are this much smaller than the largest term: 2^-3000 is about 1e-903.
_NEGLIGIBLE_BITS = 3000


def _sum(*terms: Any) -> Any:
    return sum(terms, flint.arb(0))


def _product(*factors: Any) -> Any:
    return prod(factors, start=flint.arb(1))


_FUNCTIONS: Mapping[Any, Callable[..., Any]] = MappingProxyType(
    {
        **{
            getattr(sympy, name): (lambda x, name=name: getattr(x, name)())
            for name in FUNCTIONS.keys() - KINKED - {"sqrt", "atan2"}
        },
        sympy.Abs: abs,
        sympy.sign: lambda x: x.sgn(),
        sympy.Max: lambda *parts: reduce(flint.arb.max, parts),
        sympy.Min: lambda *parts: reduce(flint.arb.min, parts),
        sympy.Heaviside: lambda x, _at_zero: (1 + x.sgn()) / 2,
        sympy.atan2: flint.arb.atan2,
        sympy.Add: _sum,
        sympy.Mul: _product,
    }
)

_PIECEWISE = (sympy.Abs, sympy.sign, sympy.Max, sympy.Min, sympy.Heaviside)

Sign = Literal["nonzero", "negligible", "unknown"]


def sample_zero(expr: Any) -> tuple[bool | None, int]:
    """Whether an expression vanishes, and at how many points that was seen.

    False is certain: a ball excludes zero. True means that at all points, at least four, the value is below 1e-900 of
    its largest term; for an analytic function that is not zero this happens with probability zero, unless it is flat to
    900 digits. One that is put together of pieces may vanish on some of them: it is looked at in many more places, of
    all sizes. None: too few points lie in its domain.
    """
    symbols = sorted(expr.free_symbols, key=lambda s: s.name)
    seen = 0
    for point in _points(symbols):
        sign = _sign(expr, point)
        if sign == "nonzero":
            return False, seen + 1
        seen += sign == "negligible"
    if seen >= ENOUGH_POINTS and expr.has(*_PIECEWISE):
        found = next((k for k, point in enumerate(_far_points(symbols)) if _is_nonzero(expr, point)), None)
        if found is not None:
            return False, seen + found + 1
    return (True if seen >= ENOUGH_POINTS else None), seen


def _points(symbols: list[Any]) -> Iterator[dict[Any, Any]]:
    """Fixed pseudo-random points; symbols that are not known to be positive take both signs."""
    generator = random.Random(20_061)
    for _ in range(POINTS):
        yield {
            s: sympy.Rational(generator.randint(150, 2600), 1009) * (1 if s.is_positive else generator.choice((-1, 1)))
            for s in symbols
        }


def _far_points(symbols: list[Any]) -> Iterator[dict[Any, Any]]:
    """More of them, from a thousandth to a thousand, in which all pieces that are not small have their turn."""
    generator = random.Random(1_906)
    for _ in range(MANY_POINTS):
        yield {
            s: sympy.Rational(generator.randint(150, 2600), 1009)
            * sympy.Integer(10) ** generator.randint(-LARGEST_POWER, LARGEST_POWER)
            * (1 if s.is_positive else generator.choice((-1, 1)))
            for s in symbols
        }


def _is_nonzero(expr: Any, point: Mapping[Any, Any]) -> bool:
    """Whether that is certain with the fewest digits."""
    with flint.ctx.workprec(PRECISIONS[0]):
        try:
            total = _Ball(point).of(expr)
        except (ValueError, ZeroDivisionError, OverflowError):
            return False
        return bool(total.is_finite() and not total.contains(0))


def _sign(expr: Any, point: Mapping[Any, Any]) -> Sign:
    for bits in PRECISIONS:
        with flint.ctx.workprec(bits):
            ball = _Ball(point)
            try:
                terms = [ball.of(term) for term in sympy.Add.make_args(expr)]
            except (ValueError, ZeroDivisionError, OverflowError):
                return "unknown"
            total = sum(terms, flint.arb(0))
            if not total.is_finite():
                continue
            if not total.contains(0):
                return "nonzero"
            scale = max(abs(term).upper() for term in terms)
            if abs(total).upper() <= scale * flint.arb(2) ** -_NEGLIGIBLE_BITS:
                return "negligible"
    return "unknown"


class _Ball:
    """The values of expressions at a point; a part that comes again is not worked out again."""

    def __init__(self, point: Mapping[Any, Any]) -> None:
        self._known = {symbol: _rational(value) for symbol, value in point.items()}

    def of(self, expr: Any) -> Any:
        """The value. ValueError if it has none or its function is not known here."""
        known = self._known.get(expr)
        if known is None:
            known = self._known[expr] = self._value(expr)
        return known

    def _value(self, expr: Any) -> Any:
        if expr.is_Rational:
            return _rational(expr)
        if expr is sympy.pi:
            return flint.arb.pi()
        if expr is sympy.E:
            return flint.arb(1).exp()
        if expr.is_Pow:
            return self.of(expr.base) ** self.of(expr.exp)
        return _function(expr)(*map(self.of, expr.args))


def _rational(value: Any) -> Any:
    return flint.arb(flint.fmpq(int(value.p), int(value.q)))


def _function(expr: Any) -> Callable[..., Any]:
    function = _FUNCTIONS.get(expr.func)
    if function is None:
        raise ValueError(type(expr).__name__)
    return function
