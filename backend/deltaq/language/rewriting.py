"""Trees with names exchanged for other expressions, and the text of a tree.

`Exchange` is an algebra whose values are trees: folding a tree with it makes the tree anew, with q̇ following where q is
exchanged for s q + c. `written` is the plain text that the parser reads back as the same expression.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import TypeAlias

from .expression import Expression
from .tree import (
    Call,
    Differential,
    Name,
    Negation,
    Node,
    Number,
    PartialDerivative,
    Product,
    Quotient,
    Rate,
    Sum,
    TreeAlgebra,
    Variation,
    fold,
)

PI = Name("pi")
ZERO = Number(Fraction(0))
QUARTERS: Mapping[int, tuple[str, int]] = {0: ("sin", 1), 1: ("cos", 1), 2: ("sin", -1), 3: ("cos", -1)}


def scaled(factor: Fraction, node: Node) -> Node:
    """factor · node, with a sign where the factor is no more than that."""
    if factor == 1:
        return node
    return Negation(node) if factor == -1 else Product((Number(factor), node))


@dataclass(frozen=True)
class Shift:
    """q := sign · q + quarters · π/2 + length: a coordinate counted in the other sense, or from elsewhere."""

    name: str
    sign: int = 1
    quarters: int = 0
    length: Node = ZERO

    @property
    def node(self) -> Node:
        """The expression that takes the place of q."""
        turn = scaled(Fraction(self.quarters, 2), PI) if self.quarters else ZERO
        counted = scaled(Fraction(self.sign), Name(self.name))
        terms = tuple(term for term in (counted, turn, self.length) if term != ZERO)
        return terms[0] if len(terms) == 1 else Sum(terms)

    def wave(self, function: str) -> Node:
        """sin or cos of the new q without the quarter turns: sin(π/2 − q) = cos q."""
        # sin(s q + k π/2): of −q + k π/2 it is −sin(q − k π/2), and cos x = sin(x + π/2).
        quarters = self.quarters + (1 if function == "cos" else 0)
        kind, sign = QUARTERS[(quarters if self.sign > 0 else -quarters) % 4]
        whole = Fraction(sign * self.sign)
        return scaled(whole, Call(kind, (Name(self.name),)))


@dataclass(frozen=True)
class Exchange(TreeAlgebra):
    """Names for which other expressions are put: coordinates by shifts, parameters and zeros by trees."""

    shifts: Mapping[str, Shift] = field(default_factory=dict)
    trees: Mapping[str, Node] = field(default_factory=dict)

    def name(self, name: str) -> Node:
        return self.shifts[name].node if name in self.shifts else self.trees.get(name, Name(name))

    def _signed(self, name: str, node: Node) -> Node:
        return scaled(Fraction(self.shifts[name].sign), node) if name in self.shifts else node

    def rate(self, name: str, order: int) -> Node:
        return self._signed(name, Rate(name, order))

    def variation(self, name: str, order: int) -> Node:
        return self._signed(name, Variation(name, order))

    def differential(self, name: str) -> Node:
        return self._signed(name, Differential(name))

    def sum(self, terms: tuple[Node, ...]) -> Node:
        left = tuple(term for term in terms if term != ZERO)
        return Sum(left) if len(left) > 1 else left[0] if left else ZERO

    def product(self, factors: tuple[Node, ...]) -> Node:
        return ZERO if ZERO in factors else Product(factors)

    def negation(self, operand: Node) -> Node:
        if isinstance(operand, Negation):
            return operand.operand
        return operand if operand == ZERO else Negation(operand)

    def call(self, function: str, arguments: tuple[Node, ...]) -> Node:
        if function in ("sin", "cos"):
            for shift in self.shifts.values():
                if arguments == (shift.node,) and shift.length == ZERO:
                    return shift.wave(function)
        return Call(function, arguments)

    def partial_derivative(self, operand: Node, variable: Node) -> Node:
        """∂/∂(s q + c) is s ∂/∂q for a sign s, and ∂/∂(f p) is ∂/∂p divided by f."""
        match variable:
            case Sum((counted, *_)) if variable in [shift.node for shift in self.shifts.values()]:
                return self.partial_derivative(operand, counted)
            case Negation(inner):
                return Negation(PartialDerivative(operand, inner))
            case Product((Number(factor), inner)):
                return Quotient(PartialDerivative(operand, inner), Number(factor))
        return PartialDerivative(operand, variable)


def exchanged(expression: Expression, exchange: Exchange) -> Expression:
    """The expression with the names exchanged; one that speaks of none of them stays as it was written."""
    if not expression.names & (exchange.shifts.keys() | exchange.trees.keys()):
        return expression
    return expression_of(fold(expression.tree, exchange))


def expression_of(tree: Node) -> Expression:
    """A tree with its text."""
    return Expression(written(tree), tree)


# --- text ------------------------------------------------------------------------------------------------------------

SUM, PRODUCT, POWER, ATOM = range(4)
Written: TypeAlias = tuple[str, int]  # the text, and how tightly its last operation binds


def written(tree: Node) -> str:
    """The tree as plain text: operations and calls alone, which the parser reads as the same expression."""
    return fold(tree, _Writer())[0]


def _inside(part: Written, binding: int) -> str:
    text, own = part
    return text if own >= binding else f"({text})"


class _Writer:
    """Texts of the parts put together, in brackets where the grammar would read them otherwise."""

    def number(self, value: Fraction) -> Written:
        whole = value.denominator == 1
        return (str(value), ATOM if whole and value >= 0 else SUM if value < 0 else PRODUCT)

    def name(self, name: str) -> Written:
        return name, ATOM

    def rate(self, name: str, order: int) -> Written:
        return f"{'d' * order}ot({name})", ATOM

    def variation(self, name: str, order: int) -> Written:
        text = f"delta({name})"
        for _ in range(order):
            text = f"diff({text}, t)"
        return text, ATOM

    def differential(self, name: str) -> Written:
        return f"d({name})", ATOM

    def sum(self, terms: tuple[Written, ...]) -> Written:
        first, *rest = (_inside(term, SUM) for term in terms)
        joined = [f" - {term[1:]}" if term.startswith("-") else f" + {term}" for term in rest]
        return first + "".join(joined), SUM

    def product(self, factors: tuple[Written, ...]) -> Written:
        first, *rest = factors
        return "*".join([_inside(first, PRODUCT), *(_inside(factor, POWER) for factor in rest)]), PRODUCT

    def quotient(self, numerator: Written, denominator: Written) -> Written:
        return f"{_inside(numerator, PRODUCT)}/{_inside(denominator, POWER)}", PRODUCT

    def negation(self, operand: Written) -> Written:
        return f"-{_inside(operand, PRODUCT)}", SUM

    def power(self, base: Written, exponent: Written) -> Written:
        return f"{_inside(base, ATOM)}^{_inside(exponent, ATOM)}", POWER

    def call(self, function: str, arguments: tuple[Written, ...]) -> Written:
        return f"{function}({', '.join(text for text, _ in arguments)})", ATOM

    def time_derivative(self, operand: Written) -> Written:
        return f"diff({operand[0]}, t)", ATOM

    def partial_derivative(self, operand: Written, variable: Written) -> Written:
        return f"diff({operand[0]}, {variable[0]})", ATOM

    def vector(self, components: tuple[Written, ...]) -> Written:
        return f"[{', '.join(text for text, _ in components)}]", ATOM

    def equation(self, left: Written, right: Written) -> Written:
        return f"{left[0]} = {right[0]}", SUM
