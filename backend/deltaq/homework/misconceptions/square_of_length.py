"""A length is not squared in the kinetic energy."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ..detour import Detour
from ..road import Road


@dataclass(frozen=True, eq=False)
class SquareOfLength(Detour):
    """In v = l φ̇ only the rate is squared: E = m l φ̇²/2."""

    id: ClassVar[str] = "square-of-length"
    likely: ClassVar[int] = 2

    @classmethod
    def variants(cls, true: Road) -> Iterator[Self]:
        units = {p.name: p.unit for p in true.scene.parameters} | {c.name: c.unit for c in true.scene.free}
        for name, unit in units.items():
            if unit == "m" and true.kinetic_energy.expand().has(true.q(name) ** 2):
                yield cls(true.scene, true, name)

    @property
    def kinetic_energy(self) -> sp.Expr:
        length = self.q(self.about)
        return self.true.kinetic_energy.expand().xreplace({length**2: length})
