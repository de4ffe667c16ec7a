"""The eigenfrequency is given without the square root."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import sympy as sp

from ..detour import Detour


@dataclass(frozen=True, eq=False)
class FrequencyWithoutRoot(Detour):
    """k/m is what stands in the equation, and it is ω², not ω."""

    id: ClassVar[str] = "frequency-without-root"
    likely: ClassVar[int] = 1

    @property
    def frequencies(self) -> tuple[sp.Expr, ...]:
        return tuple(omega**2 for omega in self.true.frequencies)
