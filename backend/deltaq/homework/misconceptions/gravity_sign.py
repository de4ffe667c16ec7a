"""The weight points the wrong way."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ...mechanics.contributions import DistributedForce, PointForce
from ..detour import Detour
from ..road import Road


@dataclass(frozen=True, eq=False)
class GravitySign(Detour):
    """The axis points down, and the habit of writing −g stays (or the other way round)."""

    id: ClassVar[str] = "gravity-sign"
    likely: ClassVar[int] = 1

    @classmethod
    def variants(cls, true: Road) -> Iterator[Self]:
        for load in true.scene.loads:
            if load.kind == "gravity":
                yield cls(true.scene, true, load.name)

    def force(self, load: PointForce | DistributedForce) -> sp.ImmutableMatrix:
        right = super().force(load)
        return -right if load.source == self.about else right
