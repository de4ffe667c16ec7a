"""The eigenfrequency is upside down: √(m/k) instead of √(k/m)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import sympy as sp

from ..detour import Detour


@dataclass(frozen=True, eq=False)
class FrequencyInverted(Detour):
    """The formula of the period, T = 2π √(m/k), is mixed up with that of the frequency."""

    id: ClassVar[str] = "frequency-inverted"
    likely: ClassVar[int] = 1

    @property
    def frequencies(self) -> tuple[sp.Expr, ...]:
        return tuple(1 / omega for omega in self.true.frequencies)
