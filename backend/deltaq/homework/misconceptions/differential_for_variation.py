"""dq is written where δq is meant."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import sympy as sp

from ..respelling import Respelling


@dataclass(frozen=True, eq=False)
class DifferentialForVariation(Respelling):
    """Both are small, and the difference (one follows the motion, the other is thought of at a frozen time) is not yet
    felt.
    """

    id: ClassVar[str] = "differential-for-variation"
    likely: ClassVar[int] = 1

    @property
    def written(self) -> dict[sp.Symbol, sp.Expr]:
        return {self.variation(q): self.symbols.differential(q) for q in self.free}
