"""The period T = 2π/ω is given where the circular frequency is asked for."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import sympy as sp

from ..detour import Detour


@dataclass(frozen=True, eq=False)
class PeriodForFrequency(Detour):
    """The period is what one can see and count."""

    id: ClassVar[str] = "period-for-frequency"
    likely: ClassVar[int] = 1

    @property
    def frequencies(self) -> tuple[sp.Expr, ...]:
        return tuple(2 * sp.pi / omega for omega in self.true.frequencies)
