"""Expressions as plain trees: what the parser makes and every backend reads.

A tree holds no object of a computer algebra system, so reading a scene costs no SymPy import. A backend (SymPy for
the steps that are read, SymEngine for the model that is run, the printers) is an `Algebra`: one method for each kind
of node. `fold(node, algebra)` carries it out from the leaves up.

Names are resolved: `Name("phi")` is the coordinate however the user spelt it (`phi`, `φ`, `\\varphi`, `q_2`).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Protocol, TypeVar

T = TypeVar("T")


@dataclass(frozen=True)
class Span:
    """Where in the text a node stands: `offset` and `length` in characters."""

    offset: int
    length: int


NOWHERE = Span(0, 0)


@dataclass(frozen=True)
class Number:
    """An exact number; decimals are read exactly (9.81 is 981/100)."""

    value: Fraction
    span: Span = field(default=NOWHERE, compare=False)


@dataclass(frozen=True)
class Name:
    """A parameter, coordinate, material coordinate, the time `t` or the constant `pi`."""

    name: str
    span: Span = field(default=NOWHERE, compare=False)


@dataclass(frozen=True)
class Rate:
    """Time derivative of a coordinate: q̇ (order 1) or q̈ (order 2)."""

    name: str
    order: int
    span: Span = field(default=NOWHERE, compare=False)


@dataclass(frozen=True)
class Variation:
    """Virtual displacement δq of a coordinate."""

    name: str
    span: Span = field(default=NOWHERE, compare=False)


@dataclass(frozen=True)
class Differential:
    """Differential dq of a coordinate, or dt."""

    name: str
    span: Span = field(default=NOWHERE, compare=False)


@dataclass(frozen=True)
class Sum:
    """a + b + …; a difference is the sum with a Negation."""

    terms: tuple[Node, ...]
    span: Span = field(default=NOWHERE, compare=False)


@dataclass(frozen=True)
class Product:
    """a · b · …"""

    factors: tuple[Node, ...]
    span: Span = field(default=NOWHERE, compare=False)


@dataclass(frozen=True)
class Quotient:
    """a / b"""

    numerator: Node
    denominator: Node
    span: Span = field(default=NOWHERE, compare=False)


@dataclass(frozen=True)
class Negation:
    """−a"""

    operand: Node
    span: Span = field(default=NOWHERE, compare=False)


@dataclass(frozen=True)
class Power:
    """a ^ b"""

    base: Node
    exponent: Node
    span: Span = field(default=NOWHERE, compare=False)


@dataclass(frozen=True)
class Call:
    """A function of the allow-list applied to its arguments."""

    function: str
    arguments: tuple[Node, ...]
    span: Span = field(default=NOWHERE, compare=False)


@dataclass(frozen=True)
class TimeDerivative:
    """d/dt of an expression, taken along the motion."""

    operand: Node
    span: Span = field(default=NOWHERE, compare=False)


@dataclass(frozen=True)
class PartialDerivative:
    """∂/∂x of an expression; `variable` is a Name, Rate or Variation."""

    operand: Node
    variable: Node
    span: Span = field(default=NOWHERE, compare=False)


@dataclass(frozen=True)
class Vector:
    """A column of expressions."""

    components: tuple[Node, ...]
    span: Span = field(default=NOWHERE, compare=False)


@dataclass(frozen=True)
class Equation:
    """left = right"""

    left: Node
    right: Node
    span: Span = field(default=NOWHERE, compare=False)


Node = (
    Number
    | Name
    | Rate
    | Variation
    | Differential
    | Sum
    | Product
    | Quotient
    | Negation
    | Power
    | Call
    | TimeDerivative
    | PartialDerivative
    | Vector
    | Equation
)


class Algebra(Protocol[T]):
    """What a backend must know: how to make its value of each node from the values of the node's parts."""

    def number(self, value: Fraction) -> T: ...
    def name(self, name: str) -> T: ...
    def rate(self, name: str, order: int) -> T: ...
    def variation(self, name: str) -> T: ...
    def differential(self, name: str) -> T: ...
    def sum(self, terms: tuple[T, ...]) -> T: ...
    def product(self, factors: tuple[T, ...]) -> T: ...
    def quotient(self, numerator: T, denominator: T) -> T: ...
    def negation(self, operand: T) -> T: ...
    def power(self, base: T, exponent: T) -> T: ...
    def call(self, function: str, arguments: tuple[T, ...]) -> T: ...
    def time_derivative(self, operand: T) -> T: ...
    def partial_derivative(self, operand: T, variable: T) -> T: ...
    def vector(self, components: tuple[T, ...]) -> T: ...
    def equation(self, left: T, right: T) -> T: ...


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
        case Variation(name):
            return algebra.variation(name)
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
