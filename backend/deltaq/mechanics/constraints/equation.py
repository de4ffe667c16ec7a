"""Constraints stated as equations: holonomic, g(q, t) = 0, or linear in the rates, Σ aᵢ(q, t) q̇ᵢ + b(q, t) = 0."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ...language.expression import Expression
from ..checks import demand
from ..conditions import Condition, form_problems, name_problems
from ..reader import Reader
from . import Places


@dataclass(frozen=True)
class EquationConstraint:
    """left = right between expressions in q, t and, linearly, q̇; the condition is u = left − right.

    `equation` has the text as written and the tree of the difference. It is holonomic if no rate stands in it.
    """

    kind: ClassVar[str] = "equation"

    name: str
    equation: Expression
    multiplier: str = ""
    latex: str = ""

    def __post_init__(self) -> None:
        demand(*name_problems(self.name, self.multiplier, self.latex), *form_problems(self.equation, "/equation"))

    @classmethod
    def read(cls, table: Reader) -> EquationConstraint:
        name, equation = table.name(), table.equation("equation")
        return cls(name, equation, table.text("multiplier", ""), table.text("latex", ""))

    def condition(self, _places: Places, /) -> Condition:
        return Condition(self.name, self.equation.tree, not self.equation.rates)
