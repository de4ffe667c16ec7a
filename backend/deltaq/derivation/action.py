"""The action S = ∫ L dt of a scene, as a functional of its free coordinates.

Both ends are fixed: every motion that is compared starts and ends at the same places, δq(t₀) = δq(t₁) = 0.
Source: Hamilton, On a General Method in Dynamics (1834); Lanczos, The Variational Principles of Mechanics, ch. V.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import sympy as sp

from ..language.sympy_algebra import time_derivative
from ..language.tree import Name
from .domain import Interval
from .formula import Named, Quantity, Value
from .functional import Functional
from .system import System


@dataclass(frozen=True, eq=False)
class Action(Functional):
    """The integral of Lagrange's function, with the guides put in."""

    system: System = field(kw_only=True)

    @property
    def functions(self) -> tuple[str, ...]:
        """The coordinates that are varied: those no guide prescribes."""
        return self.system.free

    @cached_property
    def value(self) -> sp.Expr:
        """The integrand L(q, q̇, t)."""
        return self.system.lagrangian

    @property
    def named(self) -> Named:
        """L under its symbol."""
        return Named(Quantity("lagrangian"), self.value)

    def euler_lagrange(self, function: str) -> sp.Expr:
        """∂L/∂qᵢ − dpᵢ/dt"""
        return self.display(self.slope(function, 0) - time_derivative(self.momentum(function), self.symbols))

    def display(self, value: Value) -> Value:
        """The value as the scene's other steps show it."""
        return self.system.display(value)

    def slope(self, function: str, order: int) -> sp.Expr:
        """∂L/∂qᵢ, or pᵢ = ∂L/∂q̇ᵢ"""
        return self.system.momentum(function) if order == 1 else super().slope(function, order)


def action(system: System) -> Action:
    """S between two instants that no symbol of the scene names."""
    start, end = (Name(instant.name) for instant in system.ends)
    return Action(system.scene.names, (), Interval(start, end, "fixed"), system=system)
