"""The partial derivatives are given without the δq they are multiplied by."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import sympy as sp

from ...mechanics.contributions import Contribution
from ..detour import Detour


@dataclass(frozen=True, eq=False)
class VariationMissing(Detour):
    """∂r/∂q is taken for δr: the variation is understood as a derivative, and what it is multiplied by gets lost."""

    id: ClassVar[str] = "variation-missing"
    likely: ClassVar[int] = 1

    def virtual_displacement(self, place: str) -> sp.ImmutableMatrix:
        return self.true.virtual_displacement(place).xreplace(self._ones)

    def virtual_work(self, load: Contribution) -> sp.Expr:
        return self.true.virtual_work(load).xreplace(self._ones)

    def load_force(self, load: str, coordinate: str) -> sp.Expr:
        return self.true.load_force(load, coordinate)

    def load_potential(self, load: str) -> sp.Expr:
        return self.true.load_potential(load)

    def generalized_force(self, coordinate: str) -> sp.Expr:
        return self.true.generalized_force(coordinate)

    @property
    def _ones(self) -> dict[sp.Symbol, sp.Expr]:
        return {self.variation(q): sp.Integer(1) for q in self.free}
