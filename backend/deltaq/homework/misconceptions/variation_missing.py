"""The partial derivatives are given without the δq they are multiplied by."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import sympy as sp

from ..respelling import Respelling


@dataclass(frozen=True, eq=False)
class VariationMissing(Respelling):
    """∂r/∂q is taken for δr: the variation is understood as a derivative, and what it is multiplied by gets lost."""

    id: ClassVar[str] = "variation-missing"
    likely: ClassVar[int] = 1

    @property
    def written(self) -> dict[sp.Symbol, sp.Expr]:
        return {self.variation(q): sp.Integer(1) for q in self.free}
