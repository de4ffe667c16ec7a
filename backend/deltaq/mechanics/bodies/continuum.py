"""Continua, with the kinetic energy ∫ ½ v·v dm."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

from ...language.expression import Expression
from ...language.tree import Product
from ..checks import demand, name_problem
from ..contributions import DistributedForce
from ..kinetics import Distribution
from ..material import Material, read_material, within
from ..reader import Reader


@dataclass(frozen=True)
class Continuum:
    """Material spread over one to three material coordinates: E = ∫ 1/2 v·v dm, dm = density · d(material).

    `position` is the field r(s, q, t) of all its particles, `density` the mass per unit of the material coordinates.
    """

    kind: ClassVar[str] = "continuum"

    name: str
    material: tuple[Material, ...]
    density: Expression
    position: tuple[Expression, ...] = field(metadata={"unit": "m"})

    def __post_init__(self) -> None:
        demand(name_problem(self.name))

    @classmethod
    def read(cls, table: Reader) -> Continuum:
        name, material = table.name(), read_material(table)
        inside = within(table, material)
        return cls(name, material, inside.expression("density"), inside.position("position"))

    @property
    def kinetics(self) -> tuple[Distribution]:
        position = tuple(x.tree for x in self.position)
        return (Distribution(self.name, self.density.tree, position, self.material),)

    def weight(self, source: str, acceleration: tuple[Expression, ...]) -> DistributedForce:
        """g dm at every particle."""
        density = tuple(Product((self.density.tree, g.tree)) for g in acceleration)
        return DistributedForce(source, self.name, density, tuple(x.tree for x in self.position), self.material)
