"""The acceleration of the guided base is left out: d/dt does not reach the explicit time in ∂E/∂q̇."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ..detour import Detour
from ..road import Road


@dataclass(frozen=True, eq=False)
class GuideAccelerationMissing(Detour):
    """The momentum is differentiated by coordinates and rates alone."""

    id: ClassVar[str] = "guide-acceleration-missing"
    likely: ClassVar[int] = 1

    @classmethod
    def variants(cls, true: Road) -> Iterator[Self]:
        if true.depends_on_time:
            yield cls(true.scene, true)

    def momentum_rate(self, coordinate: str) -> sp.Expr:
        momentum = self.kinetic_energy.diff(self.rate(coordinate))
        return super().momentum_rate(coordinate) - momentum.diff(self.t)
