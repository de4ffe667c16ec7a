"""The ½ of the kinetic energy is missing: E = m v²."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import sympy as sp

from ...mechanics.bodies import Body
from ..detour import Detour


@dataclass(frozen=True, eq=False)
class HalfInKineticEnergy(Detour):
    """The product m v·v is remembered, the half that comes from integrating m v dv is not."""

    id: ClassVar[str] = "half-in-kinetic-energy"
    likely: ClassVar[int] = 1

    def kinetic_energy_of(self, body: Body) -> sp.Expr:
        return 2 * super().kinetic_energy_of(body)
