"""Forces on a point, with δW = F·δr."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

from ...language.expression import Expression
from ..bodies import Body
from ..contributions import PointForce
from ..reader import Reader
from . import Places


@dataclass(frozen=True)
class Force:
    """A force F(q, q̇, t) acting at a point or body: δW = F · δr."""

    kind: ClassVar[str] = "force"

    name: str
    at: str
    force: tuple[Expression, ...] = field(metadata={"unit": "N"})

    @classmethod
    def read(cls, table: Reader) -> Force:
        return cls(table.name(), table.place("at"), table.vector("force"))

    def contributions(self, _places: Places, _bodies: tuple[Body, ...], /) -> tuple[PointForce, ...]:
        return (PointForce(self.name, self.at, tuple(component.tree for component in self.force)),)
