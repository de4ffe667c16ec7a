"""Particles, with the kinetic energy m/2 v·v."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

from ...language.expression import Expression
from ...language.tree import Product
from ..checks import demand, name_problem
from ..contributions import PointForce
from ..kinetics import Translation
from ..material import Material
from ..reader import Reader


@dataclass(frozen=True)
class Particle:
    """A mass m at r(q, t): kinetic energy E = m/2 v·v."""

    kind: ClassVar[str] = "particle"
    material: ClassVar[tuple[Material, ...]] = ()

    name: str
    mass: Expression = field(metadata={"unit": "kg"})
    position: tuple[Expression, ...] = field(metadata={"unit": "m"})

    def __post_init__(self) -> None:
        demand(name_problem(self.name))

    @classmethod
    def read(cls, table: Reader) -> Particle:
        return cls(table.name(), table.expression("mass"), table.position("position"))

    @property
    def kinetics(self) -> tuple[Translation]:
        return (Translation(self.name, self.mass.tree, tuple(x.tree for x in self.position)),)

    def weight(self, source: str, acceleration: tuple[Expression, ...]) -> PointForce:
        """m g at the particle."""
        return PointForce(source, self.name, tuple(Product((self.mass.tree, g.tree)) for g in acceleration))
