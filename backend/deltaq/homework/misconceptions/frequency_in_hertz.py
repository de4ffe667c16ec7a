"""The frequency f = ω/2π is given where the circular frequency is asked for."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import sympy as sp

from ..detour import Detour


@dataclass(frozen=True, eq=False)
class FrequencyInHertz(Detour):
    """Both are called frequency in everyday language."""

    id: ClassVar[str] = "frequency-in-hertz"
    likely: ClassVar[int] = 1

    @property
    def frequencies(self) -> tuple[sp.Expr, ...]:
        return tuple(omega / (2 * sp.pi) for omega in self.true.frequencies)
