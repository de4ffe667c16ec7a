"""∂E/∂q is added instead of subtracted."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import sympy as sp

from ..detour import Detour


@dataclass(frozen=True, eq=False)
class EnergySlopeSign(Detour):
    """The signs of d/dt ∂E/∂q̇ − ∂E/∂q are remembered as two plus signs."""

    id: ClassVar[str] = "energy-slope-sign"
    likely: ClassVar[int] = 2

    def energy_slope(self, coordinate: str) -> sp.Expr:
        return -super().energy_slope(coordinate)
