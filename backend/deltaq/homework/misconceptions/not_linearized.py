"""The full equation is given where the linearized one is asked for."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import sympy as sp

from ..detour import Detour


@dataclass(frozen=True, eq=False)
class NotLinearized(Detour):
    """The last step, sin φ ≈ φ and products of small quantities dropped, has not been taken."""

    id: ClassVar[str] = "not-linearized"
    likely: ClassVar[int] = 1

    def linear_equation(self, coordinate: str) -> sp.Expr:
        return self.equation(coordinate)
