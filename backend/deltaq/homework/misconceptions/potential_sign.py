"""The potential energy has the wrong sign."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import sympy as sp

from ..detour import Detour


@dataclass(frozen=True, eq=False)
class PotentialSign(Detour):
    """With the axis pointing down, height is not the coordinate: V = −m g y, though m g h is what one remembers."""

    id: ClassVar[str] = "potential-sign"
    likely: ClassVar[int] = 2

    @property
    def potential_energy(self) -> sp.Expr:
        return -self.true.potential_energy
