"""Mistakes in the virtual work δW = F·δr, in the generalized forces Q it leads to, and in the dissipation."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ...language.canonical import display
from ...mechanics.contributions import Contribution, DissipationFunction, DistributedForce, PointForce
from ...vocabulary import SlipKind
from ..faulty_solution import FaultySolution
from ..solution import Solution
from .position import swapped


@dataclass(frozen=True, eq=False)
class LoadMissing(FaultySolution):
    """One load has been left out.

    The loads are not listed before the work is written down, and the spring or the damper is forgotten.
    """

    id: ClassVar[str] = "load-missing"
    likely: ClassVar[int] = 1
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"missing"})

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        yield from (cls(true.scene, true, load) for load in true.load_names)

    def virtual_work(self, load: Contribution) -> sp.Expr:
        return self.zero if load.source == self.about else super().virtual_work(load)

    def load_potential(self, load: str) -> sp.Expr:
        return self.zero if load == self.about else super().load_potential(load)


@dataclass(frozen=True, eq=False)
class WeightMissing(FaultySolution):
    """The weight of one of several bodies has been left out.

    Gravity acts on every mass, but only the weight of the lowest or the largest body is written down.
    """

    id: ClassVar[str] = "weight-missing"
    likely: ClassVar[int] = 2
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"missing"})

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        parts = [part for part in true.scene.contributions if isinstance(part, PointForce)]
        for part in parts:
            if sum(other.source == part.source for other in parts) > 1:
                yield cls(true.scene, true, f"{part.source}:{part.place}")

    def force(self, load: PointForce | DistributedForce) -> sp.ImmutableMatrix:
        right = super().force(load)
        return 0 * right if self.about == f"{load.source}:{load.place}" else right


@dataclass(frozen=True, eq=False)
class GravitySign(FaultySolution):
    """The weight points the wrong way.

    The axis points down, and the habit of writing −g stays (or the other way round).
    """

    id: ClassVar[str] = "gravity-sign"
    likely: ClassVar[int] = 1
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"sign"})

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        for load in true.scene.loads:
            if load.kind == "gravity":
                yield cls(true.scene, true, load.name)

    def force(self, load: PointForce | DistributedForce) -> sp.ImmutableMatrix:
        right = super().force(load)
        return -right if load.source == self.about else right


@dataclass(frozen=True, eq=False)
class MassMissingInWeight(FaultySolution):
    """The weight is written as g instead of m g.

    The acceleration is taken for the force.
    """

    id: ClassVar[str] = "mass-missing-in-weight"
    likely: ClassVar[int] = 3
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"factor-missing", "power"})

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        for load in true.scene.loads:
            if load.kind == "gravity":
                yield cls(true.scene, true, load.name)

    def force(self, load: PointForce | DistributedForce) -> sp.ImmutableMatrix:
        right = super().force(load)
        body = next((b for b in self.scene.bodies if b.name == load.place and not b.material), None)
        return right / self.mass(body) if body is not None and load.source == self.about else right


@dataclass(frozen=True, eq=False)
class ForceSign(FaultySolution):
    """A force or moment counts with the wrong sign.

    Work is taken as negative where force and displacement point the same way, often from a reaction force in
    mind.
    """

    id: ClassVar[str] = "force-sign"
    likely: ClassVar[int] = 2
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"sign"})

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        for load in true.scene.loads:
            if load.kind in ("force", "moment", "distributed"):
                yield cls(true.scene, true, load.name)

    def virtual_work(self, load: Contribution) -> sp.Expr:
        right = super().virtual_work(load)
        return -right if load.source == self.about else right


@dataclass(frozen=True, eq=False)
class ForceComponentsSwapped(FaultySolution):
    """Sine and cosine are swapped in the components of a force.

    The force is resolved along the wrong axis: its direction is read off the rod instead of the normal of
    the rod.
    """

    id: ClassVar[str] = "force-components-swapped"
    likely: ClassVar[int] = 3
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"function"})

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        for part in true.scene.contributions:
            if isinstance(part, PointForce) and any(node.has(sp.sin, sp.cos) for node in true.force(part)):
                yield cls(true.scene, true, part.source)

    def force(self, load: PointForce | DistributedForce) -> sp.ImmutableMatrix:
        right = super().force(load)
        for q in self.free if load.source == self.about else ():
            right = swapped(right, self.q(q))
        return right


@dataclass(frozen=True, eq=False)
class LeverArmMissing(FaultySolution):
    """The lever arm is missing: the generalized force of an angle is given as a force.

    Q is read off as the component of the force along the path, F instead of F l, for one load or for all.
    """

    id: ClassVar[str] = "lever-arm-missing"
    likely: ClassVar[int] = 2
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"factor-missing", "power"})

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        forces = (part.source for part in true.scene.contributions if isinstance(part, PointForce))
        yield from (cls(true.scene, true, about) for about in ("", *dict.fromkeys(forces)))

    def virtual_work(self, load: Contribution) -> sp.Expr:
        right = self.true.virtual_work(load)
        if not isinstance(load, PointForce) or self.about not in ("", load.source):
            return right
        angles = {c.name for c in self.scene.free if c.unit in ("rad", "deg")}
        return sp.Add(*(self._share(right, load, q, turning=q in angles) for q in self.free))

    def _share(self, work: sp.Expr, load: PointForce, coordinate: str, *, turning: bool) -> sp.Expr:
        change = self.variation(coordinate)
        share = work.coeff(change) * change
        tangent = self.position(load.place).diff(self.q(coordinate))
        arm = sp.sqrt(display(self.dot(tangent, tangent).expand(), self.symbols))
        return share / arm if turning and arm != 0 else share

    def load_potential(self, load: str) -> sp.Expr:
        return self.true.load_potential(load)


@dataclass(frozen=True, eq=False)
class PositionForDisplacement(FaultySolution):
    """The work is taken with the position instead of its variation: δW = F · r.

    Force times way is remembered, and the way is taken from the origin.
    """

    id: ClassVar[str] = "position-for-displacement"
    likely: ClassVar[int] = 4

    def virtual_work(self, load: Contribution) -> sp.Expr:
        right = super().virtual_work(load)
        if not isinstance(load, PointForce):
            return right
        work = self.dot(self.force(load), self.position(load.place))
        return sp.Add(*(work * self.variation(q) for q in self.free)) if len(self.free) == 1 else right

    def load_potential(self, load: str) -> sp.Expr:
        return self.true.load_potential(load)


@dataclass(frozen=True, eq=False)
class VirtualWorkForForce(FaultySolution):
    """The generalized force is given together with the δq of its coordinate.

    The coefficient is not separated from what it is the coefficient of: Q δq is taken for Q.
    """

    id: ClassVar[str] = "virtual-work-for-force"
    likely: ClassVar[int] = 1

    def generalized_force(self, coordinate: str) -> sp.Expr:
        return self.true.generalized_force(coordinate) * self.variation(coordinate)


@dataclass(frozen=True, eq=False)
class DissipationSign(FaultySolution):
    """The damping has the wrong sign and feeds energy in.

    −∂R/∂q̇ is moved to the left side without changing its sign, or the minus is forgotten.
    """

    id: ClassVar[str] = "dissipation-sign"
    likely: ClassVar[int] = 1
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"sign"})

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        if any(isinstance(part, DissipationFunction) for part in true.scene.contributions):
            yield cls(true.scene, true)

    def dissipation(self, load: DissipationFunction) -> sp.Expr:
        return -super().dissipation(load)


@dataclass(frozen=True, eq=False)
class DissipationFactor(FaultySolution):
    """The ½ of Rayleigh's function is kept: the damping force comes out half as large.

    R is read off as the force times the rate, or differentiated without the 2 of the square.
    """

    id: ClassVar[str] = "dissipation-factor"
    likely: ClassVar[int] = 2
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"half"})

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        if any(isinstance(part, DissipationFunction) for part in true.scene.contributions):
            yield cls(true.scene, true)

    def dissipation(self, load: DissipationFunction) -> sp.Expr:
        return super().dissipation(load) / 2
