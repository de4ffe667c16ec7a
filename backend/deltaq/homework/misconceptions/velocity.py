"""Mistakes in the velocity v = ∂r/∂q q̇ + ∂r/∂t, the chain rule among them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar, Self

import sympy as sp

from ...derivation.calculus import column
from ...mechanics.bodies import Body
from ...mechanics.contributions import Contribution
from ...vocabulary import SlipKind
from ..faulty_solution import FaultySolution
from ..solution import Solution


@dataclass(frozen=True, eq=False)
class GuideVelocityMissing(FaultySolution):
    """The velocity of the guided base is left out: v = ∂r/∂q q̇ without ∂r/∂t.

    The guide is not a coordinate, so it is forgotten that it moves the body all the same.
    """

    id: ClassVar[str] = "guide-velocity-missing"
    likely: ClassVar[int] = 1
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"missing"})

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        if true.depends_on_time:
            yield cls(true.scene, true)

    def velocity(self, place: str) -> sp.ImmutableMatrix:
        return super().velocity(place) - self.position(place).diff(self.t)


@dataclass(frozen=True, eq=False)
class BaseVelocityMissing(FaultySolution):
    """The velocity of the moving base is left out.

    The body is seen from the pivot: its velocity relative to the pivot is taken for its velocity.
    """

    id: ClassVar[str] = "base-velocity-missing"
    likely: ClassVar[int] = 2
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"missing"})

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        if len(true.free) > 1:
            yield from (cls(true.scene, true, q) for q in true.free)

    def velocity(self, place: str) -> sp.ImmutableMatrix:
        return super().velocity(place).xreplace({self.rate(self.about): self.zero})

    def kinetic_energy_of(self, body: Body) -> sp.Expr:
        relative = len(self.coordinates_of(body.name)) > 1 if not body.material else True
        return super().kinetic_energy_of(body) if relative else self.true.kinetic_energy_of(body)


@dataclass(frozen=True, eq=False)
class InnerFrequency(FaultySolution):
    """The factor ω is missing when a guide such as y₀ sin ωt is differentiated.

    ωt looks like a variable of its own, so d/dt sin ωt becomes cos ωt.
    """

    id: ClassVar[str] = "inner-frequency"
    likely: ClassVar[int] = 3
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"factor-missing", "power"})

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        if true.scene.guides:
            yield cls(true.scene, true)

    @cached_property
    def guides(self) -> Mapping[sp.Symbol, sp.Expr]:
        found = dict(self.true.guides)
        for guide in self.scene.guides:
            name = guide.coordinate
            value = found[self.q(name)]
            inner = [f.args[0] for f in value.atoms(sp.Function) if f.args[0].has(self.t)]
            factor = inner[0].diff(self.t) if inner else sp.Integer(1)
            found[self.rate(name)] = value.diff(self.t) / factor
            found[self.acceleration(name)] = value.diff(self.t, 2) / factor**2
        return found

    def time_derivative(self, value: sp.Expr) -> sp.Expr:
        by_time = {f: f.args[0].diff(self.t) for f in value.atoms(sp.Function) if f.args[0].has(self.t)}
        factor = next(iter(by_time.values()), sp.Integer(1))
        right = self.true.time_derivative(value)
        return right + value.diff(self.t) * (1 / factor - 1)

    def velocity(self, place: str) -> sp.ImmutableMatrix:
        return column(self.time_derivative(component) for component in self.position(place))


@dataclass(frozen=True, eq=False)
class ChainRuleFactor(FaultySolution):
    """The inner derivative is missing: d/dt sin φ = cos φ, δ(sin φ) = cos φ.

    The function is differentiated by its argument, and that the argument itself moves is forgotten.
    """

    id: ClassVar[str] = "chain-rule-factor"
    likely: ClassVar[int] = 2
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"factor-missing", "power"})

    def velocity(self, place: str) -> sp.ImmutableMatrix:
        return column(self._without_inner(r, self.rate) for r in self.position(place))

    def virtual_displacement(self, place: str) -> sp.ImmutableMatrix:
        return column(self._without_inner(r, self.variation) for r in self.position(place))

    def virtual_work(self, load: Contribution) -> sp.Expr:
        return self.true.virtual_work(load)

    def load_potential(self, load: str) -> sp.Expr:
        return self.true.load_potential(load)

    def _without_inner(self, component: sp.Expr, change: Callable[[str], sp.Expr]) -> sp.Expr:
        slopes = {q: component.diff(self.q(q)) for q in self.free}
        return sp.Add(*(s * (1 if s.has(self.q(q)) else change(q)) for q, s in slopes.items()))


@dataclass(frozen=True, eq=False)
class DerivativeOfCosine(FaultySolution):
    """The derivative of the cosine is taken as + sin.

    The pair sin → cos is remembered as symmetric, and the sign of cos → −sin is lost.
    """

    id: ClassVar[str] = "derivative-of-cosine"
    likely: ClassVar[int] = 2
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"sign"})
    evident: ClassVar[frozenset[str] | None] = frozenset(
        {"virtual-displacement", "virtual-work", "kinetic-energy", "momentum"}
    )

    def velocity(self, place: str) -> sp.ImmutableMatrix:
        return column(self._slope(r, self.rate) + r.diff(self.t) for r in self.position(place))

    def virtual_displacement(self, place: str) -> sp.ImmutableMatrix:
        return column(self._slope(r, self.variation) for r in self.position(place))

    def _slope(self, component: sp.Expr, change: Callable[[str], sp.Expr]) -> sp.Expr:
        return sp.Add(*(_unsigned_slope(component, self.q(q)) * change(q) for q in self.free))


def _unsigned_slope(value: sp.Expr, coordinate: sp.Symbol) -> sp.Expr:
    """∂value/∂q with the derivative of the cosine taken as + sin."""
    cosines = [f for f in value.atoms(sp.cos) if f.has(coordinate)]
    places = {f: sp.Dummy() for f in cosines}
    whole = value.xreplace(places)
    inner = (whole.diff(place) * sp.sin(f.args[0]) * f.args[0].diff(coordinate) for f, place in places.items())
    back = {place: f for f, place in places.items()}
    return (whole.diff(coordinate) + sp.Add(*inner)).xreplace(back)
