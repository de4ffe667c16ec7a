"""Only the rotation of a rigid body is counted, not the motion of its centre of mass."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ...mechanics.bodies import Body
from ...mechanics.kinetics import Rotation, Translation
from ..detour import Detour
from ..road import Road


@dataclass(frozen=True, eq=False)
class TranslationMissing(Detour):
    """J ω²/2 looks complete for a body that turns."""

    id: ClassVar[str] = "translation-missing"
    likely: ClassVar[int] = 2

    @classmethod
    def variants(cls, true: Road) -> Iterator[Self]:
        for body in true.scene.bodies:
            if any(isinstance(part, Rotation) for part in body.kinetics):
                yield cls(true.scene, true, body.name)

    def kinetic_energy_of(self, body: Body) -> sp.Expr:
        right = super().kinetic_energy_of(body)
        if body.name != self.about:
            return right
        (mass,) = (part.mass for part in body.kinetics if isinstance(part, Translation))
        v = self.velocity(body.name)
        return right - self.expression(mass) * self.dot(v, v) / 2
