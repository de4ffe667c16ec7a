"""In d/dt ∂E/∂q̇ only the rates are differentiated; the factors that move, too, are held constant."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import sympy as sp

from ..detour import Detour


@dataclass(frozen=True, eq=False)
class TotalDerivativePartial(Detour):
    """m r² φ̇ becomes m r² φ̈: the product rule, and with it the term 2 m r ṙ φ̇, is lost."""

    id: ClassVar[str] = "total-derivative-partial"
    likely: ClassVar[int] = 1

    def momentum_rate(self, coordinate: str) -> sp.Expr:
        momentum = self.kinetic_energy.diff(self.rate(coordinate))
        return sp.Add(*(momentum.diff(self.rate(q)) * self.acceleration(q) for q in self.free))
