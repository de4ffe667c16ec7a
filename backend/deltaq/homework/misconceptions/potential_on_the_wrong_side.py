"""∂V/∂q stands on the wrong side: the equation has −∂V/∂q on the left."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import sympy as sp

from ..detour import Detour


@dataclass(frozen=True, eq=False)
class PotentialOnTheWrongSide(Detour):
    """From L = E − V the minus is kept, though −∂L/∂q turns it into a plus."""

    id: ClassVar[str] = "potential-on-the-wrong-side"
    likely: ClassVar[int] = 2

    def potential_slope(self, coordinate: str) -> sp.Expr:
        return -super().potential_slope(coordinate)
