"""Mistakes in Lagrange's equation d/dt ∂E/∂q̇ − ∂E/∂q + ∂V/∂q = Q."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ...vocabulary import SlipKind
from ..faulty_solution import FaultySolution
from ..solution import Solution
from .kinetic_energy import degrees_in_rates


@dataclass(frozen=True, eq=False)
class MomentumIsMassTimesRate(FaultySolution):
    """The generalized momentum is taken as inertia times its own rate.

    p = m v holds for one particle along a line; coupled coordinates bring the rates of the others in.
    """

    id: ClassVar[str] = "momentum-is-mass-times-rate"
    likely: ClassVar[int] = 2
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"missing"})

    def momentum(self, coordinate: str) -> sp.Expr:
        rate = self.rate(coordinate)
        return self.true.momentum(coordinate).diff(rate) * rate


@dataclass(frozen=True, eq=False)
class TotalDerivativePartial(FaultySolution):
    """In d/dt ∂E/∂q̇ only the rates are differentiated; the factors that move, too, are held constant.

    m r² φ̇ becomes m r² φ̈: the product rule, and with it the term 2 m r ṙ φ̇, is lost.
    """

    id: ClassVar[str] = "total-derivative-partial"
    likely: ClassVar[int] = 1
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"missing"})

    def momentum_rate(self, coordinate: str) -> sp.Expr:
        momentum = self.kinetic_energy.diff(self.rate(coordinate))
        return sp.Add(*(momentum.diff(self.rate(q)) * self.acceleration(q) for q in self.free))


@dataclass(frozen=True, eq=False)
class TotalDerivativeHalved(FaultySolution):
    """The terms from differentiating a moving factor come out half as large as they are.

    d/dt r² is taken as r ṙ: the 2 of the inner square is lost.
    """

    id: ClassVar[str] = "total-derivative-halved"
    likely: ClassVar[int] = 2
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"half"})

    def momentum_rate(self, coordinate: str) -> sp.Expr:
        momentum = self.kinetic_energy.diff(self.rate(coordinate))
        rates = sp.Add(*(momentum.diff(self.rate(q)) * self.acceleration(q) for q in self.free))
        return (rates + super().momentum_rate(coordinate)) / 2


@dataclass(frozen=True, eq=False)
class GuideAccelerationMissing(FaultySolution):
    """The acceleration of the guided base is left out: d/dt does not reach the explicit time in ∂E/∂q̇.

    The momentum is differentiated by coordinates and rates alone.
    """

    id: ClassVar[str] = "guide-acceleration-missing"
    likely: ClassVar[int] = 1
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"missing"})

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        if true.depends_on_time:
            yield cls(true.scene, true)

    def momentum_rate(self, coordinate: str) -> sp.Expr:
        momentum = self.kinetic_energy.diff(self.rate(coordinate))
        return super().momentum_rate(coordinate) - momentum.diff(self.t)


@dataclass(frozen=True, eq=False)
class EnergySlopeDropped(FaultySolution):
    """∂E/∂q is left out of Lagrange's equation.

    The kinetic energy is thought of as depending on rates only, so the second term is not looked at.
    """

    id: ClassVar[str] = "energy-slope-dropped"
    likely: ClassVar[int] = 1
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"missing", "superfluous"})

    def energy_slope(self, _coordinate: str, /) -> sp.Expr:
        return self.zero


@dataclass(frozen=True, eq=False)
class EnergySlopeSign(FaultySolution):
    """∂E/∂q is added instead of subtracted.

    The signs of d/dt ∂E/∂q̇ − ∂E/∂q are remembered as two plus signs.
    """

    id: ClassVar[str] = "energy-slope-sign"
    likely: ClassVar[int] = 2
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"sign", "superfluous", "double"})

    def energy_slope(self, coordinate: str) -> sp.Expr:
        return -super().energy_slope(coordinate)


@dataclass(frozen=True, eq=False)
class CoriolisMissing(FaultySolution):
    """The terms with products of two different rates are missing (Coriolis).

    They come from the product rule and from mixed terms of v², and both are easily passed over.
    """

    id: ClassVar[str] = "coriolis-missing"
    likely: ClassVar[int] = 3
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"missing"})

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        if len(true.free) > 1:
            yield cls(true.scene, true)

    def equation(self, coordinate: str) -> sp.Expr:
        return _without(super().equation(coordinate), self, mixed=True)


@dataclass(frozen=True, eq=False)
class CentrifugalMissing(FaultySolution):
    """The terms with squares of rates are missing (centrifugal).

    They have no counterpart in the equations of motion along a line, where only forces and masses occur.
    """

    id: ClassVar[str] = "centrifugal-missing"
    likely: ClassVar[int] = 3
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"missing"})

    def equation(self, coordinate: str) -> sp.Expr:
        return _without(super().equation(coordinate), self, mixed=False)


def _without(equation: sp.Expr, solution: Solution, *, mixed: bool) -> sp.Expr:
    """The equation without products of two rates (mixed), or without squares of one."""
    wanted = [1, 1] if mixed else [2]
    terms = sp.Add.make_args(equation.expand())
    return sp.Add(*(t for t in terms if [d for d in degrees_in_rates(t, solution) if d] != wanted))
