"""A coordinate is written where its rate belongs: the dots are missing."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import sympy as sp

from ..detour import Detour


@dataclass(frozen=True, eq=False)
class RatesForCoordinates(Detour):
    """The kinetic energy is copied from the potential, or the dot is lost in writing."""

    id: ClassVar[str] = "rates-for-coordinates"
    likely: ClassVar[int] = 3

    @property
    def kinetic_energy(self) -> sp.Expr:
        return self.true.kinetic_energy.xreplace({self.rate(q): self.q(q) for q in self.free})
