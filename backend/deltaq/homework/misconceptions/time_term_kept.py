"""dr is taken for δr: the term ∂r/∂t dt is kept."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ..detour import Detour
from ..road import Road


@dataclass(frozen=True, eq=False)
class TimeTermKept(Detour):
    """A virtual displacement happens at a frozen time; whoever takes the total differential moves the guide along."""

    id: ClassVar[str] = "time-term-kept"
    likely: ClassVar[int] = 1

    @classmethod
    def variants(cls, true: Road) -> Iterator[Self]:
        if true.depends_on_time:
            yield cls(true.scene, true)

    def virtual_displacement(self, place: str) -> sp.ImmutableMatrix:
        kept = self.position(place).diff(self.t) * self.symbols.differential("t")
        return super().virtual_displacement(place) + kept
