"""Sine and cosine are swapped in the components of a force."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ...mechanics.contributions import DistributedForce, PointForce
from .._trigonometry import swapped
from ..detour import Detour
from ..road import Road


@dataclass(frozen=True, eq=False)
class ForceComponentsSwapped(Detour):
    """The force is resolved along the wrong axis: its direction is read off the rod instead of the normal of
    the rod.
    """

    id: ClassVar[str] = "force-components-swapped"
    likely: ClassVar[int] = 3

    @classmethod
    def variants(cls, true: Road) -> Iterator[Self]:
        for part in true.scene.contributions:
            if isinstance(part, PointForce) and any(node.has(sp.sin, sp.cos) for node in true.force(part)):
                yield cls(true.scene, true, part.source)

    def force(self, load: PointForce | DistributedForce) -> sp.ImmutableMatrix:
        right = super().force(load)
        for q in self.free if load.source == self.about else ():
            right = swapped(right, self.q(q))
        return right
