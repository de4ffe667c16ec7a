"""The velocity of the moving base is left out."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ...mechanics.bodies import Body
from ..detour import Detour
from ..road import Road


@dataclass(frozen=True, eq=False)
class BaseVelocityMissing(Detour):
    """The body is seen from the pivot: its velocity relative to the pivot is taken for its velocity."""

    id: ClassVar[str] = "base-velocity-missing"
    likely: ClassVar[int] = 2

    @classmethod
    def variants(cls, true: Road) -> Iterator[Self]:
        if len(true.free) > 1:
            yield from (cls(true.scene, true, q) for q in true.free)

    def velocity(self, place: str) -> sp.ImmutableMatrix:
        return super().velocity(place).xreplace({self.rate(self.about): self.zero})

    def kinetic_energy_of(self, body: Body) -> sp.Expr:
        relative = len(self.coordinates_of(body.name)) > 1 if not body.material else True
        return super().kinetic_energy_of(body) if relative else self.true.kinetic_energy_of(body)
