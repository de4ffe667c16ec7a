"""What the differential operators make of a tree: rates, δ, d, d/dt and ∂/∂x, and which of them are refused."""

from __future__ import annotations

from fractions import Fraction

from .cursor import Cursor
from .tokens import Token, between, fail
from .tree import (
    Differential,
    Name,
    Negation,
    Node,
    Number,
    PartialDerivative,
    Power,
    Product,
    Rate,
    Span,
    Sum,
    TimeDerivative,
    Variation,
    children,
    walk,
)

MAX_ORDER = 2
MAX_RATE = 4  # of a coordinate: equations of functionals with second rates have fourth ones


class Differentiation:
    """Differentiates operands that have been read; the cursor counts the nodes and knows the names."""

    def __init__(self, cursor: Cursor) -> None:
        self._cursor = cursor

    def kind(self, name: str) -> str:
        """What a name stands for (coordinate, time, parameter …), "" if it is not known."""
        symbol = self._cursor.names.get(name)
        return symbol.kind if symbol else ""

    def is_letter(self, token: Token) -> bool:
        """Whether d is the symbol of this name: there is one, and what stands there is neither d(x) nor dx."""
        if token.text != "d" or not self.kind("d"):
            return False
        first, second, third = (self._cursor.ahead(i) for i in range(3))
        joined = self._moves(first) and first.span == token.span
        called = first.kind == "open" and self._moves(second) and third.kind == "close"
        return not joined and not called

    def _moves(self, token: Token) -> bool:
        return token.kind == "name" and self.kind(token.text) in ("coordinate", "time")

    def time_derivative(self, operand: Node, span: Span) -> Node:
        """d/dt: a coordinate becomes its rate; anything else is kept for the chain rule, which an algebra carries out.

        Orders above two are refused, of coordinates those above four.
        """
        match operand:
            case Name(name) if self.kind(name) in ("coordinate", "multiplier"):
                return self._cursor.made(Rate(name, 1, span))
            case Rate(name, order) if order < MAX_RATE:
                return self._cursor.made(Rate(name, order + 1, span))
            case Variation(name, order) if order < MAX_ORDER:
                return self._cursor.made(Variation(name, order + 1, span))
            case Name(name):
                fail("rate-of-constant", span, name=name)
        self._check_order(operand, span)
        return self._cursor.made(TimeDerivative(operand, span))

    def quotient_of_differentials(self, upper: Node, lower: Node) -> Node | None:
        """dφ/dt is the rate φ̇, also after a sign or other factors; None if this is no such quotient."""
        span = between(upper.span, lower.span)
        match upper, lower:
            case Differential(name), Differential("t") if name != "t":
                return self._cursor.made(Rate(name, 1, span))
            case Power(Differential(name), Number(raised)), Power(Differential("t"), Number(below)) if (
                raised == below and name != "t"
            ):
                return self._cursor.made(Power(self._cursor.made(Rate(name, 1, span)), Number(raised, span), span))
            case Product((*others, last)), Power():
                power = self.quotient_of_differentials(last, lower)
                return power and Product((*others, power), span)
            case Negation(operand), Differential("t"):
                rate = self.quotient_of_differentials(operand, lower)
                return rate and Negation(rate, span)
            case Product((*others, last)), Differential("t"):
                rate = self.quotient_of_differentials(last, lower)
                return rate and Product((*others, rate), span)
        return None

    def variation(self, operand: Node, span: Span) -> Node:
        """δq and δq̇, and δ of an expression by the chain rule: Σ ∂f/∂q δq + ∂f/∂q̇ δq̇."""
        match operand:
            case Name(name) if self.kind(name) == "coordinate":
                return self._cursor.made(Variation(name, span=span))
            case Name(name):
                fail("variation-of-constant", span, name=name)
            case Rate(name, order):
                return self._cursor.made(Variation(name, order, span))
        if any(isinstance(n, (Variation, Differential)) for n in walk(operand)):
            fail("variation-of-variation", span)
        moving = [(name, order) for name, order in sorted(_arguments(operand)) if self.kind(name) == "coordinate"]
        return self._chain(
            operand, span, [(_jet(name, order, span), Variation(name, order, span)) for name, order in moving]
        )

    def differential(self, operand: Node, span: Span) -> Node:
        """dq and dt, and d of an expression by the chain rule: Σ ∂f/∂q dq + ∂f/∂t dt."""
        match operand:
            case Name(name) if self.kind(name) in ("coordinate", "time"):
                return self._cursor.made(Differential(name, span))
            case Name(name):
                fail("differential-of-constant", span, name=name)
        if any(isinstance(n, (Rate, Variation, Differential, TimeDerivative)) for n in walk(operand)):
            fail("differential-of-rate", span)
        moving = [name for name, _ in sorted(_arguments(operand)) if self.kind(name) in ("coordinate", "time")]
        return self._chain(operand, span, [(Name(name, span), Differential(name, span)) for name in moving])

    def partial(self, operand: Node, variable: Node, span: Span) -> Node:
        """∂/∂x for whatever may vary: π may not."""
        if not isinstance(variable, (Name, Rate)) or variable == Name("pi"):
            fail("derivative-variable", variable.span, text=self._cursor.slice(variable.span))
        return self._cursor.made(PartialDerivative(operand, variable, span))

    def _chain(self, operand: Node, span: Span, pairs: list[tuple[Node, Node]]) -> Node:
        """Σ ∂(operand)/∂(variable) · change over all pairs of a variable and its change."""
        for _ in pairs:
            for part in walk(operand):
                self._cursor.made(part)
        terms = [Product((PartialDerivative(operand, by, span), change), span) for by, change in pairs]
        if not terms:
            return self._cursor.made(Product((Number(Fraction(0), span), operand), span))
        return self._cursor.made(Sum(tuple(terms), span)) if len(terms) > 1 else terms[0]

    def _check_order(self, operand: Node, span: Span) -> None:
        order = _order(operand) + 1
        if order > MAX_ORDER:
            fail("derivative-order", span, order=order)
        if any(isinstance(n, Differential) for n in walk(operand)):
            fail("derivative-of-differential", span)


def _jet(name: str, order: int, span: Span) -> Name | Rate:
    """q, q̇ or q̈."""
    return Rate(name, order, span) if order else Name(name, span)


def _arguments(node: Node) -> set[tuple[str, int]]:
    """Names and orders of derivative that the value of a tree depends on; d/dt adds an order."""
    match node:
        case Name(name):
            return {(name, 0)}
        case Rate(name, order):
            return {(name, order)}
    inside = {argument for part in children(node) for argument in _arguments(part)}
    return inside | {(n, k + 1) for n, k in inside} if isinstance(node, TimeDerivative) else inside


def _order(node: Node) -> int:
    """The highest time derivative in a tree."""
    if isinstance(node, Rate | Variation):
        return node.order
    return max(map(_order, children(node)), default=0) + isinstance(node, TimeDerivative)
