"""The SymPy symbols of a scene. Their names are exactly the plain language: `phi`, `dot(phi)`, `delta(phi)`, `d(t)`."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import sympy

from .memory import cached_method
from .names import Names
from .order import Order
from .spelling import spell_rate


@dataclass(frozen=True)
class Symbols:
    """One real SymPy symbol for each quantity; parameters known to be positive are positive symbols."""

    names: Names

    @cached_method
    def name(self, name: str) -> sympy.Expr:
        """The symbol of a parameter, coordinate, material coordinate or `t`; the number π for `pi`."""
        if name == "pi":
            return sympy.pi
        symbol = self.names.get(name)
        if symbol is not None and symbol.positive:
            return sympy.Symbol(name, positive=True)
        return sympy.Symbol(name, real=True)

    @cached_method
    def rate(self, name: str, order: int = 1) -> sympy.Symbol:
        """q̇ (order 1), q̈ (order 2)."""
        return sympy.Symbol(spell_rate(name, order), real=True)

    @cached_method
    def variation(self, name: str, order: int = 0) -> sympy.Symbol:
        """δq, δq̇ (order 1), δq̈ (order 2)."""
        return sympy.Symbol(spell_rate(f"delta({name})", order), real=True)

    def differential(self, name: str) -> sympy.Symbol:
        """dq, or dt"""
        return sympy.Symbol(f"d({name})", real=True)

    @cached_property
    def order(self) -> Order:
        """The order in which they are written: one for all who write them, as the keys of terms are made only once."""
        return Order(self.names)

    @property
    def time(self) -> sympy.Symbol:
        """t"""
        return sympy.Symbol("t", real=True)
