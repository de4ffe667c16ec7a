"""Rods without mass between two places, and strings that stay taut: their distance is given."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

from ...errors import Problem
from ...language.expression import Expression
from ...language.tree import Negation, Sum
from ..checks import demand
from ..conditions import Condition, form_problems, name_problems
from ..lengths import distance
from ..reader import Reader
from . import Places


@dataclass(frozen=True)
class DistanceConstraint:
    """|r_to − r_from| = s. The condition is g = s − |r_to − r_from|: λ is the force of the rod, positive in tension.

    For the force S of a rod in tension pulls its ends together: δW = −S δ|r_to − r_from|, which is λ δg with λ = S.
    """

    kind: ClassVar[str] = "distance"

    name: str
    start: str = field(metadata={"key": "from"})
    end: str = field(metadata={"key": "to"})
    length: Expression = field(metadata={"unit": "m"})
    multiplier: str = ""
    latex: str = ""

    def __post_init__(self) -> None:
        same = (
            Problem("distance-of-itself", "/to", parameters={"name": self.end[:40]}) if self.start == self.end else None
        )
        rates = (Problem("length-with-rate", "/length", parameters={"coordinate": rate}) for rate in self.length.rates)
        demand(
            *name_problems(self.name, self.multiplier, self.latex),
            same,
            next(rates, None),
            *form_problems(self.length, "/length"),
        )

    @classmethod
    def read(cls, table: Reader) -> DistanceConstraint:
        name, start, end = table.name(), table.place("from"), table.place("to")
        return cls(name, start, end, table.expression("length"), table.text("multiplier", ""), table.text("latex", ""))

    def condition(self, places: Places, /) -> Condition:
        between = distance(places[self.start], places[self.end])
        return Condition(self.name, Sum((self.length.tree, Negation(between))), is_holonomic=True)
