"""Named places r(q, t) without mass."""

from __future__ import annotations

from dataclasses import dataclass, field

from ..language.expression import Expression
from .checks import demand, name_problem


@dataclass(frozen=True)
class Point:
    """A place r(q, t) without mass: where springs end, forces act and the drawing hangs."""

    name: str
    position: tuple[Expression, ...] = field(metadata={"unit": "m"})

    def __post_init__(self) -> None:
        demand(name_problem(self.name))
