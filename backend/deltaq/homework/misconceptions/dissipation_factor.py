"""The ½ of Rayleigh's function is kept: the damping force comes out half as large."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ...mechanics.contributions import DissipationFunction
from ..detour import Detour
from ..road import Road


@dataclass(frozen=True, eq=False)
class DissipationFactor(Detour):
    """R is read off as the force times the rate, or differentiated without the 2 of the square."""

    id: ClassVar[str] = "dissipation-factor"
    likely: ClassVar[int] = 2

    @classmethod
    def variants(cls, true: Road) -> Iterator[Self]:
        if any(isinstance(part, DissipationFunction) for part in true.scene.contributions):
            yield cls(true.scene, true)

    def dissipation(self, load: DissipationFunction) -> sp.Expr:
        return super().dissipation(load) / 2
