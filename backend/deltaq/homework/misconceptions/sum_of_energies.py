"""L is taken as E + V."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import sympy as sp

from ..detour import Detour


@dataclass(frozen=True, eq=False)
class SumOfEnergies(Detour):
    """The total energy is the more familiar quantity; the difference looks like a mistake."""

    id: ClassVar[str] = "sum-of-energies"
    likely: ClassVar[int] = 1

    @property
    def lagrangian(self) -> sp.Expr:
        return self.kinetic_energy + self.potential_energy
