"""The damping has the wrong sign and feeds energy in."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ...mechanics.contributions import DissipationFunction
from ..detour import Detour
from ..road import Road


@dataclass(frozen=True, eq=False)
class DissipationSign(Detour):
    """−∂R/∂q̇ is moved to the left side without changing its sign, or the minus is forgotten."""

    id: ClassVar[str] = "dissipation-sign"
    likely: ClassVar[int] = 1

    @classmethod
    def variants(cls, true: Road) -> Iterator[Self]:
        if any(isinstance(part, DissipationFunction) for part in true.scene.contributions):
            yield cls(true.scene, true)

    def dissipation(self, load: DissipationFunction) -> sp.Expr:
        return -super().dissipation(load)
