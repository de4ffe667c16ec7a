"""One load has been left out."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ...mechanics.contributions import Contribution
from ..detour import Detour
from ..road import Road


@dataclass(frozen=True, eq=False)
class LoadMissing(Detour):
    """The loads are not listed before the work is written down, and the spring or the damper is forgotten."""

    id: ClassVar[str] = "load-missing"
    likely: ClassVar[int] = 1

    @classmethod
    def variants(cls, true: Road) -> Iterator[Self]:
        yield from (cls(true.scene, true, load) for load in true.load_names)

    def virtual_work(self, load: Contribution) -> sp.Expr:
        return self.zero if load.source == self.about else super().virtual_work(load)

    def load_potential(self, load: str) -> sp.Expr:
        return self.zero if load == self.about else super().load_potential(load)
