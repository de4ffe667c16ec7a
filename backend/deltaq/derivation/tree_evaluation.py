"""The value of an expression tree in ball arithmetic, straight from what the user wrote, past SymPy."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from fractions import Fraction
from functools import reduce
from typing import TypeAlias

from flint import arb

from ..language.spelling import spell_rate
from ..language.tree import Node, NumbersOnly, fold
from .points import Point, along_motion, central_difference

At: TypeAlias = Callable[[Point], arb]

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
    "max": lambda *parts: reduce(arb.max, parts),
    "min": lambda *parts: reduce(arb.min, parts),
    "step": lambda x, *_at_zero: (1 + x.sgn()) / 2,
}


def rational(value: Fraction) -> arb:
    """The ball that holds an exact fraction."""
    return arb(value.numerator) / arb(value.denominator)


def power(base: arb, exponent: arb) -> arb:
    """bᵉ, also of negative bases where the exponent is whole."""
    whole = exponent.unique_fmpz()
    if whole is None:
        return base**exponent
    if whole > 0 and base.mid().is_zero():  # Arb takes its logarithm, which is not finite: (±r)ⁿ is in ±rⁿ
        return arb(0, base.rad() ** whole)
    return base**whole


def tree_value(tree: Node, point: Point) -> arb:
    """The tree's value; derivatives with respect to time are differences along the motion."""
    return fold(tree, FunctionAlgebra())(point)


class FunctionAlgebra(NumbersOnly):
    """Each node becomes a function of the point, so that derivatives can look beside it."""

    def number(self, value: Fraction) -> At:
        return lambda _: rational(value)

    def name(self, name: str) -> At:
        return (lambda _: arb.pi()) if name == "pi" else (lambda point: point[name])

    def rate(self, name: str, order: int) -> At:
        return lambda point: point[spell_rate(name, order)]

    def variation(self, name: str, order: int) -> At:
        return lambda point: point[spell_rate(f"delta({name})", order)]

    def differential(self, name: str) -> At:
        return lambda point: point[f"d({name})"]

    def sum(self, terms: tuple[At, ...]) -> At:
        return lambda point: sum((term(point) for term in terms), arb(0))

    def product(self, factors: tuple[At, ...]) -> At:
        return lambda point: math.prod((factor(point) for factor in factors), start=arb(1))

    def quotient(self, numerator: At, denominator: At) -> At:
        return lambda point: numerator(point) / denominator(point)

    def negation(self, operand: At) -> At:
        return lambda point: -operand(point)

    def power(self, base: At, exponent: At) -> At:
        return lambda point: power(base(point), exponent(point))

    def call(self, function: str, arguments: tuple[At, ...]) -> At:
        return lambda point: FUNCTIONS[function](*(argument(point) for argument in arguments))

    def time_derivative(self, operand: At) -> At:
        return lambda point: central_difference(lambda h: operand(along_motion(point, h)))
