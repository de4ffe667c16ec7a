"""What the loads do: virtual work and generalized forces, load by load."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import sympy as sp

from ..mechanics.contributions import Contribution, PointForce, PotentialEnergy
from .kinematics import Kinematics
from .memory import kept


@dataclass(frozen=True, eq=False)
class Work(Kinematics):
    """Virtual work δW = Qᵢ δqᵢ, kept apart by load until the end."""

    @cached_property
    def load_names(self) -> tuple[str, ...]:
        return tuple(dict.fromkeys(part.source for part in self.scene.contributions))

    def place_of(self, load: Contribution) -> str:
        """The place that tells two forces of one load apart (the weights of two bodies)."""
        return load.place if isinstance(load, PointForce) else ""

    def force(self, load: PointForce) -> sp.ImmutableMatrix:
        """F(q, q̇, t) with the guides put in."""
        return self.guided(self.vector(load.force))

    def potential(self, load: PotentialEnergy) -> sp.Expr:
        """V(q, t) with the guides put in."""
        return self.display(self.guided(self.expression(load.energy)))

    @kept
    def virtual_work(self, load: Contribution) -> sp.Expr:
        """δW = F · δr, or −δV."""
        if isinstance(load, PointForce):
            return self.collected(self.dot(self.force(load), self.virtual_displacement(load.place)))
        return self.collected(-self.vary(self.potential(load)))

    def share(self, load: Contribution, coordinate: str) -> sp.Expr:
        """What the load contributes to Qᵢ: the coefficient of δqᵢ."""
        return self.virtual_work(load).coeff(self.variation(coordinate))

    @kept
    def load_force(self, load: str, coordinate: str) -> sp.Expr:
        """Qᵢ of all contributions of one load."""
        shares = [self.share(part, coordinate) for part in self.scene.contributions if part.source == load]
        return self.display(sp.Add(*shares)) if len(shares) > 1 else shares[0]

    @kept
    def generalized_force(self, coordinate: str) -> sp.Expr:
        """Qᵢ of all loads."""
        return self.display(sp.Add(*(self.load_force(load, coordinate) for load in self.load_names)))
