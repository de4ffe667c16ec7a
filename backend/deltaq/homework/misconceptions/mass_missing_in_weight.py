"""The weight is written as g instead of m g."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ...mechanics.contributions import DistributedForce, PointForce
from ..detour import Detour
from ..road import Road


@dataclass(frozen=True, eq=False)
class MassMissingInWeight(Detour):
    """The acceleration is taken for the force."""

    id: ClassVar[str] = "mass-missing-in-weight"
    likely: ClassVar[int] = 3

    @classmethod
    def variants(cls, true: Road) -> Iterator[Self]:
        for load in true.scene.loads:
            if load.kind == "gravity":
                yield cls(true.scene, true, load.name)

    def force(self, load: PointForce | DistributedForce) -> sp.ImmutableMatrix:
        right = super().force(load)
        body = next((b for b in self.scene.bodies if b.name == load.place and not b.material), None)
        return right / self.mass(body) if body is not None and load.source == self.about else right
