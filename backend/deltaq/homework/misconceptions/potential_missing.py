"""The conservative forces are missing in the equation."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import sympy as sp

from ..detour import Detour


@dataclass(frozen=True, eq=False)
class PotentialMissing(Detour):
    """Lagrange's equation is written with E instead of L, and without generalized forces."""

    id: ClassVar[str] = "potential-missing"
    likely: ClassVar[int] = 2

    def potential_slope(self, _coordinate: str, /) -> sp.Expr:
        return self.zero
