"""Differential expressions: f(x, ẋ, ẍ, t) in functions x of time, and their derivatives and variations."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property

import sympy as sp

from ..errors import ExpressionError, Problem
from ..language.form_calculus import PlainForm, plain_form
from ..language.fourier import TooLargeError
from ..language.memory import cached_method
from ..language.names import Names
from ..language.spelling import spell_rate
from ..language.symbols import Symbols
from ..language.sympy_algebra import to_sympy
from ..language.tree import Node
from .calculus import by_component, column
from .clearing import factored, upright_roots
from .formula import Value
from .points import HIGHEST
from .scene_symbols import SMALL, fresh

UNDEFINED = (sp.DiracDelta, sp.Derivative, sp.Subs)


@dataclass(frozen=True, eq=False)
class DifferentialExpression:
    """An expression of functions of time and their rates; several trees for a vector.

    Directions are `delta(x)` for the function x, with the rates `dot(delta(x))` and `ddot(delta(x))`.
    """

    names: Names
    trees: tuple[Node, ...]

    @cached_property
    def symbols(self) -> Symbols:
        return Symbols(self.names)

    @property
    def functions(self) -> tuple[str, ...]:
        """The functions that are varied."""
        return self.names.coordinates

    @cached_property
    def value(self) -> Value:
        """f, or the integrand."""
        values = [upright_roots(to_sympy(tree, self.symbols)) for tree in self.trees]
        return column(values) if len(values) > 1 else values[0]

    @cached_property
    def along(self) -> Mapping[sp.Symbol, sp.Symbol]:
        """The direction of each function, rate and acceleration that occurs: x ↦ δx, ẋ ↦ δẋ."""
        return {symbol: v for symbol, v in self.jets.items() if symbol in self.value.free_symbols}

    @cached_property
    def jets(self) -> Mapping[sp.Symbol, sp.Symbol]:
        """The direction of every function with all of its rates, whether they occur or not."""
        return {self.symbols.rate(x, n): direction(x, n) for x in self.functions for n in range(HIGHEST + 1)}

    def along_of(self, function: str) -> Mapping[sp.Symbol, sp.Symbol]:
        """The same for one function and its rates."""
        own = {self.symbols.rate(function, n) for n in range(3)}
        return {symbol: v for symbol, v in self.along.items() if symbol in own}

    @cached_property
    def h(self) -> sp.Symbol:
        """The number that the definition differentiates by."""
        return fresh(self.names, *SMALL)

    def expression(self, node: Node) -> sp.Expr:
        """A tree as SymPy's expression in the symbols of this problem; functions and rates are symbols x, ẋ, ẍ."""
        return to_sympy(node, self.symbols)

    def display(self, value: Value) -> Value:
        """The value in its shortest form; where it has roots or denominators, as one product if that is shorter."""
        return by_component(value, lambda component: factored(component, self.symbols))

    def derivative(self, value: Value, by: sp.Symbol) -> Value:
        """∂value/∂by. Raises ExpressionError where it does not exist."""
        return by_component(value, lambda component: self._slope(component, by))

    def _slope(self, value: sp.Expr, by: sp.Symbol) -> sp.Expr:
        form = self._form(value)
        with suppress(TooLargeError):
            if form is not None:
                shown: sp.Expr = form.derivative(by).displayed(self.symbols)
                return shown
        found = value.diff(by)
        if found.has(*UNDEFINED):
            raise ExpressionError(Problem("not-differentiable"))
        return self.display(found)

    @cached_method
    def _form(self, value: sp.Expr) -> PlainForm | None:
        return plain_form(value)

    @cached_property
    def slopes(self) -> Mapping[sp.Symbol, Value]:
        """∂f/∂x, ∂f/∂ẋ … of all that occurs."""
        return {symbol: self.derivative(self.value, symbol) for symbol in self.along}

    @cached_property
    def varied(self) -> Value:
        """f(x + h δx, ẋ + h δẋ, t)"""
        return self.value.xreplace({symbol: symbol + self.h * v for symbol, v in self.along.items()})

    @cached_property
    def by_definition(self) -> Value:
        """∂/∂h f(x + h δx) at h = 0, collected by the directions."""
        found = self.varied.diff(self.h).xreplace({self.h: sp.Integer(0)})
        if found.has(*UNDEFINED):
            raise ExpressionError(Problem("not-differentiable"))
        return by_component(found, self._collected)

    def _collected(self, component: sp.Expr) -> sp.Expr:
        return sp.Add(*(self.display(component.diff(v)) * v for v in self.along.values()))

    @cached_property
    def by_chain_rule(self) -> Value:
        """∂f/∂x δx + ∂f/∂ẋ δẋ + …"""
        return sum((slope * self.along[symbol] for symbol, slope in self.slopes.items()), self.value * 0)

    @property
    def moving(self) -> tuple[str, ...]:
        """The functions whose rates occur."""
        return tuple(x for x in self.functions if self.along_of(x).keys() - {self.symbols.name(x)})

    @property
    def present(self) -> tuple[str, ...]:
        """The functions that occur, themselves or by their rates."""
        return tuple(x for x in self.functions if self.along_of(x))


def direction(function: str, order: int = 0) -> sp.Symbol:
    """δx, δẋ, δẍ"""
    return sp.Symbol(spell_rate(f"delta({function})", order), real=True)
