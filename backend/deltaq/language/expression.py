"""An expression of a scene or an answer: the text as written, and the tree it means."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from .tree import (
    Call,
    Differential,
    Equation,
    Name,
    Node,
    PartialDerivative,
    Rate,
    TimeDerivative,
    Variation,
    Vector,
    walk,
)


@dataclass(frozen=True)
class Expression:
    """Text and tree belong together; only the parser makes the pair. Two expressions are equal if their trees are."""

    text: str
    tree: Node

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Expression) and self.tree == other.tree

    def __hash__(self) -> int:
        return hash(self.tree)

    @property
    def names(self) -> frozenset[str]:
        """All names it depends on, rates and variations under the name of their coordinate."""
        return frozenset(n.name for n in walk(self.tree) if isinstance(n, (Name, Rate, Variation, Differential)))

    @property
    def rates(self) -> frozenset[str]:
        """The coordinates whose rates it depends on."""
        return frozenset(n.name for n in walk(self.tree) if isinstance(n, Rate))

    @property
    def functions(self) -> frozenset[str]:
        """The functions it calls."""
        return frozenset(n.function for n in walk(self.tree) if isinstance(n, Call))

    @property
    def is_scalar(self) -> bool:
        """Whether it is one number's worth: no vector, no equation, nothing virtual or infinitesimal."""
        return not any(isinstance(n, (Vector, Equation, Variation, Differential)) for n in walk(self.tree))

    @property
    def has_derivatives(self) -> bool:
        """Whether derivatives are still to be taken, other than rates of coordinates."""
        return any(isinstance(n, (TimeDerivative, PartialDerivative)) for n in walk(self.tree))


def expressions_in(given: object) -> Iterator[Expression]:
    """The expressions of what is stated of a body or load: one, a vector, a tensor by rows, or none."""
    if isinstance(given, Expression):
        yield given
    elif isinstance(given, tuple):
        yield from (expression for part in given for expression in expressions_in(part))
