"""Mistakes in copying: the law is right, and a name or a coordinate is exchanged."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations
from typing import ClassVar, Self

import sympy as sp

from ...derivation.calculus import V
from ...mechanics.bodies import Body
from ...mechanics.contributions import Contribution
from ...vocabulary import SlipKind
from ..faulty_solution import FaultySolution
from ..solution import Solution


@dataclass(frozen=True, eq=False)
class NamesMixedUp(FaultySolution):
    """Two names of the same kind are mixed up.

    m₁ and m₂, l₁ and l₂ or φ₁ and φ₂ are exchanged while copying from the drawing.
    """

    id: ClassVar[str] = "names-mixed-up"
    likely: ClassVar[int] = 4
    traces: ClassVar[frozenset[SlipKind] | None] = frozenset({"exchanged"})

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        for one, other in combinations(true.scene.parameters, 2):
            if one.unit == other.unit and one.unit:
                yield cls(true.scene, true, f"{one.name}/{other.name}")

    def position(self, place: str) -> sp.ImmutableMatrix:
        return self._exchanged(super().position(place))

    def kinetic_energy_of(self, body: Body) -> sp.Expr:
        return self._exchanged(self.true.kinetic_energy_of(body))

    def virtual_work(self, load: Contribution) -> sp.Expr:
        return self._exchanged(self.true.virtual_work(load))

    def load_potential(self, load: str) -> sp.Expr:
        return self._exchanged(self.true.load_potential(load))

    def _exchanged(self, value: V) -> V:
        first, second = map(self.q, self.about.split("/"))
        return value.xreplace({first: second, second: first})


@dataclass(frozen=True, eq=False)
class OtherCoordinate(FaultySolution):
    """The answer belongs to another coordinate.

    Several equations are derived at once, and one ends up in the field of the other.
    """

    id: ClassVar[str] = "other-coordinate"
    likely: ClassVar[int] = 1

    @classmethod
    def variants(cls, true: Solution) -> Iterator[Self]:
        if len(true.free) > 1:
            yield from (cls(true.scene, true, q) for q in true.free)

    def generalized_force(self, _coordinate: str, /) -> sp.Expr:
        return self.true.generalized_force(self.about)

    def momentum(self, _coordinate: str, /) -> sp.Expr:
        return self.true.momentum(self.about)

    def equation(self, _coordinate: str, /) -> sp.Expr:
        return self.true.equation(self.about)

    def linear_equation(self, _coordinate: str, /) -> sp.Expr:
        return self.true.linear_equation(self.about)
