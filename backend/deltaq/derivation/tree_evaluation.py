"""The value of an expression tree in ball arithmetic, straight from what the user wrote, past SymPy."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import NoReturn

from flint import arb

from ..language.spelling import spell_rate

FUNCTIONS: Mapping[str, Callable[..., arb]] = {
    "sin": arb.sin,
    "cos": arb.cos,
    "tan": arb.tan,
    "cot": arb.cot,
    "sec": arb.sec,
    "csc": arb.csc,
    "asin": arb.asin,
    "acos": arb.acos,
    "atan": arb.atan,
    "atan2": arb.atan2,
    "sinh": arb.sinh,
    "cosh": arb.cosh,
    "tanh": arb.tanh,
    "asinh": arb.asinh,
    "acosh": arb.acosh,
    "atanh": arb.atanh,
    "exp": arb.exp,
    "log": arb.log,
    "sqrt": arb.sqrt,
    "abs": abs,
    "sign": arb.sgn,
}


def rational(value: Fraction) -> arb:
    return arb(value.numerator) / arb(value.denominator)


def power(base: arb, exponent: arb) -> arb:
    """bᵉ, also of negative bases where the exponent is whole."""
    whole = exponent.unique_fmpz()
    return base**exponent if whole is None else base**whole


@dataclass(frozen=True)
class ArbAlgebra:
    """Numbers at a point, whose keys are names, `dot(name)` and `delta(name)`."""

    point: Mapping[str, arb]

    def number(self, value: Fraction) -> arb:
        return rational(value)

    def name(self, name: str) -> arb:
        return arb.pi() if name == "pi" else self.point[name]

    def rate(self, name: str, order: int) -> arb:
        return self.point[spell_rate(name, order)]

    def variation(self, name: str) -> arb:
        return self.point[f"delta({name})"]

    def differential(self, name: str) -> arb:
        return self.point[f"d({name})"]

    def sum(self, terms: tuple[arb, ...]) -> arb:
        return sum(terms, arb(0))

    def product(self, factors: tuple[arb, ...]) -> arb:
        return math.prod(factors, start=arb(1))

    def quotient(self, numerator: arb, denominator: arb) -> arb:
        return numerator / denominator

    def negation(self, operand: arb) -> arb:
        return -operand

    def power(self, base: arb, exponent: arb) -> arb:
        return power(base, exponent)

    def call(self, function: str, arguments: tuple[arb, ...]) -> arb:
        return FUNCTIONS[function](*arguments)

    def time_derivative(self, operand: arb) -> NoReturn:
        raise NotImplementedError("scene expressions hold no derivatives but rates")

    def partial_derivative(self, operand: arb, variable: arb) -> NoReturn:
        raise NotImplementedError("scene expressions hold no derivatives but rates")

    def vector(self, components: tuple[arb, ...]) -> NoReturn:
        raise NotImplementedError("a vector is evaluated component by component")

    def equation(self, left: arb, right: arb) -> NoReturn:
        raise NotImplementedError("an equation has no value")
