"""Dissipation functions R(q, q̇, t), with Qᵢ = −∂R/∂q̇ᵢ."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

from ...language.expression import Expression
from ..bodies import Body
from ..contributions import DissipationFunction
from ..reader import Reader
from . import Places


@dataclass(frozen=True)
class Dissipation:
    """Rayleigh's dissipation function R(q, q̇, t): Qᵢ = −∂R/∂q̇ᵢ; it takes the power 2R if it is quadratic.

    Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §1.5.
    """

    kind: ClassVar[str] = "dissipation"

    name: str
    function: Expression = field(metadata={"unit": "W"})

    @classmethod
    def read(cls, table: Reader) -> Dissipation:
        return cls(table.name(), table.expression("function"))

    def contributions(self, _places: Places, _bodies: tuple[Body, ...], /) -> tuple[DissipationFunction, ...]:
        return (DissipationFunction(self.name, self.function.tree),)
