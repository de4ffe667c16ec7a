"""Brackets: ( … ), [a, b] and | … |."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from .tokens import Token, between, fail
from .tree import Node, Vector

if TYPE_CHECKING:
    from .grammar import Grammar


class Brackets:
    """Reads what stands in brackets."""

    def __init__(self, grammar: Grammar) -> None:
        self._grammar = grammar
        self._cursor = grammar.cursor
        self.inside_bars = 0

    def absolute(self, opening: Token) -> Node:
        self.inside_bars += 1
        inner = self._grammar.expression()
        self.inside_bars -= 1
        if not self._cursor.token.is_operator("|"):
            fail("unclosed-bracket", opening.span, bracket="|", wanted="|")
        return self._grammar.arguments.made("abs", (inner,), between(opening.span, self._cursor.take().span))

    def bracket(self) -> Node:
        opening = self._cursor.take()
        bars, self.inside_bars = self.inside_bars, 0
        if opening.text == "[":
            node = self._vector(opening)
        else:
            node = self._grammar.expression()
            self._comma(opening)
            self._cursor.close(opening)
        self.inside_bars = bars
        return replace(node, span=between(opening.span, self._cursor.previous.span))

    def _comma(self, opening: Token) -> None:
        """`(9,81)` is a decimal comma, `(a, b)` a vector in the wrong brackets."""
        if self._cursor.token.is_operator(","):
            self.decimal_comma()
            fail("vector-brackets", between(opening.span, self._cursor.token.span))
        if self._cursor.token.is_operator("=", ";"):
            self._cursor.unexpected()

    def _vector(self, opening: Token) -> Node:
        parts = [self._grammar.equation()]
        while self._cursor.takes(",", ";"):
            parts.append(self._grammar.equation())
        span = self._cursor.close(opening)
        if len(parts) == 1:
            return parts[0]
        if self._cursor.takes("T"):
            span = between(span, self._cursor.previous.span)
        return self._cursor.made(Vector(tuple(parts), span))

    def decimal_comma(self) -> None:
        before, after = self._cursor.previous, self._cursor.ahead()
        if before.kind == "number" and after.kind == "number":
            number = f"{self._cursor.slice(before.span)}.{self._cursor.slice(after.span)}"
            fail("decimal-comma", between(before.span, after.span), suggestion=number)
