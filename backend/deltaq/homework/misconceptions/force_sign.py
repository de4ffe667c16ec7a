"""A force or moment counts with the wrong sign."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ...mechanics.contributions import Contribution
from ..detour import Detour
from ..road import Road


@dataclass(frozen=True, eq=False)
class ForceSign(Detour):
    """Work is taken as negative where force and displacement point the same way, often from a reaction force in
    mind.
    """

    id: ClassVar[str] = "force-sign"
    likely: ClassVar[int] = 2

    @classmethod
    def variants(cls, true: Road) -> Iterator[Self]:
        for load in true.scene.loads:
            if load.kind in ("force", "moment", "distributed"):
                yield cls(true.scene, true, load.name)

    def virtual_work(self, load: Contribution) -> sp.Expr:
        right = super().virtual_work(load)
        return -right if load.source == self.about else right
