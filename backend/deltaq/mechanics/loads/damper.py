"""Linear dampers between two places, with R = c/2 ṡ²."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

from ...language.expression import Expression
from ...language.tree import Power, Product, Quotient, TimeDerivative
from ..bodies import Body
from ..contributions import DissipationFunction
from ..lengths import TWO, distance_up_to_sign
from ..reader import Reader
from . import Places


@dataclass(frozen=True)
class Damper:
    """A linear damper of length s between two places: R = c/2 ṡ², which gives the force −c ṡ along it.

    Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §1.5.
    """

    kind: ClassVar[str] = "damper"

    name: str
    start: str = field(metadata={"key": "from"})
    end: str = field(metadata={"key": "to"})
    coefficient: Expression = field(metadata={"unit": "N s/m"})

    @classmethod
    def read(cls, table: Reader) -> Damper:
        return cls(table.name(), table.place("from"), table.place("to"), table.expression("coefficient"))

    def contributions(self, places: Places, _bodies: tuple[Body, ...], /) -> tuple[DissipationFunction, ...]:
        speed = TimeDerivative(distance_up_to_sign(places[self.start], places[self.end]))  # its square has no sign
        function = Product((Quotient(self.coefficient.tree, TWO), Power(speed, TWO)))
        return (DissipationFunction(self.name, function),)
