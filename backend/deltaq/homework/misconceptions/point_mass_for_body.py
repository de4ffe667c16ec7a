"""A rod or disc is treated as a point mass at its centre."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ...derivation.calculus import column
from ...mechanics.bodies import Body
from ...mechanics.kinetics import Distribution, Translation
from ..detour import Detour
from ..road import Road


@dataclass(frozen=True, eq=False)
class PointMassForBody(Detour):
    """E = m v²/2 of the centre of mass is known from particles; the energy of the rotation about it is forgotten."""

    id: ClassVar[str] = "point-mass-for-body"
    likely: ClassVar[int] = 1

    @classmethod
    def variants(cls, true: Road) -> Iterator[Self]:
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
