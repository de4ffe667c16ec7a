"""Derivatives: diff(f, x), d/dt, ∂/∂x and the same as fractions."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .tokens import Token, between, fail
from .tree import Name, Node, Number, PartialDerivative, Rate, Span

if TYPE_CHECKING:
    from .grammar import Grammar


class Derivatives:
    """Reads the operators that differentiate."""

    def __init__(self, grammar: Grammar) -> None:
        self._grammar = grammar
        self._cursor = grammar.cursor

    def diff(self, token: Token) -> Node:
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
        if variable == Name("t"):
            return self._grammar.operators.time_derivative(node, span)
        return self._partial(node, variable, span)

    def _partial(self, operand: Node, variable: Node, span: Span) -> Node:
        """∂/∂x for whatever may vary: π may not."""
        if not isinstance(variable, (Name, Rate)) or variable == Name("pi"):
            fail("derivative-variable", variable.span, text=self._cursor.slice(variable.span))
        return self._cursor.made(PartialDerivative(operand, variable, span))

    def partial(self, token: Token) -> Node:
        """∂/∂x (…), or ∂(…)/∂x with the function on top."""
        on_top = None if self._cursor.token.is_operator("/") else self._grammar.atom()
        if not self._cursor.takes("/") or self._cursor.token.kind != "partial":
            fail("partial-derivative", token.span)
        self._cursor.take()
        variable = self._grammar.atom()
        return self._applied(token, "partial", variable, on_top)

    def derivative(self, token: Token) -> Node:
        """Operator form from a fraction: (variable), perhaps a power of the operator, then the operand."""
        variable = self._grammar.atom()
        order = self._order()
        node = self._applied(token, token.text, variable, None)
        for _ in range(order - 1):
            node = self._once(token.text, node, variable, node.span)
        return node

    def _order(self) -> int:
        if not self._cursor.takes("^"):
            return 1
        power = self._grammar.atom()
        if not isinstance(power, Number) or power.value not in (1, 2):
            fail("derivative-order", power.span, order=self._cursor.slice(power.span))
        return int(power.value)

    def _applied(self, token: Token, kind: str, variable: Node, operand: Node | None) -> Node:
        if operand is None:
            operand = self._operand(token)
        return self._once(kind, operand, variable, between(token.span, self._cursor.previous.span))

    def _once(self, kind: str, operand: Node, variable: Node, span: Span) -> Node:
        if kind == "d":
            if variable != Name("t"):
                fail("total-derivative", variable.span, text=self._cursor.slice(variable.span))
            return self._grammar.operators.time_derivative(operand, span)
        return self._partial(operand, variable, span)

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
            sign = self._cursor.reading(Span(token.span.offset, operand.span.offset - token.span.offset))
            near, all_ = self._cursor.reading(operand.span), between(operand.span, rest)
            after = self._cursor.reading(between(following.span, rest))
            first, second = f"({sign} {near}) {after}", f"{sign} ({self._cursor.reading(all_)})"
            fail("ambiguous", between(token.span, rest), first=first, second=second)
        return operand
