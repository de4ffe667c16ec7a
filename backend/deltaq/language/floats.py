"""Plain numbers for expressions: quick, in double precision, without any computer algebra."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import NoReturn

from .functions import FUNCTIONS
from .spelling import spell_rate
from .tree import Node, NumbersOnly, fold


def evaluate(node: Node, values: Mapping[str, float]) -> float:
    """The expression at a point that gives every name and rate (`dot(phi)`) a value; NaN where it is not defined."""
    try:
        return fold(node, FloatAlgebra(values))
    except (ArithmeticError, ValueError):
        return math.nan


def evaluate_beyond(node: Node, values: Mapping[str, float]) -> float:
    """The same with parts beyond all numbers infinite, where `evaluate` stops: 1/cosh(x)² is 0 for large x."""
    try:
        return fold(node, _ExtendedAlgebra(values))
    except (ArithmeticError, ValueError):
        return math.nan


@dataclass(frozen=True)
class FloatAlgebra(NumbersOnly):
    """Evaluation from the leaves up; raises ArithmeticError or ValueError where the expression is not defined."""

    values: Mapping[str, float]

    def number(self, value: Fraction) -> float:
        return float(value)

    def name(self, name: str) -> float:
        return math.pi if name == "pi" else self.values[name]

    def rate(self, name: str, order: int) -> float:
        return self.values[spell_rate(name, order)]

    def variation(self, name: str, order: int) -> float:
        return self.values[spell_rate(f"delta({name})", order)]

    def differential(self, name: str) -> float:
        return self.values[f"d({name})"]

    def sum(self, terms: tuple[float, ...]) -> float:
        return math.fsum(terms)

    def product(self, factors: tuple[float, ...]) -> float:
        return math.prod(factors, start=1.0)

    def quotient(self, numerator: float, denominator: float) -> float:
        return numerator / denominator

    def negation(self, operand: float) -> float:
        return -operand

    def power(self, base: float, exponent: float) -> float:
        return math.pow(base, exponent)

    def call(self, function: str, arguments: tuple[float, ...]) -> float:
        return float(FUNCTIONS[function].evaluate(*arguments))

    def time_derivative(self, _operand: float) -> NoReturn:
        raise ValueError("a number has no derivative")


@dataclass(frozen=True)
class _ExtendedAlgebra(FloatAlgebra):
    """Powers and functions that overflow are infinite."""

    def power(self, base: float, exponent: float) -> float:
        try:
            return super().power(base, exponent)
        except OverflowError:
            return -math.inf if base < 0.0 and exponent % 2.0 else math.inf

    def call(self, function: str, arguments: tuple[float, ...]) -> float:
        try:
            return super().call(function, arguments)
        except OverflowError:  # of exp, cosh or sinh
            return math.copysign(math.inf, arguments[0]) if function == "sinh" else math.inf
