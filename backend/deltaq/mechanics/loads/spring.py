"""The spring."""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction
from typing import ClassVar

from ...language.expression import Expression
from ...language.tree import Call, Negation, Node, Number, Power, Product, Quotient, Sum
from ..bodies import Body
from ..contributions import PotentialEnergy
from ..reader import Reader
from . import Places

ZERO, TWO = Number(Fraction(0)), Number(Fraction(2))


@dataclass(frozen=True)
class Spring:
    """A linear spring of length s between two places: V = k/2 (s − s₀)², s² = |r_to − r_from|², s₀ its rest length."""

    kind: ClassVar[str] = "spring"

    name: str
    start: str = field(metadata={"key": "from"})
    end: str = field(metadata={"key": "to"})
    stiffness: Expression = field(metadata={"unit": "N/m"})
    rest_length: Expression = field(metadata={"unit": "m"})

    @classmethod
    def read(cls, table: Reader) -> Spring:
        return cls(
            table.name(),
            table.place("from"),
            table.place("to"),
            table.expression("stiffness"),
            table.expression("rest_length", default="0"),
        )

    def contributions(self, places: Places, _bodies: tuple[Body, ...], /) -> tuple[PotentialEnergy, ...]:
        stretch_squared = self._stretch_squared(places[self.start], places[self.end])
        energy = Product((Quotient(self.stiffness.tree, TWO), stretch_squared))
        return (PotentialEnergy(self.name, energy),)

    def _stretch_squared(self, start: tuple[Expression, ...], end: tuple[Expression, ...]) -> Node:
        length_squared = Sum(
            tuple(Power(Sum((b.tree, Negation(a.tree))), TWO) for a, b in zip(start, end, strict=True))
        )
        if self.rest_length.tree == ZERO:
            return length_squared  # no root, so the energy stays smooth where the length is zero
        length = Call("sqrt", (length_squared,))
        return Power(Sum((length, Negation(self.rest_length.tree))), TWO)
