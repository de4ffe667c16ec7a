"""The particle."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

from ...language.expression import Expression
from ..checks import demand, name_problem
from ..reader import Reader


@dataclass(frozen=True)
class Particle:
    """A mass m at r(q, t): kinetic energy E = m/2 v·v."""

    kind: ClassVar[str] = "particle"

    name: str
    mass: Expression = field(metadata={"unit": "kg"})
    position: tuple[Expression, ...] = field(metadata={"unit": "m"})

    def __post_init__(self) -> None:
        demand(name_problem(self.name))

    @classmethod
    def read(cls, table: Reader) -> Particle:
        return cls(table.name(), table.expression("mass"), table.position("position"))
