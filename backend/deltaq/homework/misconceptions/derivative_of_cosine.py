"""The derivative of the cosine is taken as + sin."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar

import sympy as sp

from ...derivation.calculus import column
from .._trigonometry import unsigned_slope
from ..detour import Detour


@dataclass(frozen=True, eq=False)
class DerivativeOfCosine(Detour):
    """The pair sin → cos is remembered as symmetric, and the sign of cos → −sin is lost."""

    id: ClassVar[str] = "derivative-of-cosine"
    likely: ClassVar[int] = 2

    def velocity(self, place: str) -> sp.ImmutableMatrix:
        return column(self._slope(r, self.rate) + r.diff(self.t) for r in self.position(place))

    def virtual_displacement(self, place: str) -> sp.ImmutableMatrix:
        return column(self._slope(r, self.variation) for r in self.position(place))

    def _slope(self, component: sp.Expr, change: Callable[[str], sp.Expr]) -> sp.Expr:
        return sp.Add(*(unsigned_slope(component, self.q(q)) * change(q) for q in self.free))
