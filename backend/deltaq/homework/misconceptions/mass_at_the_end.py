"""The whole mass of a continuum is put at its end."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ...mechanics.bodies import Body
from ...mechanics.kinetics import Distribution
from ..detour import Detour
from ..road import Road


@dataclass(frozen=True, eq=False)
class MassAtTheEnd(Detour):
    """The formula of the pendulum is taken over: m l² instead of the moment of inertia of the rod."""

    id: ClassVar[str] = "mass-at-the-end"
    likely: ClassVar[int] = 2

    @classmethod
    def variants(cls, true: Road) -> Iterator[Self]:
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
