"""Mistakes in impacts: in the impulse, in the momenta behind it, and in the energy that is lost."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import ClassVar, Self

import sympy as sp

from ...mechanics.conditions import Condition
from ..faulty_solution import FaultySolution
from ..solution import Solution


@dataclass(frozen=True, eq=False)
class ImpactMistake(FaultySolution):
    """A mistake that only scenes with impacts have room for."""

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        if true.bounces:
            yield cls(true.scene, true)


@dataclass(frozen=True, eq=False)
class RestitutionOnWholeVelocity(ImpactMistake):
    """The whole velocity is turned round and scaled by e, as if the body flew straight at the contact.

    Newton's hypothesis is about the rate of the gap alone: what is tangential to the contact stays.
    """

    id: ClassVar[str] = "restitution-on-whole-velocity"
    likely: ClassVar[int] = 1

    def momentum_behind(self, contact: str, coordinate: str) -> sp.Expr:
        return -self.restitution_of(contact) * self.momentum(coordinate)

    def impact_loss(self, contact: str) -> sp.Expr:
        return (1 - self.restitution_of(contact) ** 2) * self.kinetic_energy


@dataclass(frozen=True, eq=False)
class ImpulseWithoutGradient(ImpactMistake):
    """The impulse is added to each momentum as it is, without ∂g/∂q.

    A generalized momentum takes Λ times the derivative of the gap by its coordinate: a lever arm for an angle.
    """

    id: ClassVar[str] = "impulse-without-gradient"
    likely: ClassVar[int] = 2

    def gap_slope(self, contact: str, coordinate: str) -> sp.Expr:
        return sp.Integer(1) if self.true.gap_slope(contact, coordinate) != 0 else self.zero

    def effective_mass(self, contact: str) -> sp.Expr:
        return self.true.effective_mass(contact)


@dataclass(frozen=True, eq=False)
class ImpulseSign(ImpactMistake):
    """The impulse is taken off where it is to be added.

    Λ is the push of the contact, positive where the gap opens by it, and the momenta grow by Λ ∂g/∂q.
    """

    id: ClassVar[str] = "impulse-sign"
    likely: ClassVar[int] = 3

    def impact_impulse(self, contact: str) -> sp.Expr:
        return -super().impact_impulse(contact)

    def impact_loss(self, contact: str) -> sp.Expr:
        return self.true.impact_loss(contact)


@dataclass(frozen=True, eq=False)
class RestitutionForgotten(ImpactMistake):
    """The impact is computed as if the bodies stayed together: without e.

    Stopping the gap takes one part of the impulse, pushing it open again takes e times as much.
    """

    id: ClassVar[str] = "restitution-forgotten"
    likely: ClassVar[int] = 2

    def restitution_of(self, _contact: str) -> sp.Expr:
        return self.zero


@dataclass(frozen=True, eq=False)
class RestitutionSubtracted(ImpactMistake):
    """1 − e stands where 1 + e belongs.

    The rates behind and before have opposite signs, so that their difference is the sum of the magnitudes.
    """

    id: ClassVar[str] = "restitution-subtracted"
    likely: ClassVar[int] = 3

    def closing_factor(self, contact: str) -> sp.Expr:
        return 1 - self.restitution_of(contact)

    def impact_loss(self, contact: str) -> sp.Expr:
        return self.true.impact_loss(contact)


@dataclass(frozen=True, eq=False)
class RestitutionNotSquared(ImpactMistake):
    """The loss is taken as 1 − e of the energy of the closing motion.

    e is a ratio of rates; the energies go with their squares, so that 1 − e² of it is lost.
    """

    id: ClassVar[str] = "restitution-not-squared"
    likely: ClassVar[int] = 1
    of: str = "gap"  # "closing": without the work of a contact that moves; "whole": all of the kinetic energy

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        for one in super().variants(true):
            yield one
            yield from (replace(one, of=of) for of in ("closing", "whole"))

    def impact_loss(self, contact: str) -> sp.Expr:
        e, rate = self.restitution_of(contact), self.closing_rate(contact)
        closing = self.effective_mass(contact) * rate**2 / 2
        energy = self.kinetic_energy if self.of == "whole" else closing
        fed = self.work_of_drift(contact) if self.of == "gap" else self.zero
        return (1 - e) * energy + fed


@dataclass(frozen=True, eq=False)
class RestitutionSquaredOnly(ImpactMistake):
    """What is left, e² of the energy, is given as what is lost.

    The energy behind the impact is e² times that before it; the loss is the rest.
    """

    id: ClassVar[str] = "restitution-energy-left"
    likely: ClassVar[int] = 3

    def impact_loss(self, contact: str) -> sp.Expr:
        e, rate = self.restitution_of(contact), self.closing_rate(contact)
        return e**2 * self.effective_mass(contact) * rate**2 / 2


@dataclass(frozen=True, eq=False)
class ContactTakenAtRest(ImpactMistake):
    """The motion of the contact itself is left out: e is applied to the body's own rate.

    Newton's hypothesis is about the rate at which the two approach; a table that rises adds its own.
    """

    id: ClassVar[str] = "contact-taken-at-rest"
    likely: ClassVar[int] = 2

    def closing_rate(self, contact: str) -> sp.Expr:
        return super().closing_rate(contact) - self.true.contact_drift(contact)

    def contact_drift(self, _contact: str) -> sp.Expr:
        return self.zero


@dataclass(frozen=True, eq=False)
class ApproachTakenForGapRate(ImpactMistake):
    """The speed of approach is told as the rate of the gap: positive while the gap closes.

    A gap that closes becomes smaller, so that ġ < 0 before the impact.
    """

    id: ClassVar[str] = "approach-taken-for-gap-rate"
    likely: ClassVar[int] = 2

    def gap_rate(self, contact: str) -> sp.Expr:
        return -super().gap_rate(contact)


@dataclass(frozen=True, eq=False)
class GapRateWithoutRates(ImpactMistake):
    """The gap is differentiated by the coordinates, and their rates are left out: ∂g/∂q in place of ∂g/∂q q̇.

    The coordinates are functions of time; the chain rule gives each derivative the rate of its coordinate as a factor.
    """

    id: ClassVar[str] = "gap-rate-without-rates"
    likely: ClassVar[int] = 3

    def gap_rate(self, contact: str) -> sp.Expr:
        return sp.Add(self.contact_drift(contact), *(self.gap_slope(contact, q) for q in self.free))


@dataclass(frozen=True, eq=False)
class WorkOfContactForgotten(ImpactMistake):
    """The loss is that of the closing motion alone, although contact or constraints move by themselves.

    (1 − e²) of the energy of the closing motion is what somebody sees who moves along with the contact. At rest, the
    work that drives it comes to it or goes.
    """

    id: ClassVar[str] = "work-of-contact-forgotten"
    likely: ClassVar[int] = 2

    def work_of_drift(self, _contact: str) -> sp.Expr:
        return self.zero


@dataclass(frozen=True, eq=False)
class ConstraintImpulseForgotten(ImpactMistake):
    """The contact acts alone, as if no rod, guide or loop answered it.

    Reactions are as large as it takes to keep the constraints; while forces are impulsive, so are they. `is_partial`:
    Λ is right, and the momenta behind it lack what the constraints answer.
    """

    id: ClassVar[str] = "constraint-impulse-forgotten"
    likely: ClassVar[int] = 1
    is_partial: bool = False

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        for one in super().variants(true) if true.conditions else ():
            yield one
            yield replace(one, is_partial=True)

    def effective_mass(self, contact: str) -> sp.Expr:
        return super().effective_mass(contact) if self.is_partial else self.free_mass(contact)

    def constraint_share(self, _contact: str, _condition: Condition) -> sp.Expr:
        return self.zero

    def impact_loss(self, contact: str) -> sp.Expr:
        return self.true.impact_loss(contact) if self.is_partial else super().impact_loss(contact)
