"""The rest length of a spring is left out."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ...mechanics.contributions import PotentialEnergy
from ..detour import Detour
from ..road import Road


@dataclass(frozen=True, eq=False)
class RestLengthMissing(Detour):
    """V = k s²/2 is written with the length s of the spring instead of its elongation s − s₀."""

    id: ClassVar[str] = "rest-length-missing"
    likely: ClassVar[int] = 1

    @classmethod
    def variants(cls, true: Road) -> Iterator[Self]:
        for part in true.scene.contributions:
            if isinstance(part, PotentialEnergy):
                energy = true.energy(part)
                lengths = [p.name for p in true.scene.parameters if p.unit == "m" and energy.has(true.q(p.name))]
                lengths = [name for name in lengths if energy.xreplace({true.q(name): true.zero}) != 0]
                yield from (cls(true.scene, true, f"{part.source}:{name}") for name in lengths)

    def energy(self, load: PotentialEnergy) -> sp.Expr:
        source, _, length = self.about.partition(":")
        right = super().energy(load)
        return right.xreplace({self.q(length): self.zero}) if load.source == source else right
