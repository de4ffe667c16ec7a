"""A force without potential is given the potential −F · r."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ...mechanics.contributions import PointForce
from ..detour import Detour
from ..road import Road


@dataclass(frozen=True, eq=False)
class FollowerForceAsPotential(Detour):
    """That holds for a constant force. A force that turns along has no potential: differentiating −F · r
    differentiates the force, too.
    """

    id: ClassVar[str] = "follower-force-as-potential"
    likely: ClassVar[int] = 3

    @classmethod
    def variants(cls, true: Road) -> Iterator[Self]:
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
