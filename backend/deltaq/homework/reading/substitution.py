"""Names that stand for something else, replaced in a tree: rates and variations of them by the chain rule."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import NoReturn

from ...errors import ExpressionError, Problem
from ...language.bounds import MAX_NODES, check_bounds
from ...language.tree import (
    Differential,
    Name,
    Node,
    Number,
    PartialDerivative,
    Product,
    Rate,
    Sum,
    TimeDerivative,
    TreeAlgebra,
    Variation,
    fold,
    walk,
)

MOST_NODES = 4 * MAX_NODES


def substituted(tree: Node, trees: Mapping[str, Node], coordinates: tuple[str, ...]) -> Node:
    """The tree with every name of `trees` replaced. Raises ExpressionError if it becomes too large."""
    if not any(isinstance(node, Name | Rate | Variation | Differential) and node.name in trees for node in walk(tree)):
        return tree
    grown = fold(tree, _Substitution(trees, coordinates))
    if sum(1 for _ in walk(grown)) > MOST_NODES:
        _refuse("too-many-nodes", limit=MOST_NODES)
    check_bounds(grown)
    return grown


def _refuse(code: str, **parameters: str | int) -> NoReturn:
    raise ExpressionError(Problem(code, parameters=parameters))


@dataclass(frozen=True)
class _Substitution(TreeAlgebra):
    """Trees in which names stand for others: `coordinates` are what these may be varied by."""

    trees: Mapping[str, Node]
    coordinates: tuple[str, ...]

    def name(self, name: str) -> Node:
        return self.trees.get(name, Name(name))

    def rate(self, name: str, order: int) -> Node:
        node = self.trees.get(name)
        if node is None:
            return Rate(name, order)
        for _ in range(order):
            node = TimeDerivative(node)
        return node

    def variation(self, name: str, order: int) -> Node:
        """δf = Σ ∂f/∂q δq"""
        node = self.trees.get(name)
        if node is None:
            return Variation(name, order)
        if order or any(isinstance(part, Rate | TimeDerivative | Variation) for part in walk(node)):
            _refuse("variation-of-variation")
        moved = {part.name for part in walk(node) if isinstance(part, Name)} & set(self.coordinates)
        terms = [Product((PartialDerivative(node, Name(q)), Variation(q))) for q in sorted(moved)]
        return Sum(tuple(terms)) if terms else Number(Fraction(0))

    def differential(self, name: str) -> Node:
        if name in self.trees:
            _refuse("differential-of-constant", name=name)
        return Differential(name)

    def partial_derivative(self, operand: Node, variable: Node) -> Node:
        if not isinstance(variable, Name | Rate):
            _refuse("derivative-variable", text="?")
        return PartialDerivative(operand, variable)
