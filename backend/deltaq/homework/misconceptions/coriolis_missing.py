"""The terms with products of two different rates are missing (Coriolis)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from .._rates import without
from ..detour import Detour
from ..road import Road


@dataclass(frozen=True, eq=False)
class CoriolisMissing(Detour):
    """They come from the product rule and from mixed terms of v², and both are easily passed over."""

    id: ClassVar[str] = "coriolis-missing"
    likely: ClassVar[int] = 3

    @classmethod
    def variants(cls, true: Road) -> Iterator[Self]:
        if len(true.free) > 1:
            yield cls(true.scene, true)

    def equation(self, coordinate: str) -> sp.Expr:
        return without(super().equation(coordinate), self, mixed=True)
