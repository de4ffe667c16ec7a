"""The inner derivative is missing: d/dt sin φ = cos φ, δ(sin φ) = cos φ."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar

import sympy as sp

from ...derivation.calculus import column
from ...mechanics.contributions import Contribution
from ..detour import Detour


@dataclass(frozen=True, eq=False)
class ChainRuleFactor(Detour):
    """The function is differentiated by its argument, and that the argument itself moves is forgotten."""

    id: ClassVar[str] = "chain-rule-factor"
    likely: ClassVar[int] = 2

    def velocity(self, place: str) -> sp.ImmutableMatrix:
        return column(self._without_inner(r, self.rate) for r in self.position(place))

    def virtual_displacement(self, place: str) -> sp.ImmutableMatrix:
        return column(self._without_inner(r, self.variation) for r in self.position(place))

    def virtual_work(self, load: Contribution) -> sp.Expr:
        return self.true.virtual_work(load)

    def load_potential(self, load: str) -> sp.Expr:
        return self.true.load_potential(load)

    def _without_inner(self, component: sp.Expr, change: Callable[[str], sp.Expr]) -> sp.Expr:
        slopes = {q: component.diff(self.q(q)) for q in self.free}
        return sp.Add(*(s * (1 if s.has(self.q(q)) else change(q)) for q, s in slopes.items()))
