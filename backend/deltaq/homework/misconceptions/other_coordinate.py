"""The answer belongs to another coordinate."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ..detour import Detour
from ..road import Road


@dataclass(frozen=True, eq=False)
class OtherCoordinate(Detour):
    """Several equations are derived at once, and one ends up in the field of the other."""

    id: ClassVar[str] = "other-coordinate"
    likely: ClassVar[int] = 1

    @classmethod
    def variants(cls, true: Road) -> Iterator[Self]:
        if len(true.free) > 1:
            yield from (cls(true.scene, true, q) for q in true.free)

    def generalized_force(self, _coordinate: str, /) -> sp.Expr:
        return self.true.generalized_force(self.about)

    def momentum(self, _coordinate: str, /) -> sp.Expr:
        return self.true.momentum(self.about)

    def equation(self, _coordinate: str, /) -> sp.Expr:
        return self.true.equation(self.about)

    def linear_equation(self, _coordinate: str, /) -> sp.Expr:
        return self.true.linear_equation(self.about)
