"""Mistakes in the virtual displacement δr = ∂r/∂q δq, taken at a frozen time."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ...mechanics.contributions import Contribution, PointForce
from ..faulty_solution import FaultySolution
from ..solution import Solution


@dataclass(frozen=True, eq=False)
class Respelling(FaultySolution):
    """Virtual displacements and works in which something else is written for the variations."""

    @property
    @abstractmethod
    def written(self) -> Mapping[sp.Symbol, sp.Expr]:
        """What is written for each δq."""

    def virtual_displacement(self, place: str) -> sp.ImmutableMatrix:
        return self.true.virtual_displacement(place).xreplace(self.written)

    def virtual_work(self, load: Contribution) -> sp.Expr:
        return self.true.virtual_work(load).xreplace(self.written)

    def load_force(self, load: str, coordinate: str) -> sp.Expr:
        return self.true.load_force(load, coordinate)

    def load_potential(self, load: str) -> sp.Expr:
        return self.true.load_potential(load)

    def generalized_force(self, coordinate: str) -> sp.Expr:
        return self.true.generalized_force(coordinate)


@dataclass(frozen=True, eq=False)
class TimeTermKept(FaultySolution):
    """dr is taken for δr: the term ∂r/∂t dt is kept.

    A virtual displacement happens at a frozen time; whoever takes the total differential moves the guide along.
    """

    id: ClassVar[str] = "time-term-kept"
    likely: ClassVar[int] = 1

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        if true.depends_on_time:
            yield cls(true.scene, true)

    def virtual_displacement(self, place: str) -> sp.ImmutableMatrix:
        kept = self.position(place).diff(self.t) * self.symbols.differential("t")
        return super().virtual_displacement(place) + kept


@dataclass(frozen=True, eq=False)
class TotalDifferentialForVariation(FaultySolution):
    """The total differential dr is given for δr, with dq and with dt.

    The formula of the total differential is known from calculus and is applied as it stands.
    """

    id: ClassVar[str] = "total-differential-for-variation"
    likely: ClassVar[int] = 1

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        if true.depends_on_time:
            yield cls(true.scene, true)

    def virtual_displacement(self, place: str) -> sp.ImmutableMatrix:
        changed = {self.variation(q): self.symbols.differential(q) for q in self.free}
        right = super().virtual_displacement(place).xreplace(changed)
        return right + self.position(place).diff(self.t) * self.symbols.differential("t")


@dataclass(frozen=True, eq=False)
class VelocityForVirtualDisplacement(FaultySolution):
    """The velocity is given where a virtual displacement is asked for.

    The derivative with respect to time has the same shape as the variation, with q̇ in the place of δq.
    """

    id: ClassVar[str] = "velocity-for-virtual-displacement"
    likely: ClassVar[int] = 2

    def virtual_displacement(self, place: str) -> sp.ImmutableMatrix:
        return self.velocity(place)

    def virtual_work(self, load: Contribution) -> sp.Expr:
        return self.true.virtual_work(load)

    def load_potential(self, load: str) -> sp.Expr:
        return self.true.load_potential(load)


@dataclass(frozen=True, eq=False)
class GuideVaried(FaultySolution):
    """A guided coordinate is varied.

    Its motion is given, so it has no virtual displacement of its own: δy = 0.
    """

    id: ClassVar[str] = "guide-varied"
    likely: ClassVar[int] = 1
    evident: ClassVar[frozenset[str] | None] = frozenset({"virtual-displacement", "virtual-work"})

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        yield from (cls(true.scene, true, guide.coordinate) for guide in true.scene.guides)

    def virtual_displacement(self, place: str) -> sp.ImmutableMatrix:
        free = self.vector(self.trees(place)).diff(self.q(self.about))
        return super().virtual_displacement(place) + self.guided(free) * self.variation(self.about)

    def virtual_work(self, load: Contribution) -> sp.Expr:
        right = self.true.virtual_work(load)
        if not isinstance(load, PointForce):
            return right
        return self.dot(self.force(load), self.virtual_displacement(load.place))


@dataclass(frozen=True, eq=False)
class CoordinateNotVaried(FaultySolution):
    """One degree of freedom has not been varied.

    The coordinate that moves the base is treated as given, though nothing prescribes it.
    """

    id: ClassVar[str] = "coordinate-not-varied"
    likely: ClassVar[int] = 2

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        if len(true.free) > 1:
            yield from (cls(true.scene, true, q) for q in true.free)

    def virtual_displacement(self, place: str) -> sp.ImmutableMatrix:
        return super().virtual_displacement(place).xreplace({self.variation(self.about): self.zero})

    def load_potential(self, load: str) -> sp.Expr:
        return self.true.load_potential(load)


@dataclass(frozen=True, eq=False)
class DifferentialForVariation(Respelling):
    """dq is written where δq is meant.

    Both are small, and the difference (one follows the motion, the other is thought of at a frozen time) is not yet
    felt.
    """

    id: ClassVar[str] = "differential-for-variation"
    likely: ClassVar[int] = 1

    @property
    def written(self) -> dict[sp.Symbol, sp.Expr]:
        return {self.variation(q): self.symbols.differential(q) for q in self.free}


@dataclass(frozen=True, eq=False)
class VariationMissing(Respelling):
    """The partial derivatives are given without the δq they are multiplied by.

    ∂r/∂q is taken for δr: the variation is understood as a derivative, and what it is multiplied by gets lost.
    """

    id: ClassVar[str] = "variation-missing"
    likely: ClassVar[int] = 1

    @property
    def written(self) -> dict[sp.Symbol, sp.Expr]:
        return {self.variation(q): sp.Integer(1) for q in self.free}
