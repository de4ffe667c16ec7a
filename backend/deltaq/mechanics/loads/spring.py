"""Linear springs between two places, with V = k/2 (s − s₀)²."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

from ...language.expression import Expression
from ...language.tree import Negation, Node, Power, Product, Quotient, Sum
from ..bodies import Body
from ..contributions import PotentialEnergy
from ..lengths import TWO, ZERO, distance, squared_distance
from ..reader import Reader
from . import Places


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
        start, end = table.place("from"), table.place("to")
        return cls(table.name(), start, end, table.expression("stiffness"), table.expression("rest_length", "0"))

    def contributions(self, places: Places, _bodies: tuple[Body, ...], /) -> tuple[PotentialEnergy, ...]:
        stretch_squared = self._stretch_squared(places[self.start], places[self.end])
        return (PotentialEnergy(self.name, Product((Quotient(self.stiffness.tree, TWO), stretch_squared))),)

    def _stretch_squared(self, start: tuple[Expression, ...], end: tuple[Expression, ...]) -> Node:
        if self.rest_length.tree == ZERO:
            return squared_distance(start, end)  # no root, so the energy stays smooth where the length is zero
        return Power(Sum((distance(start, end), Negation(self.rest_length.tree))), TWO)
