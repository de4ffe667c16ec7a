"""The terms with squares of rates are missing (centrifugal)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import sympy as sp

from .._rates import without
from ..detour import Detour


@dataclass(frozen=True, eq=False)
class CentrifugalMissing(Detour):
    """They have no counterpart in the equations of motion along a line, where only forces and masses occur."""

    id: ClassVar[str] = "centrifugal-missing"
    likely: ClassVar[int] = 3

    def equation(self, coordinate: str) -> sp.Expr:
        return without(super().equation(coordinate), self, mixed=False)
