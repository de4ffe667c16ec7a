"""The spring's force is given as its energy: k s instead of k s²/2."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ...mechanics.contributions import PotentialEnergy
from ..detour import Detour
from ..road import Road


@dataclass(frozen=True, eq=False)
class ForceForEnergy(Detour):
    """Force and energy of the spring are both remembered as "k times elongation"."""

    id: ClassVar[str] = "force-for-energy"
    likely: ClassVar[int] = 4

    @classmethod
    def variants(cls, true: Road) -> Iterator[Self]:
        for part in true.scene.contributions:
            if isinstance(part, PotentialEnergy):
                yield cls(true.scene, true, part.source)

    @property
    def potential_energy(self) -> sp.Expr:
        right = self.true.load_potential(self.about)
        moving = [q for q in map(self.q, self.free) if right.has(q)]
        slope = right.diff(moving[0]) if moving else right
        return self.true.potential_energy - right + slope
