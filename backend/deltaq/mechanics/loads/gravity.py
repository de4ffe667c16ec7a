"""Gravity."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

from ...language.expression import Expression
from ...language.tree import Product
from ..bodies import Body
from ..contributions import PointForce
from ..reader import Reader
from . import Places


@dataclass(frozen=True)
class Gravity:
    """The weight m g of every body, at its centre of mass; `acceleration` is the vector g."""

    kind: ClassVar[str] = "gravity"

    name: str
    acceleration: tuple[Expression, ...] = field(metadata={"unit": "m/s^2"})

    @classmethod
    def read(cls, table: Reader) -> Gravity:
        return cls(table.name(), table.vector("acceleration"))

    def contributions(self, _places: Places, bodies: tuple[Body, ...], /) -> tuple[PointForce, ...]:
        return tuple(
            PointForce(self.name, body.name, tuple(Product((body.mass.tree, g.tree)) for g in self.acceleration))
            for body in bodies
        )
