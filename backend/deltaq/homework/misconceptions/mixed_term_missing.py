"""The mixed term of v² is missing: (a + b)² = a² + b²."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import sympy as sp

from ...mechanics.bodies import Body
from .._rates import scaled_mixed
from ..detour import Detour


@dataclass(frozen=True, eq=False)
class MixedTermMissing(Detour):
    """Velocities are squared one by one, as if they were at right angles."""

    id: ClassVar[str] = "mixed-term-missing"
    likely: ClassVar[int] = 1

    def kinetic_energy_of(self, body: Body) -> sp.Expr:
        return scaled_mixed(super().kinetic_energy_of(body), self, sp.Integer(0))
