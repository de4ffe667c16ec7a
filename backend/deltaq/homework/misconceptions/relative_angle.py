"""An absolute angle is taken as an angle relative to the body before, so that angles add up."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar, Self

import sympy as sp

from ..detour import Detour
from ..road import Road


@dataclass(frozen=True, eq=False)
class RelativeAngle(Detour):
    """The drawing counts each angle from the vertical; joints suggest counting from the previous link."""

    id: ClassVar[str] = "relative-angle"
    likely: ClassVar[int] = 3

    @classmethod
    def variants(cls, true: Road) -> Iterator[Self]:
        angles = [c.name for c in true.scene.free if c.unit in ("rad", "deg")]
        yield from (cls(true.scene, true, f"{one}/{other}") for one, other in pairwise(angles))

    def position(self, place: str) -> sp.ImmutableMatrix:
        first, second = map(self.q, self.about.split("/"))
        return super().position(place).xreplace({second: first + second})
