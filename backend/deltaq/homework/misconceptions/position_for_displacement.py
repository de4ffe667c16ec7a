"""The work is taken with the position instead of its variation: δW = F · r."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import sympy as sp

from ...mechanics.contributions import Contribution, PointForce
from ..detour import Detour


@dataclass(frozen=True, eq=False)
class PositionForDisplacement(Detour):
    """Force times way is remembered, and the way is taken from the origin."""

    id: ClassVar[str] = "position-for-displacement"
    likely: ClassVar[int] = 4

    def virtual_work(self, load: Contribution) -> sp.Expr:
        right = super().virtual_work(load)
        if not isinstance(load, PointForce):
            return right
        work = self.dot(self.force(load), self.position(load.place))
        return sp.Add(*(work * self.variation(q) for q in self.free)) if len(self.free) == 1 else right

    def load_potential(self, load: str) -> sp.Expr:
        return self.true.load_potential(load)
