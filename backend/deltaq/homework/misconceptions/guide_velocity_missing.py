"""The velocity of the guided base is left out: v = ∂r/∂q q̇ without ∂r/∂t."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ..detour import Detour
from ..road import Road


@dataclass(frozen=True, eq=False)
class GuideVelocityMissing(Detour):
    """The guide is not a coordinate, so it is forgotten that it moves the body all the same."""

    id: ClassVar[str] = "guide-velocity-missing"
    likely: ClassVar[int] = 1

    @classmethod
    def variants(cls, true: Road) -> Iterator[Self]:
        if true.depends_on_time:
            yield cls(true.scene, true)

    def velocity(self, place: str) -> sp.ImmutableMatrix:
        return super().velocity(place) - self.position(place).diff(self.t)
