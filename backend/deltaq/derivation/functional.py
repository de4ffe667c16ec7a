"""Functionals of functions of time: an expression f(x, ẋ, ẍ, t), its value at an instant, or its integral over time."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import sympy as sp

from ..language.memory import cached_method
from ..language.sympy_algebra import time_derivative
from .clearing import Cleared, cleared
from .differential_expression import DifferentialExpression
from .domain import Instant, Interval
from .formula import AtTime, Bounds, Explicit, Formula, Given, Integral, Named, Quantity


@dataclass(frozen=True, eq=False)
class Functional(DifferentialExpression):
    """What is varied: an expression f, and what is done with it."""

    domain: Instant | Interval | None = None

    @property
    def arguments(self) -> tuple[sp.Symbol, ...]:
        """What f is said to depend on."""
        time = () if self.is_autonomous else (self.symbols.time,)
        return (*(self.along or ()), *time)

    @property
    def is_autonomous(self) -> bool:
        """Whether f does not hold the time."""
        return not self.value.has(self.symbols.time)

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
    def held(self) -> tuple[int, int]:
        """How many of δx, δẋ are zero at the lower and at the upper end."""
        return self.domain.held if isinstance(self.domain, Interval) else (0, 0)

    def held_ends(self, order: int) -> tuple[sp.Expr, ...]:
        """The instants at which δx (order 0) or δẋ (order 1) is zero."""
        return tuple(end for end, held in zip(self._ends, self.held, strict=True) if held > order)

    def free_ends(self, order: int) -> tuple[sp.Expr, ...]:
        """The instants at which it is arbitrary."""
        return tuple(end for end, held in zip(self._ends, self.held, strict=True) if held <= order)

    @property
    def _ends(self) -> tuple[sp.Expr, sp.Expr]:
        return self.interval.lower, self.interval.upper

    def orders(self, function: str) -> tuple[int, ...]:
        """Which of x (0), ẋ (1), ẍ (2) occur."""
        return tuple(order for order in range(3) if self.symbols.rate(function, order) in self.along)

    @property
    def highest(self) -> int:
        """The order of the highest rate that occurs."""
        return max((order for x in self.functions for order in self.orders(x)), default=0)

    @property
    def boundary(self) -> Iterator[tuple[str, int]]:
        """The functions and orders n whose δx⁽ⁿ⁾ stands in a boundary term."""
        return ((x, order) for x in self.moving for order in range(max(self.orders(x))))

    def slope(self, function: str, order: int) -> sp.Expr:
        """∂F/∂x⁽ⁿ⁾, zero if it does not occur."""
        return self.slopes.get(self.symbols.rate(function, order), sp.Integer(0))

    def rate(self, value: sp.Expr) -> sp.Expr:
        """d/dt of the value along the functions, in its display form."""
        return self.display(time_derivative(value, self.symbols))

    @cached_method
    def momentum(self, function: str, order: int = 0) -> sp.Expr:
        """The factor of δx⁽ⁿ⁾ in the boundary terms: ∂F/∂ẋ − d/dt ∂F/∂ẍ of δx, ∂F/∂ẍ of δẋ."""
        slope = self.slope(function, order + 1)
        if order + 1 >= max(self.orders(function), default=0):
            return slope
        return self.display(slope - time_derivative(self.momentum(function, order + 1), self.symbols))

    def momentum_rate(self, function: str) -> sp.Expr:
        """d/dt ∂F/∂ẋ"""
        return self.rate(self.slope(function, 1))

    @cached_method
    def euler_lagrange(self, function: str) -> sp.Expr:
        """∂F/∂x − d/dt ∂F/∂ẋ + d²/dt² ∂F/∂ẍ"""
        return self.display(self._equation(function))

    @cached_method
    def cleared_equation(self, function: str) -> Cleared:
        """The left side of the Euler–Lagrange equation without denominators and common factors."""
        return cleared(self._equation(function), self.symbols, function)

    def _equation(self, function: str) -> sp.Expr:
        """The left side as it is differentiated, so that equal roots still look alike."""
        first, second, third = (self.value.diff(self.symbols.rate(function, order)) for order in range(3))
        return first + time_derivative(time_derivative(third, self.symbols) - second, self.symbols)

    @cached_property
    def energy(self) -> sp.Expr:
        """Beltrami's H = Σ (∂F/∂ẋ − d/dt ∂F/∂ẍ) ẋ + ∂F/∂ẍ ẍ − F"""
        products = (self.momentum(x, n) * self.symbols.rate(x, n + 1) for x, n in self.boundary)
        return self.display(sum(products, -self.value))

    @property
    def has_energy(self) -> bool:
        """Whether H is constant along solutions, and not so for any functions (F of degree one in the rates)."""
        return self.is_autonomous and bool(self.moving) and bool(self.energy.free_symbols & self.changing)

    @property
    def ignorable(self) -> tuple[str, ...]:
        """The functions that occur by their rates alone, with a momentum that is no constant."""
        return tuple(
            x for x in self.moving if 0 not in self.orders(x) and self.momentum(x).free_symbols & self.changing
        )

    @property
    def changing(self) -> set[sp.Symbol]:
        """Functions, their rates and the time."""
        rates = {self.symbols.rate(x, order) for x in self.functions for order in range(4)}
        return {self.symbols.time, *rates}
