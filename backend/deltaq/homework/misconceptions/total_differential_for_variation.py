"""The total differential dr is given for δr, with dq and with dt."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ..detour import Detour
from ..road import Road


@dataclass(frozen=True, eq=False)
class TotalDifferentialForVariation(Detour):
    """The formula of the total differential is known from calculus and is applied as it stands."""

    id: ClassVar[str] = "total-differential-for-variation"
    likely: ClassVar[int] = 1

    @classmethod
    def variants(cls, true: Road) -> Iterator[Self]:
        if true.depends_on_time:
            yield cls(true.scene, true)

    def virtual_displacement(self, place: str) -> sp.ImmutableMatrix:
        changed = {self.variation(q): self.symbols.differential(q) for q in self.free}
        right = super().virtual_displacement(place).xreplace(changed)
        return right + self.position(place).diff(self.t) * self.symbols.differential("t")
