"""The factor ω is missing when a guide such as y₀ sin ωt is differentiated."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar, Self

import sympy as sp

from ...derivation.calculus import column
from ..detour import Detour
from ..road import Road


@dataclass(frozen=True, eq=False)
class InnerFrequency(Detour):
    """ωt looks like a variable of its own, so d/dt sin ωt becomes cos ωt."""

    id: ClassVar[str] = "inner-frequency"
    likely: ClassVar[int] = 3

    @classmethod
    def variants(cls, true: Road) -> Iterator[Self]:
        if true.scene.guides:
            yield cls(true.scene, true)

    @cached_property
    def guides(self) -> Mapping[sp.Symbol, sp.Expr]:
        found = dict(self.true.guides)
        for guide in self.scene.guides:
            name = guide.coordinate
            value = found[self.q(name)]
            inner = [f.args[0] for f in value.atoms(sp.Function) if f.args[0].has(self.t)]
            factor = inner[0].diff(self.t) if inner else sp.Integer(1)
            found[self.rate(name)] = value.diff(self.t) / factor
            found[self.acceleration(name)] = value.diff(self.t, 2) / factor**2
        return found

    def time_derivative(self, value: sp.Expr) -> sp.Expr:
        by_time = {f: f.args[0].diff(self.t) for f in value.atoms(sp.Function) if f.args[0].has(self.t)}
        factor = next(iter(by_time.values()), sp.Integer(1))
        right = self.true.time_derivative(value)
        return right + value.diff(self.t) * (1 / factor - 1)

    def velocity(self, place: str) -> sp.ImmutableMatrix:
        return column(self.time_derivative(component) for component in self.position(place))
