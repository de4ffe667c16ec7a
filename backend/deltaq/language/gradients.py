"""Slopes of expressions in plain numbers, exact but for rounding, however large or small the numbers are.

Each part is carried with its slopes (forward accumulation), so that no difference of close values is taken: beside 10¹²
a step of 10⁻⁵ is lost. With each slope goes the sum of the sizes of its terms: what is left where they cancel, as in
the slope of sin² x + cos² x, is zero.
Source: Griewank, Walther, Evaluating Derivatives, 2nd ed., §3.1.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import NoReturn

from .floats import FloatAlgebra
from .spelling import spell_rate
from .tree import Node, NumbersOnly, fold

CANCELLED = 1e-13  # of the sizes of the terms of a slope: what rounding leaves of nothing
Slopes = Mapping[str, tuple[float, float]]

# The slope of each function of one argument at x, where its value is y.
_SLOPES: Mapping[str, Callable[[float, float], float]] = MappingProxyType(
    {
        "sin": lambda x, _y: math.cos(x),
        "cos": lambda x, _y: -math.sin(x),
        "tan": lambda _x, y: 1.0 + y * y,
        "cot": lambda _x, y: -1.0 - y * y,
        "sec": lambda x, y: y * math.tan(x),
        "csc": lambda x, y: -y / math.tan(x),
        "asin": lambda x, _y: 1.0 / math.sqrt(1.0 - x * x),
        "acos": lambda x, _y: -1.0 / math.sqrt(1.0 - x * x),
        "atan": lambda x, _y: 1.0 / (1.0 + x * x),
        "sinh": lambda x, _y: math.cosh(x),
        "cosh": lambda x, _y: math.sinh(x),
        "tanh": lambda x, _y: 1.0 / math.cosh(x) ** 2,
        "asinh": lambda x, _y: 1.0 / math.sqrt(1.0 + x * x),
        "acosh": lambda x, _y: 1.0 / math.sqrt(x * x - 1.0),
        "atanh": lambda x, _y: 1.0 / (1.0 - x * x),
        "exp": lambda _x, y: y,
        "log": lambda x, _y: 1.0 / x,
        "sqrt": lambda _x, y: 0.5 / y,
        "abs": lambda x, _y: math.copysign(1.0, x) if x else 0.0,
        "sign": lambda _x, _y: 0.0,
        "step": lambda _x, _y: 0.0,
    }
)


def gradient(node: Node, values: Mapping[str, float], names: Sequence[str]) -> tuple[float, ...]:
    """∂f/∂x for each of some names and rates (`dot(phi)`), at a point that gives all a value; NaN where f has none."""
    try:
        slopes = fold(node, _SlopeAlgebra(values, frozenset(names))).slopes
    except (ArithmeticError, ValueError):
        return (math.nan,) * len(names)
    found = (slopes.get(name, (0.0, 0.0)) for name in names)
    return tuple(slope if not abs(slope) <= CANCELLED * size else 0.0 for slope, size in found)


@dataclass(frozen=True)
class _Sloped:
    """A value and, of each name that it depends on, its slope and the sum of the sizes of the slope's terms."""

    value: float
    slopes: Slopes


@dataclass(frozen=True)
class _SlopeAlgebra(NumbersOnly):
    """Raises ArithmeticError or ValueError where the expression, or a slope that it needs, is not defined."""

    values: Mapping[str, float]
    names: frozenset[str]

    @property
    def _plain(self) -> FloatAlgebra:
        return FloatAlgebra(self.values)

    def number(self, value: object) -> _Sloped:
        return _Sloped(float(value), {})  # type: ignore[arg-type] # a fraction

    def name(self, name: str) -> _Sloped:
        return self._named(name, self._plain.name(name))

    def rate(self, name: str, order: int) -> _Sloped:
        return self._named(spell_rate(name, order), self._plain.rate(name, order))

    def variation(self, name: str, order: int) -> _Sloped:
        return _Sloped(self._plain.variation(name, order), {})

    def differential(self, name: str) -> _Sloped:
        return _Sloped(self._plain.differential(name), {})

    def sum(self, terms: tuple[_Sloped, ...]) -> _Sloped:
        return _Sloped(math.fsum(term.value for term in terms), _joined((1.0, term.slopes) for term in terms))

    def product(self, factors: tuple[_Sloped, ...]) -> _Sloped:
        numbers = [factor.value for factor in factors]
        others = (math.prod((*numbers[:i], *numbers[i + 1 :]), start=1.0) for i in range(len(factors)))
        parts = zip(others, (factor.slopes for factor in factors), strict=True)
        return _Sloped(math.prod(numbers, start=1.0), _joined(parts))

    def quotient(self, numerator: _Sloped, denominator: _Sloped) -> _Sloped:
        value, below = numerator.value / denominator.value, denominator.value
        return _Sloped(value, _joined([(1.0 / below, numerator.slopes), (-value / below, denominator.slopes)]))

    def negation(self, operand: _Sloped) -> _Sloped:
        return _Sloped(-operand.value, _joined([(-1.0, operand.slopes)]))

    def power(self, base: _Sloped, exponent: _Sloped) -> _Sloped:
        value = math.pow(base.value, exponent.value)
        by_base = exponent.value * math.pow(base.value, exponent.value - 1.0) if base.slopes and exponent.value else 0.0
        by_exponent = value * math.log(base.value) if exponent.slopes and value else 0.0
        return _Sloped(value, _joined([(by_base, base.slopes), (by_exponent, exponent.slopes)]))

    def call(self, function: str, arguments: tuple[_Sloped, ...]) -> _Sloped:
        numbers = tuple(argument.value for argument in arguments)
        value = self._plain.call(function, numbers)
        by_each = _by_each(function, numbers, value) if any(each.slopes for each in arguments) else ()
        parts = zip(by_each, (each.slopes for each in arguments), strict=False)
        return _Sloped(value, _joined(parts))

    def time_derivative(self, _operand: _Sloped) -> NoReturn:
        raise ValueError("a number has no derivative")

    def _named(self, name: str, value: float) -> _Sloped:
        return _Sloped(value, {name: (1.0, 1.0)} if name in self.names else {})


def _by_each(function: str, numbers: tuple[float, ...], value: float) -> tuple[float, ...]:
    """The slope of a function's value by each of its arguments."""
    if function in _SLOPES:
        return (_SLOPES[function](numbers[0], value),)
    if function == "atan2":
        y, x = numbers
        square = x * x + y * y
        return x / square, -y / square
    chosen = numbers.index(value)  # of max and min
    return tuple(float(i == chosen) for i in range(len(numbers)))


def _joined(parts: Iterable[tuple[float, Slopes]]) -> Slopes:
    """Σ factor · slopes"""
    found: dict[str, tuple[float, float]] = {}
    for factor, slopes in parts:
        for name, (slope, size) in slopes.items():
            before, sizes = found.get(name, (0.0, 0.0))
            found[name] = before + factor * slope, sizes + abs(factor) * size
    return found
