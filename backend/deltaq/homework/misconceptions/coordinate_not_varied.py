"""One degree of freedom has not been varied."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ..detour import Detour
from ..road import Road


@dataclass(frozen=True, eq=False)
class CoordinateNotVaried(Detour):
    """The coordinate that moves the base is treated as given, though nothing prescribes it."""

    id: ClassVar[str] = "coordinate-not-varied"
    likely: ClassVar[int] = 2

    @classmethod
    def variants(cls, true: Road) -> Iterator[Self]:
        if len(true.free) > 1:
            yield from (cls(true.scene, true, q) for q in true.free)

    def virtual_displacement(self, place: str) -> sp.ImmutableMatrix:
        return super().virtual_displacement(place).xreplace({self.variation(self.about): self.zero})

    def load_potential(self, load: str) -> sp.Expr:
        return self.true.load_potential(load)
