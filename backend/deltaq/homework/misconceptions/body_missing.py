"""One body has been left out of the kinetic energy."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ...mechanics.bodies import Body
from ..detour import Detour
from ..road import Road


@dataclass(frozen=True, eq=False)
class BodyMissing(Detour):
    """The drawing draws the eye to the body that swings; the one that carries it is overlooked."""

    id: ClassVar[str] = "body-missing"
    likely: ClassVar[int] = 1

    @classmethod
    def variants(cls, true: Road) -> Iterator[Self]:
        if len(true.scene.bodies) > 1:
            yield from (cls(true.scene, true, body.name) for body in true.scene.bodies)

    def kinetic_energy_of(self, body: Body) -> sp.Expr:
        return self.zero if body.name == self.about else super().kinetic_energy_of(body)
