"""∂E/∂q is left out of Lagrange's equation."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import sympy as sp

from ..detour import Detour


@dataclass(frozen=True, eq=False)
class EnergySlopeDropped(Detour):
    """The kinetic energy is thought of as depending on rates only, so the second term is not looked at."""

    id: ClassVar[str] = "energy-slope-dropped"
    likely: ClassVar[int] = 1

    def energy_slope(self, _coordinate: str, /) -> sp.Expr:
        return self.zero
