"""Sine and cosine are swapped in the position."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from .._trigonometry import swapped
from ..detour import Detour
from ..road import Road


@dataclass(frozen=True, eq=False)
class SineCosineSwapped(Detour):
    """Polar coordinates are written down from memory, without looking at the axis from which the angle is counted."""

    id: ClassVar[str] = "sine-cosine-swapped"
    likely: ClassVar[int] = 2

    @classmethod
    def variants(cls, true: Road) -> Iterator[Self]:
        yield from (cls(true.scene, true, q) for q in true.free)

    def position(self, place: str) -> sp.ImmutableMatrix:
        return swapped(super().position(place), self.q(self.about))
