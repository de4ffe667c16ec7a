"""The conservative forces count twice: in the Lagrange function and again as generalized forces."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import sympy as sp

from ..detour import Detour


@dataclass(frozen=True, eq=False)
class PotentialCountedTwice(Detour):
    """V goes into L, and the weight is still listed among the forces on the right side."""

    id: ClassVar[str] = "potential-counted-twice"
    likely: ClassVar[int] = 1

    def potential_slope(self, coordinate: str) -> sp.Expr:
        return 2 * super().potential_slope(coordinate)
