"""Forces distributed over a continuum, with δW = ∫ f·δr dS."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

from ...language.expression import Expression
from ..bodies import Body
from ..contributions import DistributedForce
from ..material import Material, read_material, within
from ..reader import Reader
from . import Places


@dataclass(frozen=True)
class Distributed:
    """A force density over a line, a surface or a volume: δW = ∫ f · δr dS, δr at the loaded particle.

    `density` is the force per unit of the material coordinates. Source: the lecture's definition of Qᵢ.
    """

    kind: ClassVar[str] = "distributed"

    name: str
    material: tuple[Material, ...]
    position: tuple[Expression, ...] = field(metadata={"unit": "m"})
    density: tuple[Expression, ...]

    @classmethod
    def read(cls, table: Reader) -> Distributed:
        name, material = table.name(), read_material(table)
        inside = within(table, material)
        return cls(name, material, inside.position("position"), inside.vector("density"))

    def contributions(self, _places: Places, _bodies: tuple[Body, ...], /) -> tuple[DistributedForce, ...]:
        density, position = (tuple(x.tree for x in vector) for vector in (self.density, self.position))
        return (DistributedForce(self.name, self.name, density, position, self.material),)
