"""Constraints: what a motion keeps to, by reactions that do no virtual work on it. One kind, one file.

A kind is a frozen dataclass with a `kind`, a way to `read` it from its table and the `condition` it comes down to.
The reaction of a condition u = 0 is λ ∂g/∂qᵢ where u = g(q, t) is holonomic, and λ aᵢ where u = Σ aᵢ q̇ᵢ + b.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar, Protocol, Self

from ...language.expression import Expression
from ..conditions import Condition
from ..reader import Reader

Places = Mapping[str, tuple[Expression, ...]]


class Constraint(Protocol):
    """What every kind of constraint has."""

    kind: ClassVar[str]

    @classmethod
    def read(cls, table: Reader, /) -> Self:
        """The constraint in a table of a scene document; the reader collects what is wrong."""

    @property
    def name(self) -> str:
        """The name that steps, labels and answers refer to."""

    @property
    def multiplier(self) -> str:
        """The name of its multiplier as the scene gives it; "" leaves it to `Scene.multipliers`."""

    @property
    def latex(self) -> str:
        """How the multiplier is written; "" lets its name make it."""

    def condition(self, places: Places, /) -> Condition:
        """The expression that it keeps at zero."""
