"""The lever arm is missing: the generalized force of an angle is given as a force."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import sympy as sp

from ...language.canonical import display
from ...mechanics.contributions import Contribution, PointForce
from ..detour import Detour
from ..road import Road


@dataclass(frozen=True, eq=False)
class LeverArmMissing(Detour):
    """Q is read off as the component of the force along the path, F instead of F l, for one load or for all."""

    id: ClassVar[str] = "lever-arm-missing"
    likely: ClassVar[int] = 2

    @classmethod
    def variants(cls, true: Road) -> Iterator[Self]:
        forces = (part.source for part in true.scene.contributions if isinstance(part, PointForce))
        yield from (cls(true.scene, true, about) for about in ("", *dict.fromkeys(forces)))

    def virtual_work(self, load: Contribution) -> sp.Expr:
        right = self.true.virtual_work(load)
        if not isinstance(load, PointForce) or self.about not in ("", load.source):
            return right
        angles = {c.name for c in self.scene.free if c.unit in ("rad", "deg")}
        return sp.Add(*(self._share(right, load, q, turning=q in angles) for q in self.free))

    def _share(self, work: sp.Expr, load: PointForce, coordinate: str, *, turning: bool) -> sp.Expr:
        change = self.variation(coordinate)
        share = work.coeff(change) * change
        tangent = self.position(load.place).diff(self.q(coordinate))
        arm = sp.sqrt(display(self.dot(tangent, tangent).expand(), self.symbols))
        return share / arm if turning and arm != 0 else share

    def load_potential(self, load: str) -> sp.Expr:
        return self.true.load_potential(load)
