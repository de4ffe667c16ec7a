"""Expressions as plain trees: what the parser makes and every backend reads.

A tree holds no object of a computer algebra system, so reading a scene costs no SymPy import. A backend (SymPy for
the steps that are read, SymEngine for the model that is run, the printers) is an `Algebra`: one method for each kind
of node. `fold(node, algebra)` carries it out from the leaves up.

Names are resolved: `Name("phi")` is the coordinate however the user spelt it (`phi`, `φ`, `\\varphi`, `q_2`).
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import NoReturn, Protocol, TypeVar

from .nodes import (
    NOWHERE,
    Call,
    Differential,
    Equation,
    Name,
    Negation,
    Node,
    Number,
    PartialDerivative,
    Power,
    Product,
    Quotient,
    Rate,
    Span,
    Sum,
    TimeDerivative,
    Variation,
    Vector,
)

__all__ = [
    "NOWHERE",
    "Algebra",
    "Call",
    "Differential",
    "Equation",
    "Name",
    "Negation",
    "Node",
    "Number",
    "NumbersOnly",
    "PartialDerivative",
    "Power",
    "Product",
    "Quotient",
    "Rate",
    "Span",
    "Sum",
    "TimeDerivative",
    "TreeAlgebra",
    "Variation",
    "Vector",
    "children",
    "fold",
    "walk",
]

T = TypeVar("T")


class Algebra(Protocol[T]):
    """What a backend must know: how to make its value of each node from the values of the node's parts."""

    def number(self, value: Fraction) -> T:
        """A number, exactly."""

    def name(self, name: str) -> T:
        """A coordinate, parameter or constant by its name."""

    def rate(self, name: str, order: int) -> T:
        """The time derivative of a coordinate, of order 1 or 2."""

    def variation(self, name: str, order: int) -> T:
        """δq, or its time derivative of an order."""

    def differential(self, name: str) -> T:
        """dq."""

    def sum(self, terms: tuple[T, ...]) -> T:
        """The sum of at least one term."""

    def product(self, factors: tuple[T, ...]) -> T:
        """The product of the factors, in their order."""

    def quotient(self, numerator: T, denominator: T) -> T:
        """numerator / denominator."""

    def negation(self, operand: T) -> T:
        """−operand."""

    def power(self, base: T, exponent: T) -> T:
        """base^exponent."""

    def call(self, function: str, arguments: tuple[T, ...]) -> T:
        """A function of the language by its name."""

    def time_derivative(self, operand: T) -> T:
        """d/dt along the motion."""

    def partial_derivative(self, operand: T, variable: T) -> T:
        """∂operand/∂variable."""

    def vector(self, components: tuple[T, ...]) -> T:
        """A vector of its components."""

    def equation(self, left: T, right: T) -> T:
        """left = right."""


class NumbersOnly:
    """What algebras of numbers have no value for; the names are gone in it, so nothing is left to differentiate by."""

    def partial_derivative(self, _operand: object, _variable: object) -> NoReturn:
        """Raises ValueError."""
        raise ValueError("a number has no derivative")

    def vector(self, _components: object) -> NoReturn:
        """Raises ValueError."""
        raise ValueError("a vector is evaluated component by component")

    def equation(self, _left: object, _right: object) -> NoReturn:
        """Raises ValueError."""
        raise ValueError("an equation has no value")


class TreeAlgebra:
    """The algebra whose values are trees: folding makes the same tree once more; what changes trees overrides some."""

    def number(self, value: Fraction) -> Node:
        """The number."""
        return Number(value)

    def name(self, name: str) -> Node:
        """The name."""
        return Name(name)

    def rate(self, name: str, order: int) -> Node:
        """The rate of a coordinate."""
        return Rate(name, order)

    def variation(self, name: str, order: int) -> Node:
        """The variation of a coordinate, or its rate."""
        return Variation(name, order)

    def differential(self, name: str) -> Node:
        """The differential of a coordinate."""
        return Differential(name)

    def sum(self, terms: tuple[Node, ...]) -> Node:
        """The sum of the trees."""
        return Sum(terms)

    def product(self, factors: tuple[Node, ...]) -> Node:
        """The product of the trees."""
        return Product(factors)

    def quotient(self, numerator: Node, denominator: Node) -> Node:
        """One tree over the other."""
        return Quotient(numerator, denominator)

    def negation(self, operand: Node) -> Node:
        """The tree with a minus."""
        return Negation(operand)

    def power(self, base: Node, exponent: Node) -> Node:
        """One tree to the power of the other."""
        return Power(base, exponent)

    def call(self, function: str, arguments: tuple[Node, ...]) -> Node:
        """A function of the trees."""
        return Call(function, arguments)

    def time_derivative(self, operand: Node) -> Node:
        """The tree with a dot."""
        return TimeDerivative(operand)

    def partial_derivative(self, operand: Node, variable: Node) -> Node:
        """The derivative of one tree by the other."""
        return PartialDerivative(operand, variable)

    def vector(self, components: tuple[Node, ...]) -> Node:
        """A vector of the trees."""
        return Vector(components)

    def equation(self, left: Node, right: Node) -> Node:
        """An equation between the trees."""
        return Equation(left, right)


def fold(node: Node, algebra: Algebra[T]) -> T:
    """The algebra's value of the tree below `node`."""

    def folded(part: Node) -> T:
        return fold(part, algebra)

    match node:
        case Number(value):
            return algebra.number(value)
        case Name(name):
            return algebra.name(name)
        case Rate(name, order):
            return algebra.rate(name, order)
        case Variation(name, order):
            return algebra.variation(name, order)
        case Differential(name):
            return algebra.differential(name)
        case Sum(terms):
            return algebra.sum(tuple(map(folded, terms)))
        case Product(factors):
            return algebra.product(tuple(map(folded, factors)))
        case Quotient(numerator, denominator):
            return algebra.quotient(folded(numerator), folded(denominator))
        case Negation(operand):
            return algebra.negation(folded(operand))
        case Power(base, exponent):
            return algebra.power(folded(base), folded(exponent))
        case Call(function, arguments):
            return algebra.call(function, tuple(map(folded, arguments)))
        case TimeDerivative(operand):
            return algebra.time_derivative(folded(operand))
        case PartialDerivative(operand, variable):
            return algebra.partial_derivative(folded(operand), folded(variable))
        case Vector(components):
            return algebra.vector(tuple(map(folded, components)))
        case Equation(left, right):
            return algebra.equation(folded(left), folded(right))


def children(node: Node) -> tuple[Node, ...]:
    """The parts of a node, in reading order."""
    match node:
        case Number() | Name() | Rate() | Variation() | Differential():
            return ()
        case Sum(parts) | Product(parts) | Vector(parts) | Call(_, parts):
            return parts
        case Quotient(first, second) | Power(first, second) | Equation(first, second):
            return first, second
        case PartialDerivative(first, second):
            return first, second
        case Negation(operand) | TimeDerivative(operand):
            return (operand,)


def walk(node: Node) -> Iterator[Node]:
    """Every node of the tree, parents before their parts."""
    yield node
    for part in children(node):
        yield from walk(part)
