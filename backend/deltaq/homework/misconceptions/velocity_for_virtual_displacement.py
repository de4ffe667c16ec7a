"""The velocity is given where a virtual displacement is asked for."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import sympy as sp

from ...mechanics.contributions import Contribution
from ..detour import Detour


@dataclass(frozen=True, eq=False)
class VelocityForVirtualDisplacement(Detour):
    """The derivative with respect to time has the same shape as the variation, with q̇ in the place of δq."""

    id: ClassVar[str] = "velocity-for-virtual-displacement"
    likely: ClassVar[int] = 2

    def virtual_displacement(self, place: str) -> sp.ImmutableMatrix:
        return self.velocity(place)

    def virtual_work(self, load: Contribution) -> sp.Expr:
        return self.true.virtual_work(load)

    def load_potential(self, load: str) -> sp.Expr:
        return self.true.load_potential(load)
