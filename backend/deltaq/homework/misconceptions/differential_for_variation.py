"""dq is written where δq is meant."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import sympy as sp

from ...mechanics.contributions import Contribution
from ..detour import Detour


@dataclass(frozen=True, eq=False)
class DifferentialForVariation(Detour):
    """Both are small, and the difference (one follows the motion, the other is thought of at a frozen time) is not yet
    felt.
    """

    id: ClassVar[str] = "differential-for-variation"
    likely: ClassVar[int] = 1

    def virtual_displacement(self, place: str) -> sp.ImmutableMatrix:
        return super().virtual_displacement(place).xreplace(self._differentials)

    def virtual_work(self, load: Contribution) -> sp.Expr:
        return self.true.virtual_work(load).xreplace(self._differentials)

    def load_force(self, load: str, coordinate: str) -> sp.Expr:
        return self.true.load_force(load, coordinate)

    def load_potential(self, load: str) -> sp.Expr:
        return self.true.load_potential(load)

    def generalized_force(self, coordinate: str) -> sp.Expr:
        return self.true.generalized_force(coordinate)

    @property
    def _differentials(self) -> dict[sp.Symbol, sp.Symbol]:
        return {self.variation(q): self.symbols.differential(q) for q in self.free}
