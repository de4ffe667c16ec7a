"""Potential energies given as functions, with δW = −δV."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

from ...errors import Problem
from ...language.expression import Expression
from ..bodies import Body
from ..checks import demand
from ..contributions import PotentialEnergy
from ..reader import Reader
from . import Places


@dataclass(frozen=True)
class Potential:
    """A potential energy V(q, t) given as such: δW = −δV. It cannot depend on rates."""

    kind: ClassVar[str] = "potential"

    name: str
    energy: Expression = field(metadata={"unit": "J"})

    def __post_init__(self) -> None:
        rates = sorted(self.energy.rates)
        demand(Problem("potential-with-rate", "/energy", parameters={"coordinate": rates[0]}) if rates else None)

    @classmethod
    def read(cls, table: Reader) -> Potential:
        return cls(table.name(), table.expression("energy"))

    def contributions(self, _places: Places, _bodies: tuple[Body, ...], /) -> tuple[PotentialEnergy, ...]:
        return (PotentialEnergy(self.name, self.energy.tree),)
