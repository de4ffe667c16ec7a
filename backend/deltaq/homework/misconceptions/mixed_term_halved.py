"""The mixed term of v² is half as large as it is: (a + b)² = a² + ab + b²."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import sympy as sp

from ...mechanics.bodies import Body
from .._rates import scaled_mixed
from ..detour import Detour


@dataclass(frozen=True, eq=False)
class MixedTermHalved(Detour):
    """The binomial formula is written from memory, and the 2 is lost."""

    id: ClassVar[str] = "mixed-term-halved"
    likely: ClassVar[int] = 2

    def kinetic_energy_of(self, body: Body) -> sp.Expr:
        return scaled_mixed(super().kinetic_energy_of(body), self, sp.Rational(1, 2))
