"""The force of a potential or spring is taken as +∂V/∂q."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ...mechanics.contributions import Contribution, PotentialEnergy
from ..detour import Detour
from ..road import Road


@dataclass(frozen=True, eq=False)
class PotentialForceSign(Detour):
    """The minus sign of F = −grad V is forgotten when the force is read off the potential."""

    id: ClassVar[str] = "potential-force-sign"
    likely: ClassVar[int] = 2

    @classmethod
    def variants(cls, true: Road) -> Iterator[Self]:
        for part in true.scene.contributions:
            if isinstance(part, PotentialEnergy):
                yield cls(true.scene, true, part.source)

    def virtual_work(self, load: Contribution) -> sp.Expr:
        right = super().virtual_work(load)
        return -right if load.source == self.about else right

    def load_potential(self, load: str) -> sp.Expr:
        return self.true.load_potential(load)

    def potential_slope(self, coordinate: str) -> sp.Expr:
        own = self.true.load_potential(self.about).diff(self.q(coordinate))
        return self.true.potential_slope(coordinate) - 2 * own
