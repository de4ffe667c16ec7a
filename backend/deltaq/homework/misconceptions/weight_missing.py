"""The weight of one of several bodies has been left out."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ...mechanics.contributions import DistributedForce, PointForce
from ..detour import Detour
from ..road import Road


@dataclass(frozen=True, eq=False)
class WeightMissing(Detour):
    """Gravity acts on every mass, but only the weight of the lowest or the largest body is written down."""

    id: ClassVar[str] = "weight-missing"
    likely: ClassVar[int] = 2

    @classmethod
    def variants(cls, true: Road) -> Iterator[Self]:
        parts = [part for part in true.scene.contributions if isinstance(part, PointForce)]
        for part in parts:
            if sum(other.source == part.source for other in parts) > 1:
                yield cls(true.scene, true, f"{part.source}:{part.place}")

    def force(self, load: PointForce | DistributedForce) -> sp.ImmutableMatrix:
        right = super().force(load)
        return 0 * right if self.about == f"{load.source}:{load.place}" else right
