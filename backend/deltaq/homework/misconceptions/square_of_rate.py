"""The rate is not squared in the kinetic energy."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ..detour import Detour
from ..road import Road


@dataclass(frozen=True, eq=False)
class SquareOfRate(Detour):
    """v² is written as l² φ̇: the square is carried to the length only."""

    id: ClassVar[str] = "square-of-rate"
    likely: ClassVar[int] = 2

    @classmethod
    def variants(cls, true: Road) -> Iterator[Self]:
        yield from (cls(true.scene, true, q) for q in true.free)

    @property
    def kinetic_energy(self) -> sp.Expr:
        rate = self.rate(self.about)
        return self.true.kinetic_energy.expand().xreplace({rate**2: rate})
