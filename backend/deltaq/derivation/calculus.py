"""The few operations that every law uses, on expressions in the symbols of a scene."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cached_property
from typing import TypeVar

import sympy as sp

from ..language import canonical
from ..language.derivatives import beside_jumps, diff
from ..language.display import size
from ..language.form_calculus import PlainForm, plain_form
from ..language.fourier import TooLargeError
from ..language.memory import cached_method
from ..language.sympy_algebra import rates_of, time_derivative, to_sympy
from ..language.textbook import given_sums
from ..language.tree import Node
from ..mechanics.contributions import DissipationFunction, GeneralizedPotential, PotentialEnergy
from .effort import Effort
from .formula import Given, Value
from .scene_symbols import SceneSymbols

LONG = 50  # parts of an expression from which on its length counts twice
V = TypeVar("V", sp.Expr, sp.ImmutableMatrix)


@dataclass(frozen=True, eq=False)
class Calculus(SceneSymbols):
    """Derivatives with respect to time follow by the chain rule, as do variations; guides are put in.

    What is brought into a form is counted by `effort`.
    """

    effort: Effort = field(init=False, default_factory=Effort)

    def expression(self, node: Node) -> sp.Expr:
        """The SymPy expression of a scalar tree."""
        return to_sympy(node, self.symbols)

    def vector(self, nodes: Iterable[Node]) -> sp.ImmutableMatrix:
        """The column of scalar trees."""
        return column(self.expression(node) for node in nodes)

    def given(self, trees: tuple[Node, ...]) -> Given:
        """A vector as the scene states it."""
        return Given(trees, self.vector(trees))

    @cached_property
    def given_sums(self) -> frozenset[sp.Expr]:
        """The sums in positions, energies and dissipation functions as the scene states them: x₂ − x₁, not x₁ − x₂."""
        stated = [
            load.function if isinstance(load, DissipationFunction) else load.energy
            for load in self.scene.contributions
            if isinstance(load, PotentialEnergy | GeneralizedPotential | DissipationFunction)
        ]
        stated += [component.tree for body in self.scene.bodies for component in body.position]
        return given_sums([self.guided(self.expression(tree)) for tree in stated])

    @cached_property
    def guides(self) -> Mapping[sp.Symbol, sp.Expr]:
        """Guided coordinates with their rates and accelerations, each as a function of time."""
        found: dict[sp.Symbol, sp.Expr] = {}
        for guide in self.scene.guides:
            value = self.expression(guide.value.tree)
            speed = time_derivative(value, self.symbols)
            acceleration = time_derivative(speed, self.symbols)
            name = guide.coordinate
            found |= {self.q(name): value, self.rate(name): speed, self.acceleration(name): acceleration}
        return found

    def guided(self, value: V) -> V:
        """The value with every guide put in."""
        return value.xreplace(dict(self.guides)) if self.guides else value

    def time_derivative(self, value: sp.Expr) -> sp.Expr:
        """d(value)/dt along the motion."""
        return time_derivative(value, self.symbols)

    def slope(self, value: sp.Expr, by: sp.Symbol) -> sp.Expr:
        """∂value/∂by"""
        if by not in self.symbols_in(value):
            return self.zero
        self._count(value)
        form = self._form(value)
        return diff(value, by) if form is None else form.derivative(by).expression

    @cached_method
    def symbols_in(self, value: sp.Expr) -> frozenset[sp.Symbol]:
        """The symbols that the value hangs on: by any other its slope is zero. Large scenes have many."""
        return frozenset(value.free_symbols)

    @cached_method
    def _form(self, value: sp.Expr) -> PlainForm | None:
        return plain_form(value)

    def raw_slope(self, value: sp.Expr, by: sp.Symbol) -> sp.Expr:
        """∂value/∂by as the rules of calculus leave it."""
        return diff(value, by) if by in self.symbols_in(value) else self.zero

    def display(self, value: V) -> V:
        """The shortest of a few equivalent forms."""
        return by_component(value, self._shown)

    @cached_method
    def _shown(self, value: sp.Expr) -> sp.Expr:
        self._count(value)
        shown: sp.Expr = canonical.display(value, self.symbols, self.given_sums)
        return shown

    def derivative(self, value: V, by: sp.Symbol) -> V:
        """∂value/∂by, in its display form; of what jumps, beside that."""
        return by_component(value, lambda component: self._shown_slope(component, by))

    @cached_method
    def _shown_slope(self, value: sp.Expr, by: sp.Symbol) -> sp.Expr:
        if by not in self.symbols_in(value):
            return self.zero
        form = self._form(value)
        with suppress(TooLargeError):
            if form is not None:
                return form.derivative(by).displayed(self.symbols, self.given_sums)
        return self.display(beside_jumps(diff(value, by)))

    def shown_rate(self, value: sp.Expr) -> sp.Expr:
        """d(value)/dt along the motion, in its display form."""
        form = self._form(value)
        with suppress(TooLargeError):
            if form is not None:
                return form.total_derivative(rates_of(self.symbols)).displayed(self.symbols, self.given_sums)
        return self.display(self.time_derivative(value))

    @cached_method
    def euler_expression(self, energy: sp.Expr, coordinate: str) -> sp.Expr:
        """d/dt ∂E/∂q̇ − ∂E/∂q"""
        q, rate = self.q(coordinate), self.rate(coordinate)
        if self.symbols_in(energy).isdisjoint((q, rate)):
            return self.zero
        form = self._form(energy)
        with suppress(TooLargeError):
            if form is not None:
                change = form.derivative(rate).total_derivative(rates_of(self.symbols))
                return change.minus(form.derivative(q)).expression
        return self.time_derivative(diff(energy, rate)) - diff(energy, q)

    def vary(self, value: sp.Expr) -> sp.Expr:
        """δvalue by the chain rule, the time held fixed."""
        slopes = ((self.slope(value, q), dq) for q, dq in self.variations.items() if q in self.symbols_in(value))
        return sum((slope * dq for slope, dq in slopes), self.zero)

    def collected(self, work: sp.Expr) -> sp.Expr:
        """A virtual work as Σ Qᵢ δqᵢ, each coefficient in its display form."""
        varied = frozenset(self.variations.values())
        terms: dict[sp.Symbol, list[sp.Expr]] = {}
        for term in sp.Add.make_args(work.expand()):
            for dq in varied & term.free_symbols:
                terms.setdefault(dq, []).append(term)
        ordered = (dq for dq in self.variations.values() if dq in terms)
        return sp.Add(*(self.display(sp.Add(*terms[dq]).coeff(dq)) * dq for dq in ordered))

    def is_zero(self, value: sp.Expr) -> bool:
        """Whether the value vanishes identically; what cannot be decided is taken as not zero."""
        if value == 0:
            return True
        self._count(value)
        return canonical.is_zero(value, self.symbols) is True

    def _count(self, value: sp.Expr) -> None:
        """Longer expressions take more for each of their parts."""
        length = size(value)
        self.effort.spend(length + length * length // LONG)

    def dot(self, left: sp.ImmutableMatrix, right: sp.ImmutableMatrix) -> sp.Expr:
        """a · b"""
        return sum((a * b for a, b in zip(left, right, strict=True)), self.zero)


def column(components: Iterable[sp.Expr]) -> sp.ImmutableMatrix:
    """The column vector of these components."""
    return sp.ImmutableMatrix([[component] for component in components])


def by_component(value: Value, function: Callable[[sp.Expr], sp.Expr]) -> Value:
    """The function of every component of a vector or matrix, or of the expression itself."""
    return value.applyfunc(function) if isinstance(value, sp.MatrixBase) else function(value)
