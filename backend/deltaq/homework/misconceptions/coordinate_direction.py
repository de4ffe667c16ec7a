"""A coordinate is counted in the opposite direction."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ..detour import Detour
from ..road import Road


@dataclass(frozen=True, eq=False)
class CoordinateDirection(Detour):
    """The arrow of the coordinate in the drawing is not looked at: the angle is turned the other way, the length
    measured the other way.
    """

    id: ClassVar[str] = "coordinate-direction"
    likely: ClassVar[int] = 3

    @classmethod
    def variants(cls, true: Road) -> Iterator[Self]:
        yield from (cls(true.scene, true, q) for q in true.free)

    def position(self, place: str) -> sp.ImmutableMatrix:
        q = self.q(self.about)
        return super().position(place).xreplace({q: -q})
