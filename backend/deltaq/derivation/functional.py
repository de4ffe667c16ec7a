"""Functionals of functions of time: an expression f(x, ẋ, t), its value at an instant, or its integral over time."""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from ..language.sympy_algebra import time_derivative
from .differential_expression import DifferentialExpression
from .domain import FIXED, Instant, Interval
from .formula import AtTime, Bounds, Explicit, Formula, Given, Integral, Named, Quantity


@dataclass(frozen=True, eq=False)
class Functional(DifferentialExpression):
    """What is varied: an expression f, and what is done with it."""

    domain: Instant | Interval | None = None

    @property
    def arguments(self) -> tuple[sp.Symbol, ...]:
        """What f is said to depend on."""
        time = (self.symbols.time,) if self.value.has(self.symbols.time) else ()
        return (*(self.along or ()), *time)

    @property
    def named(self) -> Named:
        """f under its name; the integrand is F."""
        kind = "integrand" if isinstance(self.domain, Interval) else "function"
        return Named(Quantity(kind), self.value, self.arguments)

    @property
    def given(self) -> Given:
        """f as it was written."""
        return Given(self.trees, self.value)

    @property
    def explicit(self) -> Explicit:
        """f written out."""
        return Explicit(self.value)

    def on(self, formula: Formula) -> Formula:
        """The functional of what stands inside: its value at the instant, its integral, or itself."""
        match self.domain:
            case Instant(at):
                return AtTime(formula, self.expression(at))
            case Interval():
                return Integral(formula, (self.interval,))
            case _:
                return formula

    @property
    def interval(self) -> Bounds:
        """The interval of the integral. TypeError if it is none."""
        if not isinstance(self.domain, Interval):
            raise TypeError("only an integral has an interval")
        return Bounds(self.symbols.time, self.expression(self.domain.lower), self.expression(self.domain.upper))

    @property
    def fixed(self) -> tuple[bool, bool]:
        """Whether the lower and the upper end are fixed."""
        return FIXED[self.domain.ends] if isinstance(self.domain, Interval) else (False, False)

    @property
    def fixed_ends(self) -> tuple[sp.Expr, ...]:
        """The instants at which the functions are prescribed."""
        return tuple(end for end, fixed in zip(self._ends, self.fixed, strict=True) if fixed)

    @property
    def free_ends(self) -> tuple[sp.Expr, ...]:
        """The instants at which they are not."""
        return tuple(end for end, fixed in zip(self._ends, self.fixed, strict=True) if not fixed)

    @property
    def _ends(self) -> tuple[sp.Expr, sp.Expr]:
        return self.interval.lower, self.interval.upper

    def momentum(self, function: str) -> sp.Expr:
        """∂F/∂ẋ, zero if the rate does not occur."""
        return self.slopes.get(self.symbols.rate(function, 1), sp.Integer(0))

    def momentum_rate(self, function: str) -> sp.Expr:
        """d/dt ∂F/∂ẋ"""
        return self.display(time_derivative(self.momentum(function), self.symbols))

    def euler_lagrange(self, function: str) -> sp.Expr:
        """∂F/∂x − d/dt ∂F/∂ẋ"""
        slope = self.slopes.get(self.symbols.rate(function, 0), sp.Integer(0))
        return self.display(slope - time_derivative(self.momentum(function), self.symbols))
