"""What the loads do: virtual work and generalized forces, load by load."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import sympy as sp

from ..language.derivatives import beside_jumps, diff
from ..language.memory import cached_method
from ..mechanics.contributions import (
    Contribution,
    DissipationFunction,
    DistributedForce,
    Friction,
    GeneralizedPotential,
    Moment,
    PointForce,
    PotentialEnergy,
)
from .kinematics import Kinematics


@dataclass(frozen=True, eq=False)
class Work(Kinematics):
    """Virtual work δW = Qᵢ δqᵢ, kept apart by load until the end."""

    @cached_property
    def load_names(self) -> tuple[str, ...]:
        """The loads that do work, in the scene's order."""
        return tuple(dict.fromkeys(part.source for part in self.scene.contributions))

    def place_of(self, load: Contribution) -> str:
        """The place that tells two forces of one load apart (the weights of two bodies)."""
        return load.place if isinstance(load, PointForce | DistributedForce) else ""

    def force(self, load: PointForce | DistributedForce) -> sp.ImmutableMatrix:
        """F(q, q̇, t), or the density f of a distributed force, with the guides put in."""
        return self.guided(self.vector(load.force if isinstance(load, PointForce) else load.density))

    def energy(self, load: PotentialEnergy) -> sp.Expr:
        """V(q, t) with the guides put in."""
        return self.display(self.guided(self.expression(load.energy)))

    def generalized_potential(self, load: GeneralizedPotential) -> sp.Expr:
        """U(q, q̇, t) with the guides put in."""
        return self.display(self.guided(self.expression(load.energy)))

    def dissipation(self, load: DissipationFunction) -> sp.Expr:
        """R(q, q̇, t) with the guides put in."""
        return self.display(self.guided(self.expression(load.function)))

    def slipping(self, load: Friction) -> sp.Expr:
        """c(q, t), what slips over the surface, with the guides put in."""
        return self.display(self.guided(self.expression(load.coordinate)))

    def slip_rate(self, load: Friction) -> sp.Expr:
        """ċ − u with the guides put in."""
        rate = self.time_derivative(self.slipping(load))
        return self.display(rate - self.guided(self.expression(load.surface_rate)))

    def friction_force(self, load: Friction) -> sp.Expr:
        """−F sgn(ċ − u) with the guides put in."""
        return -self.guided(self.expression(load.force)) * sp.sign(self.slip_rate(load))

    def angle(self, load: Moment) -> sp.Expr:
        """The angle φ(q, t) that a moment turns, with the guides put in."""
        return self.display(self.guided(self.expression(load.angle)))

    def moment(self, load: Moment) -> sp.Expr:
        """M(q, q̇, t) with the guides put in."""
        return self.display(self.guided(self.expression(load.moment)))

    @cached_method
    def virtual_work(self, load: Contribution) -> sp.Expr:
        """δW of one contribution, collected by the δq."""
        match load:
            case PointForce():
                work = self.dot(self.force(load), self.virtual_displacement(load.place))
            case Moment():
                work = self.moment(load) * self.vary(self.angle(load))
            case PotentialEnergy():
                work = -beside_jumps(self.vary(self.energy(load)))
            case GeneralizedPotential():
                work = self._of_generalized(self.generalized_potential(load))
            case DissipationFunction():
                work = self._dissipated(self.dissipation(load))
            case Friction():
                work = self.friction_force(load) * self.vary(self.slipping(load))
            case DistributedForce():
                density = self.dot(self.force(load), self.virtual_displacement(load.place))
                work = self.integrated(density, load.material, load.place)
        return self.collected(work)

    def _dissipated(self, function: sp.Expr) -> sp.Expr:
        """−∂R/∂q̇ᵢ δqᵢ"""
        return -sp.Add(*(diff(function, self.rate(q)) * self.variation(q) for q in self.free))

    def _of_generalized(self, function: sp.Expr) -> sp.Expr:
        """(d/dt ∂U/∂q̇ᵢ − ∂U/∂qᵢ) δqᵢ"""
        return sp.Add(*(self.euler_expression(function, q) * self.variation(q) for q in self.free))

    def share(self, load: Contribution, coordinate: str) -> sp.Expr:
        """What the load contributes to Qᵢ: the coefficient of δqᵢ."""
        return self.virtual_work(load).coeff(self.variation(coordinate))

    @cached_method
    def load_force(self, load: str, coordinate: str) -> sp.Expr:
        """Qᵢ of all contributions of one load."""
        shares = [self.share(part, coordinate) for part in self.scene.contributions if part.source == load]
        return self.display(sp.Add(*shares)) if len(shares) > 1 else shares[0]

    @cached_method
    def generalized_force(self, coordinate: str) -> sp.Expr:
        """Qᵢ of all loads."""
        return self.display(sp.Add(*(self.load_force(load, coordinate) for load in self.load_names)))

    def force_sources(self, coordinate: str) -> tuple[str, ...]:
        """The loads that act on a coordinate."""
        return tuple(f"load:{load}" for load in self.load_names if self.load_force(load, coordinate) != 0)
