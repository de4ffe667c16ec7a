"""Mistakes in the potential energy V, in its force −∂V/∂q, and in L = E − V."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ...mechanics.contributions import Contribution, PointForce, PotentialEnergy
from ...vocabulary import SlipKind
from ..faulty_solution import FaultySolution
from ..solution import Solution


@dataclass(frozen=True, eq=False)
class PotentialSign(FaultySolution):
    """The potential energy has the wrong sign.

    With the axis pointing down, height is not the coordinate: V = −m g y, though m g h is what one remembers.
    """

    id: ClassVar[str] = "potential-sign"
    likely: ClassVar[int] = 2
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"sign"})

    @property
    def potential_energy(self) -> sp.Expr:
        return -self.true.potential_energy


@dataclass(frozen=True, eq=False)
class HalfInSpringEnergy(FaultySolution):
    """The ½ of the energy of a spring or potential is missing: V = k s².

    Force times way is taken for the work, though the force grows along the way.
    """

    id: ClassVar[str] = "half-in-spring-energy"
    likely: ClassVar[int] = 1
    evident: ClassVar[frozenset[str] | None] = frozenset({"potential-energy", "lagrangian", "conserved"})
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"double"})

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        for part in true.scene.contributions:
            if isinstance(part, PotentialEnergy) and _is_stiff(part, true):
                yield cls(true.scene, true, part.source)

    def energy(self, load: PotentialEnergy) -> sp.Expr:
        right = super().energy(load)
        return 2 * right if load.source == self.about else right


@dataclass(frozen=True, eq=False)
class ForceForEnergy(FaultySolution):
    """The spring's force is given as its energy: k s instead of k s²/2.

    Force and energy of the spring are both remembered as "k times elongation".
    """

    id: ClassVar[str] = "force-for-energy"
    likely: ClassVar[int] = 4

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        for part in true.scene.contributions:
            if isinstance(part, PotentialEnergy):
                yield cls(true.scene, true, part.source)

    @property
    def potential_energy(self) -> sp.Expr:
        right = self.true.load_potential(self.about)
        moving = [q for q in map(self.q, self.free) if right.has(q)]
        slope = right.diff(moving[0]) if moving else right
        return self.true.potential_energy - right + slope


@dataclass(frozen=True, eq=False)
class RestLengthMissing(FaultySolution):
    """The rest length of a spring is left out.

    V = k s²/2 is written with the length s of the spring instead of its elongation s − s₀.
    """

    id: ClassVar[str] = "rest-length-missing"
    likely: ClassVar[int] = 1
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"missing"})

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        for part in true.scene.contributions:
            if isinstance(part, PotentialEnergy):
                energy = true.energy(part)
                lengths = [p.name for p in true.scene.parameters if p.unit == "m" and energy.has(true.q(p.name))]
                lengths = [name for name in lengths if energy.xreplace({true.q(name): true.zero}) != 0]
                lengths = [name for name in lengths if not energy.diff(true.q(name)).diff(true.q(name)).has(true.t)]
                yield from (cls(true.scene, true, f"{part.source}:{name}") for name in lengths)

    def energy(self, load: PotentialEnergy) -> sp.Expr:
        source, _, length = self.about.partition(":")
        right = super().energy(load)
        return right.xreplace({self.q(length): self.zero}) if load.source == source else right


@dataclass(frozen=True, eq=False)
class FollowerForceAsPotential(FaultySolution):
    """A force without potential is given the potential −F · r.

    That holds for a constant force. A force that turns along has no potential: differentiating −F · r
    differentiates the force, too.
    """

    id: ClassVar[str] = "follower-force-as-potential"
    likely: ClassVar[int] = 3

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        for part in true.scene.contributions:
            if isinstance(part, PointForce) and not true.is_conservative(part.source):
                yield cls(true.scene, true, part.source)

    @property
    def potential_energy(self) -> sp.Expr:
        parts = [
            part for part in self.scene.contributions if part.source == self.about and isinstance(part, PointForce)
        ]
        work = sp.Add(*(self.dot(self.force(part), self.position(part.place)) for part in parts))
        return self.true.potential_energy - work

    def nonconservative_force(self, coordinate: str) -> sp.Expr:
        return self.true.nonconservative_force(coordinate) - self.load_force(self.about, coordinate)


@dataclass(frozen=True, eq=False)
class GeneralizedPotentialLeftOut(FaultySolution):
    """The generalized potential is left out of L, and its forces, which depend on rates, with it.

    "A force that depends on velocities has no potential", so a magnetic field is thought to have no place in L.
    """

    id: ClassVar[str] = "generalized-potential-left-out"
    likely: ClassVar[int] = 3
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"missing"})

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        yield from (cls(true.scene, true, load) for load in true.generalized_loads)

    @property
    def potential_of_rates(self) -> sp.Expr:
        left_out = self.true.velocity_potential(self.about)
        return self.true.potential_of_rates - left_out + self.at_rest(left_out)


@dataclass(frozen=True, eq=False)
class PotentialForceSign(FaultySolution):
    """The force of a potential or spring is taken as +∂V/∂q.

    The minus sign of F = −grad V is forgotten when the force is read off the potential.
    """

    id: ClassVar[str] = "potential-force-sign"
    likely: ClassVar[int] = 2
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"sign"})

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        for part in true.scene.contributions:
            if isinstance(part, PotentialEnergy):
                yield cls(true.scene, true, part.source)

    def virtual_work(self, load: Contribution) -> sp.Expr:
        right = super().virtual_work(load)
        return -right if load.source == self.about else right

    def load_potential(self, load: str) -> sp.Expr:
        return self.true.load_potential(load)

    def potential_slope(self, coordinate: str) -> sp.Expr:
        own = self.true.load_potential(self.about).diff(self.q(coordinate))
        return self.true.potential_slope(coordinate) - 2 * own


@dataclass(frozen=True, eq=False)
class PotentialMissing(FaultySolution):
    """The conservative forces are missing in the equation.

    Lagrange's equation is written with E instead of L, and without generalized forces.
    """

    id: ClassVar[str] = "potential-missing"
    likely: ClassVar[int] = 2
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"missing"})

    def potential_slope(self, _coordinate: str, /) -> sp.Expr:
        return self.zero


@dataclass(frozen=True, eq=False)
class PotentialCountedTwice(FaultySolution):
    """The conservative forces count twice: in the Lagrange function and again as generalized forces.

    V goes into L, and the weight is still listed among the forces on the right side.
    """

    id: ClassVar[str] = "potential-counted-twice"
    likely: ClassVar[int] = 1
    evident: ClassVar[frozenset[str] | None] = frozenset()

    def potential_slope(self, coordinate: str) -> sp.Expr:
        return 2 * super().potential_slope(coordinate)


@dataclass(frozen=True, eq=False)
class PotentialOnTheWrongSide(FaultySolution):
    """∂V/∂q stands on the wrong side: the equation has −∂V/∂q on the left.

    From L = E − V the minus is kept, though −∂L/∂q turns it into a plus.
    """

    id: ClassVar[str] = "potential-on-the-wrong-side"
    likely: ClassVar[int] = 2
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"sign"})

    def potential_slope(self, coordinate: str) -> sp.Expr:
        return -super().potential_slope(coordinate)


@dataclass(frozen=True, eq=False)
class SumOfEnergies(FaultySolution):
    """L is taken as E + V.

    The total energy is the more familiar quantity; the difference looks like a mistake.
    """

    id: ClassVar[str] = "sum-of-energies"
    likely: ClassVar[int] = 1
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"sign"})

    @property
    def lagrangian(self) -> sp.Expr:
        return self.kinetic_energy + self.potential_energy


def _is_stiff(part: PotentialEnergy, true: Solution) -> bool:
    """Whether a spring is in it: a parameter with the unit of a stiffness, or none with a unit at all."""
    energy = true.energy(part)
    units = [p.unit for p in true.scene.parameters if p.unit and energy.has(true.q(p.name))]
    return not units or any(unit.startswith("N") for unit in units)
