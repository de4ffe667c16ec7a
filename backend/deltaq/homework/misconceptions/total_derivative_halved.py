"""The terms from differentiating a moving factor come out half as large as they are."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import sympy as sp

from ..detour import Detour


@dataclass(frozen=True, eq=False)
class TotalDerivativeHalved(Detour):
    """d/dt r² is taken as r ṙ: the 2 of the inner square is lost."""

    id: ClassVar[str] = "total-derivative-halved"
    likely: ClassVar[int] = 2

    def momentum_rate(self, coordinate: str) -> sp.Expr:
        momentum = self.kinetic_energy.diff(self.rate(coordinate))
        rates = sp.Add(*(momentum.diff(self.rate(q)) * self.acceleration(q) for q in self.free))
        return (rates + super().momentum_rate(coordinate)) / 2
