"""The ½ of the energy of a spring or potential is missing: V = k s²."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ...mechanics.contributions import PotentialEnergy
from ..detour import Detour
from ..road import Road


@dataclass(frozen=True, eq=False)
class HalfInSpringEnergy(Detour):
    """Force times way is taken for the work, though the force grows along the way."""

    id: ClassVar[str] = "half-in-spring-energy"
    likely: ClassVar[int] = 1

    @classmethod
    def variants(cls, true: Road) -> Iterator[Self]:
        for part in true.scene.contributions:
            if isinstance(part, PotentialEnergy):
                yield cls(true.scene, true, part.source)

    def energy(self, load: PotentialEnergy) -> sp.Expr:
        right = super().energy(load)
        return 2 * right if load.source == self.about else right
