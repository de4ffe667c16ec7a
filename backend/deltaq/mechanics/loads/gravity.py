"""Gravity, with δW = ∫ g·δr dm on every body."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

from ...language.expression import Expression
from ..bodies import Body
from ..contributions import DistributedForce, PointForce
from ..reader import Reader
from . import Places


@dataclass(frozen=True)
class Gravity:
    """The weight g dm of every body; `acceleration` is the vector g."""

    kind: ClassVar[str] = "gravity"

    name: str
    acceleration: tuple[Expression, ...] = field(metadata={"unit": "m/s^2"})

    @classmethod
    def read(cls, table: Reader) -> Gravity:
        return cls(table.name(), table.vector("acceleration"))

    def contributions(self, _places: Places, bodies: tuple[Body, ...], /) -> tuple[PointForce | DistributedForce, ...]:
        return tuple(body.weight(self.name, self.acceleration) for body in bodies)
