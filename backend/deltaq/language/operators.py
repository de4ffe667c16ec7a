"""The differential operators of the language: dots and primes, δ, d, d/dt and ∂/∂x."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

from .tokens import Token, between, fail
from .tree import (
    Differential,
    Name,
    Node,
    Number,
    PartialDerivative,
    Product,
    Rate,
    Span,
    Sum,
    TimeDerivative,
    Variation,
    walk,
)

if TYPE_CHECKING:
    from .grammar import Grammar

MAX_ORDER = 2


class Operators:
    """Reads what starts with a name or with a differential operator."""

    def __init__(self, grammar: Grammar) -> None:
        self._grammar = grammar
        self._cursor = grammar.cursor

    def name(self) -> Node:
        """A symbol. `phi(t)` is the coordinate φ as a function of time, not φ·t."""
        token = self._cursor.take()
        node = self._cursor.made(Name(token.text, token.span))
        if self._kind(token.text) == "coordinate" and self._is_of_time():
            for _ in range(3):
                self._cursor.take()
        return node

    def _is_of_time(self) -> bool:
        ahead = [self._cursor.ahead(i) for i in range(3)]
        return ahead[0].kind == "open" and ahead[0].text == "(" and ahead[1].text == "t" and ahead[2].kind == "close"

    def _kind(self, name: str) -> str:
        symbol = self._cursor.names.get(name)
        return symbol.kind if symbol else ""

    def operator(self) -> Node:
        """The operator ahead, applied."""
        token = self._cursor.take()
        match token.kind:
            case "dot":
                return self._dot(token)
            case "variation":
                return self._variation(token)
            case "differential":
                return self._differential(token)
            case "diff":
                return self._diff(token)
            case "partial":
                return self._partial(token)
            case _:
                return self._derivative(token)

    def _dot(self, token: Token) -> Node:
        self._expect_operand(token)
        operand = self._grammar.atom()
        node = operand
        for _ in range(int(token.text)):
            node = self.time_derivative(node, between(token.span, self._cursor.previous.span))
        return node

    def time_derivative(self, operand: Node, span: Span) -> Node:
        """d/dt: a coordinate becomes its rate; anything else is kept for the chain rule, which an algebra carries out.

        Orders above two do not occur in the equations of motion and are refused.
        """
        match operand:
            case Name(name) if self._kind(name) == "coordinate":
                return self._cursor.made(Rate(name, 1, span))
            case Rate(name, order) if order < MAX_ORDER:
                return self._cursor.made(Rate(name, order + 1, span))
            case Name(name):
                fail("rate-of-constant", span, name=name)
        self._check_order(operand, span)
        return self._cursor.made(TimeDerivative(operand, span))

    def _check_order(self, operand: Node, span: Span) -> None:
        order = _order(operand) + 1
        if order > MAX_ORDER:
            fail("derivative-order", span, order=order)
        if any(isinstance(n, (Variation, Differential)) for n in walk(operand)):
            fail("derivative-of-variation", span)

    def _variation(self, token: Token) -> Node:
        """δq, and δ of an expression by the chain rule: Σ ∂f/∂q δq."""
        self._expect_operand(token)
        operand = self._grammar.atom()
        span = between(token.span, self._cursor.previous.span)
        match operand:
            case Name(name) if self._kind(name) == "coordinate":
                return self._cursor.made(Variation(name, span))
            case Name(name):
                fail("variation-of-constant", span, name=name)
        self._check_plain(operand, span)
        return self._chain(operand, span, [n for n in self._used(operand) if self._kind(n) == "coordinate"], Variation)

    def _differential(self, token: Token) -> Node:
        """dq and dt, and d of an expression by the chain rule: Σ ∂f/∂q dq + ∂f/∂t dt."""
        self._expect_operand(token)
        operand = self._grammar.atom()
        span = between(token.span, self._cursor.previous.span)
        match operand:
            case Name(name) if self._kind(name) in ("coordinate", "time"):
                return self._cursor.made(Differential(name, span))
            case Name(name):
                fail("differential-of-constant", span, name=name)
        self._check_plain(operand, span)
        moving = [n for n in self._used(operand) if self._kind(n) in ("coordinate", "time")]
        return self._chain(operand, span, moving, Differential)

    def _check_plain(self, operand: Node, span: Span) -> None:
        if any(isinstance(n, (Rate, Variation, Differential, TimeDerivative)) for n in walk(operand)):
            fail("variation-of-rate", span)

    def _used(self, node: Node) -> list[str]:
        return sorted({n.name for n in walk(node) if isinstance(n, Name)})

    def _chain(self, operand: Node, span: Span, by: list[str], kind: type[Variation | Differential]) -> Node:
        for _ in by:
            for part in walk(operand):
                self._cursor.made(part)
        terms = [Product((PartialDerivative(operand, Name(n, span), span), kind(n, span)), span) for n in by]
        if not terms:
            return self._cursor.made(Product((Number(Fraction(0), span), operand), span))
        return self._cursor.made(Sum(tuple(terms), span)) if len(terms) > 1 else terms[0]

    def _diff(self, token: Token) -> Node:
        """diff(f, x), diff(f, x, y), diff(f, t, 2)."""
        opening = self._cursor.token
        if opening.kind != "open" or opening.text != "(":
            fail("brackets-expected", token.span, name="diff")
        self._cursor.take()
        node = self._grammar.expression()
        if not self._cursor.takes(","):
            fail("argument-count", between(token.span, self._cursor.token.span), function="diff", wanted=2, found=1)
        while True:
            variable = self._grammar.expression()
            repeat = self._repeat()
            for _ in range(repeat):
                node = self._derived(node, variable, between(token.span, variable.span))
            if not self._cursor.takes(","):
                break
        self._cursor.close(opening)
        return node

    def _repeat(self) -> int:
        if not (self._cursor.token.is_operator(",") and self._cursor.ahead().kind == "number"):
            return 1
        self._cursor.take()
        token = self._cursor.take()
        if token.value not in (1, 2):
            fail("derivative-order", token.span, order=self._cursor.slice(token.span))
        return int(token.value)

    def _derived(self, node: Node, variable: Node, span: Span) -> Node:
        """The derivative with respect to t is taken along the motion, any other is partial."""
        match variable:
            case Name("t"):
                return self.time_derivative(node, span)
            case Name() | Rate():
                return self._cursor.made(PartialDerivative(node, variable, span))
        fail("derivative-variable", variable.span, text=self._cursor.slice(variable.span))

    def _partial(self, token: Token) -> Node:
        """∂/∂x (…), or ∂(…)/∂x with the function on top."""
        on_top = None if self._cursor.token.is_operator("/") else self._grammar.atom()
        if not self._cursor.takes("/") or self._cursor.token.kind != "partial":
            fail("partial-derivative", token.span)
        self._cursor.take()
        variable = self._grammar.atom()
        return self._applied(token, "partial", variable, on_top)

    def _derivative(self, token: Token) -> Node:
        """Operator form from a fraction: (variable), then the operand."""
        variable = self._grammar.atom()
        order = 1
        if self._cursor.takes("^"):
            order = int(self._cursor.take().value)
        node = self._applied(token, token.text, variable, None)
        for _ in range(order - 1):
            node = self._once(token.text, node, variable, node.span)
        return node

    def _applied(self, token: Token, kind: str, variable: Node, operand: Node | None) -> Node:
        if operand is None:
            operand = self._operand(token)
        return self._once(kind, operand, variable, between(token.span, self._cursor.previous.span))

    def _once(self, kind: str, operand: Node, variable: Node, span: Span) -> Node:
        if kind == "d":
            if variable != Name("t"):
                fail("total-derivative", variable.span, text=self._cursor.slice(variable.span))
            return self.time_derivative(operand, span)
        if not isinstance(variable, (Name, Rate)):
            fail("derivative-variable", variable.span, text=self._cursor.slice(variable.span))
        return self._cursor.made(PartialDerivative(operand, variable, span))

    def _operand(self, token: Token) -> Node:
        """What d/dt applies to: brackets, or one factor if nothing follows that it could apply to as well."""
        opening = self._cursor.token
        self._cursor.takes("*")
        bracketed = opening.kind == "open" and opening.text != ""
        operand = self._grammar.atom() if bracketed else self._grammar.factor()
        following = self._cursor.token
        divided = following.is_operator("^") if bracketed else following.is_operator("*", "/")
        if divided or (not bracketed and self._grammar.starts_factor()):
            if following.kind == "operator":
                self._cursor.take()
            rest = self._grammar.factor().span
            sign = self._cursor.slice(Span(token.span.offset, operand.span.offset - token.span.offset))
            near, all_ = self._cursor.slice(operand.span), between(operand.span, rest)
            after = self._cursor.slice(between(following.span, rest))
            first, second = f"({sign} {near}) {after}", f"{sign} ({self._cursor.slice(all_)})"
            fail("ambiguous", between(token.span, rest), first=first, second=second)
        return operand

    def _expect_operand(self, token: Token) -> None:
        ahead = self._cursor.token
        if ahead.kind not in ("name", "open", "dot", "function"):
            fail("operand-expected", token.span, operator=self._cursor.slice(token.span))


def _order(node: Node) -> int:
    """The highest time derivative in a tree."""
    match node:
        case Rate(_, order):
            return order
        case TimeDerivative(operand):
            return _order(operand) + 1
    return max((n.order for n in walk(node) if isinstance(n, Rate)), default=0)
