"""Mistakes in the reactions of constraints."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ...mechanics.conditions import Condition
from ...vocabulary import SlipKind
from ..faulty_solution import FaultySolution
from ..solution import Solution


@dataclass(frozen=True, eq=False)
class ReactionForgotten(FaultySolution):
    """The reactions are left out of the equations of motion.

    More coordinates are used than there are degrees of freedom, and then as if all of them were free.
    """

    id: ClassVar[str] = "reaction-forgotten"
    likely: ClassVar[int] = 1
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"missing"})

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        if true.conditions:
            yield cls(true.scene, true)

    def reaction(self, _coordinate: str, /) -> sp.Expr:
        return self.zero


@dataclass(frozen=True, eq=False)
class ReactionSign(FaultySolution):
    """The reactions stand on the wrong side: +λ ∂Φ/∂q on the left of `… = 0`.

    L + λΦ and E − V − λΦ are both in use; here λ is told by δW = λ δΦ, and its sign is not free any more.
    """

    id: ClassVar[str] = "reaction-sign"
    likely: ClassVar[int] = 2
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"sign"})

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        if true.conditions:
            yield cls(true.scene, true)

    def reaction(self, coordinate: str) -> sp.Expr:
        return -super().reaction(coordinate)

    def rest_reaction(self, source: str) -> sp.Expr:
        return -super().rest_reaction(source)

    def constraint_force(self, source: str) -> sp.Expr:
        return -super().constraint_force(source)


@dataclass(frozen=True, eq=False)
class DriftForgotten(FaultySolution):
    """A constraint is differentiated twice as if its coefficients were constant: A q̈ = 0 without γ.

    The direction in which it acts turns while the system moves. A reaction found without γ is that of rest: the weight
    along a rod, and nothing for the way round.
    """

    id: ClassVar[str] = "drift-forgotten"
    likely: ClassVar[int] = 1

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        if true.conditions:
            yield cls(true.scene, true)

    def drift_term(self, _condition: Condition) -> sp.Expr:
        return self.zero

    def constraint_force(self, source: str) -> sp.Expr:
        found = self._multipliers(source)
        turned = sp.Matrix([self.model.drift_term(each) for each in self.conditions])
        forces = -found.matrix.adjugate() * (found.rest - turned) / found.matrix.det(method="berkowitz")
        return forces[self.conditions.index(self._bound_by(source)), 0]


@dataclass(frozen=True, eq=False)
class RatesTakenForPositions(FaultySolution):
    """A constraint on rates is written for positions: x = R cos ψ φ where ẋ = R cos ψ φ̇ holds.

    As if the dots could be left out on both sides. That is so only where the factors are constant, as along a line.
    """

    id: ClassVar[str] = "rates-taken-for-positions"
    likely: ClassVar[int] = 1

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        if not all(condition.is_holonomic for condition in true.conditions):
            yield cls(true.scene, true)

    def kept(self, source: str) -> sp.Expr:
        return super().kept(source).xreplace({self.rate(q): self.q(q) for q in self.free})


@dataclass(frozen=True, eq=False)
class DistanceWithoutRoot(FaultySolution):
    """A length is set equal to the sum of squares: x² + y² = ℓ.

    Pythagoras is written down without the root, or with the square on one side only; the units tell.
    """

    id: ClassVar[str] = "distance-without-root"
    likely: ClassVar[int] = 2

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        if true.conditions:
            yield cls(true.scene, true)

    def kept(self, source: str) -> sp.Expr:
        value = super().kept(source)
        roots = {root: root.base for root in value.atoms(sp.Pow) if root.exp == sp.Rational(1, 2)}
        return value.xreplace(roots)


@dataclass(frozen=True, eq=False)
class RatesVariedAlongTheMotion(FaultySolution):
    """A constraint on rates is varied along the motion, as if L + λΦ were the Lagrange function.

    That is the vakonomic problem: with λ̇ a − λ (∂Φ/∂q − ȧ) in the equations, its motions are others. The reaction of a
    constraint on rates follows from virtual displacements at frozen time, Σ a δq = 0.
    """

    id: ClassVar[str] = "rates-varied-along-the-motion"
    likely: ClassVar[int] = 1

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        if not all(condition.is_holonomic for condition in true.conditions):
            yield cls(true.scene, true)

    def reaction(self, coordinate: str) -> sp.Expr:
        held = (c for c in self.conditions if c.is_holonomic)
        bound = (c for c in self.conditions if not c.is_holonomic)
        varied = (self._varied(self.condition(c), self.multiplier(c), coordinate) for c in bound)
        return sp.Add(*(self.reaction_share(c, coordinate) for c in held), *varied)

    def _varied(self, condition: sp.Expr, multiplier: sp.Symbol, coordinate: str) -> sp.Expr:
        """∂(λΦ)/∂q − d/dt ∂(λΦ)/∂q̇"""
        slope = condition.diff(self.rate(coordinate))
        change = self.time_derivative(slope)
        return multiplier * (condition.diff(self.q(coordinate)) - change) - self.rate(multiplier.name) * slope
