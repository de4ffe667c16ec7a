"""The ½ is missing in the kinetic energy of one body."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ...mechanics.bodies import Body
from ..detour import Detour
from ..road import Road


@dataclass(frozen=True, eq=False)
class HalfOfOneBody(Detour):
    """With several bodies the factor is written for the first and lost for the next."""

    id: ClassVar[str] = "half-of-one-body"
    likely: ClassVar[int] = 3

    @classmethod
    def variants(cls, true: Road) -> Iterator[Self]:
        if len(true.scene.bodies) > 1:
            yield from (cls(true.scene, true, body.name) for body in true.scene.bodies)

    def kinetic_energy_of(self, body: Body) -> sp.Expr:
        right = super().kinetic_energy_of(body)
        return 2 * right if body.name == self.about else right
