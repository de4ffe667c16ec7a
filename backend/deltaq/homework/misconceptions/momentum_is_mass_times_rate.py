"""The generalized momentum is taken as inertia times its own rate."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import sympy as sp

from ..detour import Detour


@dataclass(frozen=True, eq=False)
class MomentumIsMassTimesRate(Detour):
    """p = m v holds for one particle along a line; coupled coordinates bring the rates of the others in."""

    id: ClassVar[str] = "momentum-is-mass-times-rate"
    likely: ClassVar[int] = 2

    def momentum(self, coordinate: str) -> sp.Expr:
        rate = self.rate(coordinate)
        return self.true.momentum(coordinate).diff(rate) * rate
