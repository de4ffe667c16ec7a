"""The generalized force is given together with the δq of its coordinate."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import sympy as sp

from ..detour import Detour


@dataclass(frozen=True, eq=False)
class VirtualWorkForForce(Detour):
    """The coefficient is not separated from what it is the coefficient of: Q δq is taken for Q."""

    id: ClassVar[str] = "virtual-work-for-force"
    likely: ClassVar[int] = 1

    def generalized_force(self, coordinate: str) -> sp.Expr:
        return self.true.generalized_force(coordinate) * self.variation(coordinate)
