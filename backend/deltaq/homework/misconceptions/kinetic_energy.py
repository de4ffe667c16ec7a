"""Mistakes in the kinetic energy E = ½ ∫ v·v dm of particles, rigid bodies and continua."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ...derivation.calculus import column
from ...mechanics.bodies import Body
from ...mechanics.kinetics import Distribution, Rotation, Translation
from ...vocabulary import SlipKind
from ..faulty_solution import FaultySolution
from ..solution import Solution

OF_THE_ENERGY = frozenset({"kinetic-energy", "lagrangian", "conserved"})
OF_THE_RATES = OF_THE_ENERGY | {"momentum"}


@dataclass(frozen=True, eq=False)
class HalfInKineticEnergy(FaultySolution):
    """The ½ of the kinetic energy is missing: E = m v².

    The product m v·v is remembered, the half that comes from integrating m v dv is not.
    """

    id: ClassVar[str] = "half-in-kinetic-energy"
    likely: ClassVar[int] = 1
    evident: ClassVar[frozenset[str] | None] = OF_THE_ENERGY
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"double"})

    def kinetic_energy_of(self, body: Body) -> sp.Expr:
        return 2 * super().kinetic_energy_of(body)


@dataclass(frozen=True, eq=False)
class HalfOfOneBody(FaultySolution):
    """The ½ is missing in the kinetic energy of one body.

    With several bodies the factor is written for the first and lost for the next.
    """

    id: ClassVar[str] = "half-of-one-body"
    likely: ClassVar[int] = 3
    evident: ClassVar[frozenset[str] | None] = OF_THE_ENERGY
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"double"})

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        if len(true.scene.bodies) > 1:
            yield from (cls(true.scene, true, body.name) for body in true.scene.bodies)

    def kinetic_energy_of(self, body: Body) -> sp.Expr:
        right = super().kinetic_energy_of(body)
        return 2 * right if body.name == self.about else right


@dataclass(frozen=True, eq=False)
class BodyMissing(FaultySolution):
    """One body has been left out of the kinetic energy.

    The drawing draws the eye to the body that swings; the one that carries it is overlooked.
    """

    id: ClassVar[str] = "body-missing"
    likely: ClassVar[int] = 1
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"missing"})

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        if len(true.scene.bodies) > 1:
            yield from (cls(true.scene, true, body.name) for body in true.scene.bodies)

    def kinetic_energy_of(self, body: Body) -> sp.Expr:
        return self.zero if body.name == self.about else super().kinetic_energy_of(body)


@dataclass(frozen=True, eq=False)
class MixedTermMissing(FaultySolution):
    """The mixed term of v² is missing: (a + b)² = a² + b².

    Velocities are squared one by one, as if they were at right angles.
    """

    id: ClassVar[str] = "mixed-term-missing"
    likely: ClassVar[int] = 1
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"missing"})

    def kinetic_energy_of(self, body: Body) -> sp.Expr:
        return _scaled_mixed(super().kinetic_energy_of(body), self, sp.Integer(0))


@dataclass(frozen=True, eq=False)
class MixedTermHalved(FaultySolution):
    """The mixed term of v² is half as large as it is: (a + b)² = a² + ab + b².

    The binomial formula is written from memory, and the 2 is lost.
    """

    id: ClassVar[str] = "mixed-term-halved"
    likely: ClassVar[int] = 2
    evident: ClassVar[frozenset[str] | None] = OF_THE_ENERGY
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"half"})

    def kinetic_energy_of(self, body: Body) -> sp.Expr:
        return _scaled_mixed(super().kinetic_energy_of(body), self, sp.Rational(1, 2))


@dataclass(frozen=True, eq=False)
class SquareOfLength(FaultySolution):
    """A length is not squared in the kinetic energy.

    In v = l φ̇ only the rate is squared: E = m l φ̇²/2.
    """

    id: ClassVar[str] = "square-of-length"
    likely: ClassVar[int] = 2
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"power", "factor-missing"})
    evident: ClassVar[frozenset[str] | None] = OF_THE_RATES

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        units = {p.name: p.unit for p in true.scene.parameters} | {c.name: c.unit for c in true.scene.free}
        for name, unit in units.items():
            if unit == "m" and true.kinetic_energy.expand().has(true.q(name) ** 2):
                yield cls(true.scene, true, name)

    @property
    def kinetic_energy(self) -> sp.Expr:
        length = self.q(self.about)
        return self.true.kinetic_energy.expand().xreplace({length**2: length})


@dataclass(frozen=True, eq=False)
class SquareOfRate(FaultySolution):
    """The rate is not squared in the kinetic energy.

    v² is written as l² φ̇: the square is carried to the length only.
    """

    id: ClassVar[str] = "square-of-rate"
    likely: ClassVar[int] = 2
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"power", "factor-missing"})
    evident: ClassVar[frozenset[str] | None] = OF_THE_RATES

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        yield from (cls(true.scene, true, q) for q in true.free)

    @property
    def kinetic_energy(self) -> sp.Expr:
        rate = self.rate(self.about)
        return self.true.kinetic_energy.expand().xreplace({rate**2: rate})


@dataclass(frozen=True, eq=False)
class RatesForCoordinates(FaultySolution):
    """A coordinate is written where its rate belongs: the dots are missing.

    The kinetic energy is copied from the potential, or the dot is lost in writing.
    """

    id: ClassVar[str] = "rates-for-coordinates"
    likely: ClassVar[int] = 3
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"rate"})

    @property
    def kinetic_energy(self) -> sp.Expr:
        return self.true.kinetic_energy.xreplace({self.rate(q): self.q(q) for q in self.free})


@dataclass(frozen=True, eq=False)
class MassAtTheEnd(FaultySolution):
    """The whole mass of a continuum is put at its end.

    The formula of the pendulum is taken over: m l² instead of the moment of inertia of the rod.
    """

    id: ClassVar[str] = "mass-at-the-end"
    likely: ClassVar[int] = 2

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        for body in true.scene.bodies:
            if body.material:
                yield cls(true.scene, true, body.name)

    def kinetic_energy_of(self, body: Body) -> sp.Expr:
        if body.name != self.about:
            return super().kinetic_energy_of(body)
        (part,) = (part for part in body.kinetics if isinstance(part, Distribution))
        mass = self.integrated(self.expression(part.density), part.material, body.name)
        ends = {bounds.symbol: bounds.upper for bounds in self.bounds(part.material)}
        v = self.velocity(body.name).xreplace(ends)
        return mass * self.dot(v, v) / 2


@dataclass(frozen=True, eq=False)
class PointMassForBody(FaultySolution):
    """A rod or disc is treated as a point mass at its centre.

    E = m v²/2 of the centre of mass is known from particles; the energy of the rotation about it is forgotten.
    """

    id: ClassVar[str] = "point-mass-for-body"
    likely: ClassVar[int] = 1

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        for body in true.scene.bodies:
            if any(not isinstance(part, Translation) for part in body.kinetics):
                yield cls(true.scene, true, body.name)

    def kinetic_energy_of(self, body: Body) -> sp.Expr:
        if body.name != self.about:
            return super().kinetic_energy_of(body)
        if not body.material:
            (mass,) = (part.mass for part in body.kinetics if isinstance(part, Translation))
            v = self.velocity(body.name)
            return self.expression(mass) * self.dot(v, v) / 2
        (part,) = (part for part in body.kinetics if isinstance(part, Distribution))
        density = self.expression(part.density)
        mass = self.integrated(density, part.material, body.name)
        moments = (self.integrated(density * r, part.material, body.name) for r in self.position(body.name))
        centre = column(moment / mass for moment in moments)
        v = column(map(self.time_derivative, centre))
        return mass * self.dot(v, v) / 2


@dataclass(frozen=True, eq=False)
class TranslationMissing(FaultySolution):
    """Only the rotation of a rigid body is counted, not the motion of its centre of mass.

    J ω²/2 looks complete for a body that turns.
    """

    id: ClassVar[str] = "translation-missing"
    likely: ClassVar[int] = 2
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"missing", "factor"})

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        for body in true.scene.bodies:
            if any(isinstance(part, Rotation) for part in body.kinetics):
                yield cls(true.scene, true, body.name)

    def kinetic_energy_of(self, body: Body) -> sp.Expr:
        right = super().kinetic_energy_of(body)
        if body.name != self.about:
            return right
        (mass,) = (part.mass for part in body.kinetics if isinstance(part, Translation))
        v = self.velocity(body.name)
        return right - self.expression(mass) * self.dot(v, v) / 2


def _scaled_mixed(energy: sp.Expr, solution: Solution, factor: sp.Expr) -> sp.Expr:
    """The energy with its products of different rates (and of a rate with a guide's speed) times a factor."""
    terms = sp.Add.make_args(energy.expand())
    return sp.Add(*(t * factor if _is_mixed(t, solution) else t for t in terms))


def _is_mixed(term: sp.Expr, solution: Solution) -> bool:
    degrees = [d for d in degrees_in_rates(term, solution) if d]
    return degrees == [1, 1] or (degrees == [1] and term.has(solution.t))


def degrees_in_rates(term: sp.Expr, solution: Solution) -> list[int]:
    """The powers of the rates in a term, in order."""
    powers = term.as_powers_dict()
    found = (powers.get(solution.rate(q), 0) for q in solution.free)
    return sorted(int(power) for power in found if power == int(power))
