"""Trees to SymEngine, node by node; no text is parsed on the way."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from operator import add, mul
from typing import NoReturn

import symengine as se

from ..language.tree import Node, fold
from .functions import FUNCTIONS, Expr
from .slopes import gradient, joined, slope
from .symbols import CLOCK, Symbols


@dataclass(frozen=True)
class SymEngineAlgebra:
    """The algebra of numeric models: expressions in q, q̇, t and the parameters."""

    symbols: Symbols

    def number(self, value: Fraction) -> Expr:
        return se.Integer(value.numerator) / se.Integer(value.denominator)

    def name(self, name: str) -> Expr:
        return self.symbols.values[name]

    def rate(self, name: str, order: int) -> Expr:
        return (self.symbols.rates, self.symbols.accelerations)[order - 1][name]

    def sum(self, terms: tuple[Expr, ...]) -> Expr:
        return reduce(add, terms, se.Integer(0))

    def product(self, factors: tuple[Expr, ...]) -> Expr:
        return reduce(mul, factors, se.Integer(1))

    def quotient(self, numerator: Expr, denominator: Expr) -> Expr:
        return numerator / denominator

    def negation(self, operand: Expr) -> Expr:
        return -operand

    def power(self, base: Expr, exponent: Expr) -> Expr:
        return base**exponent

    def call(self, function: str, arguments: tuple[Expr, ...]) -> Expr:
        return FUNCTIONS[function](*arguments)

    def time_derivative(self, operand: Expr) -> Expr:
        symbols = self.symbols
        names = symbols.moving[:-1]
        orders = (symbols.values, symbols.rates, symbols.accelerations)
        states = [each[name] for each in orders[:2] for name in names]
        changes = [each[name] for each in orders[1:] for name in names]
        *slopes, by_time = gradient(operand, [*states, symbols.values[CLOCK]])
        return reduce(add, map(mul, slopes, changes), by_time)

    def partial_derivative(self, operand: Expr, variable: Expr) -> Expr:
        return slope(operand, variable)

    def variation(self, name: str, _order: int) -> NoReturn:
        raise ValueError(f"a model has no virtual displacement of {name}")

    def differential(self, name: str) -> NoReturn:
        raise ValueError(f"a model has no differential of {name}")

    def vector(self, components: tuple[Expr, ...]) -> NoReturn:
        raise ValueError(f"a model is built from components, not from vectors of {len(components)}")

    def equation(self, left: Expr, right: Expr) -> NoReturn:
        raise ValueError(f"a model is built from expressions, not from equations ({left} = {right})")


def to_symengine(node: Node, symbols: Symbols) -> Expr:
    """The SymEngine expression of a scalar tree."""
    return joined(fold(node, SymEngineAlgebra(symbols)))
