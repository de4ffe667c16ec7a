"""The kinds of nodes of an expression tree."""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction
from typing import TypeAlias


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
    """Virtual displacement δq of a coordinate (order 0), or its rate δq̇ or δq̈."""

    name: str
    order: int = 0
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


Node: TypeAlias = (
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
