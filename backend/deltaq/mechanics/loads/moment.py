"""Moments on an angle, with δW = M δφ."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

from ...language.expression import Expression
from ..bodies import Body
from ..contributions import Moment
from ..reader import Reader
from . import Places


@dataclass(frozen=True)
class FreeMoment:
    """A moment M(q, q̇, t) that turns the angle φ(q, t): δW = M δφ."""

    kind: ClassVar[str] = "moment"

    name: str
    angle: Expression = field(metadata={"unit": "rad"})
    moment: Expression = field(metadata={"unit": "N m"})

    @classmethod
    def read(cls, table: Reader) -> FreeMoment:
        return cls(table.name(), table.angle("angle"), table.expression("moment"))

    def contributions(self, _places: Places, _bodies: tuple[Body, ...], /) -> tuple[Moment, ...]:
        return (Moment(self.name, self.angle.tree, self.moment.tree),)
