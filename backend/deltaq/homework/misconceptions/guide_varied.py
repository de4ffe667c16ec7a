"""A guided coordinate is varied."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ...mechanics.contributions import Contribution, PointForce
from ..detour import Detour
from ..road import Road


@dataclass(frozen=True, eq=False)
class GuideVaried(Detour):
    """Its motion is given, so it has no virtual displacement of its own: δy = 0."""

    id: ClassVar[str] = "guide-varied"
    likely: ClassVar[int] = 1

    @classmethod
    def variants(cls, true: Road) -> Iterator[Self]:
        yield from (cls(true.scene, true, guide.coordinate) for guide in true.scene.guides)

    def virtual_displacement(self, place: str) -> sp.ImmutableMatrix:
        free = self.vector(self.trees(place)).diff(self.q(self.about))
        return super().virtual_displacement(place) + self.guided(free) * self.variation(self.about)

    def virtual_work(self, load: Contribution) -> sp.Expr:
        right = self.true.virtual_work(load)
        if not isinstance(load, PointForce):
            return right
        return self.dot(self.force(load), self.virtual_displacement(load.place))
