"""The reading position in a list of tokens, and the count of what has been made from them."""

from __future__ import annotations

import re
from typing import NoReturn, TypeVar

from .bounds import MAX_DEPTH, MAX_NODES
from .names import Names
from .tokens import Token, between, fail
from .tree import Node, Span

# A bracket with a sum of products in it takes up to three levels of the parser.
_MAX_NESTING = 2 * MAX_DEPTH

# What LaTeX says about sizes and spaces has no place in a reading that is shown as text.
_LAYOUT = re.compile(r"\\(?:m?left|m?right|[bB]igg?[lr]?)(?![A-Za-z])\s*|\\[,;:!> ]")

N = TypeVar("N", bound=Node)


class Cursor:
    """Tokens are looked at and taken; nodes are counted, and so is the nesting."""

    def __init__(self, text: str, tokens: list[Token], names: Names) -> None:
        self.text = text
        self.names = names
        self.depth = 0
        self._tokens = tokens
        self._at = 0
        self._nodes = 0

    @property
    def token(self) -> Token:
        """The token ahead."""
        return self._tokens[self._at]

    def at_end(self) -> bool:
        """Whether all tokens have been taken."""
        return self.token.kind == "end"

    @property
    def previous(self) -> Token:
        """The token last taken."""
        return self._tokens[max(self._at - 1, 0)]

    def ahead(self, distance: int = 1) -> Token:
        """The token `distance` places after the one ahead."""
        return self._tokens[min(self._at + distance, len(self._tokens) - 1)]

    def take(self) -> Token:
        """The token ahead, and step over it."""
        token = self.token
        self._at = min(self._at + 1, len(self._tokens) - 1)
        return token

    def takes(self, *operators: str) -> bool:
        """Step over one of these operators if it is ahead."""
        found = self.token.is_operator(*operators)
        if found:
            self.take()
        return found

    def mark(self) -> tuple[int, int, int]:
        """Where reading stands, to come back to it."""
        return self._at, self._nodes, self.depth

    def rewind(self, mark: tuple[int, int, int]) -> None:
        """Back to where `mark` was taken."""
        self._at, self._nodes, self.depth = mark

    def close(self, opening: Token) -> Span:
        """Step over the bracket that closes `opening`; the whole stretch."""
        wanted = {"(": ")", "[": "]", "": "", "|": "|"}[opening.text]
        if self.token.kind == "close" and self.token.text == wanted:
            return between(opening.span, self.take().span)
        if self.token.kind in ("end", "close"):
            fail("unclosed-bracket", opening.span, bracket=self.slice(opening.span), wanted=wanted)
        return self.unexpected()

    def unexpected(self) -> NoReturn:
        """Report the token ahead, which cannot stand here."""
        token = self.token
        if token.kind == "end":
            fail("unexpected-end", Span(len(self.text), 0))
        if token.kind == "close" and self.previous.kind == "open":
            fail("empty-brackets", between(self.previous.span, token.span))
        if token.kind == "close" and not self.previous.is_operator(",", ";", "+", "-", "*", "/", "^", "="):
            fail("unopened-bracket", token.span, bracket=self.slice(token.span))
        fail("unexpected-symbol", token.span, symbol=self.slice(token.span))

    def slice(self, span: Span) -> str:
        """The text at `span`, shortened."""
        return self.text[span.offset : span.offset + span.length].strip()[:80]

    def reading(self, span: Span) -> str:
        """The text at `span` as part of a reading: braces closed, without sizes and spaces of LaTeX."""
        end = span.offset + span.length
        while self.text.count("{", span.offset, end) > self.text.count("}", span.offset, end) and end < len(self.text):
            end += 1
        return _LAYOUT.sub("", self.text[span.offset : end]).strip()[:80]

    def made(self, node: N) -> N:
        """Count a node that was made."""
        self._nodes += 1
        if self._nodes > MAX_NODES:
            fail("too-many-nodes", node.span, limit=MAX_NODES)
        return node

    def descend(self) -> None:
        """One level deeper."""
        self.depth += 1
        if self.depth > _MAX_NESTING:
            fail("too-deep", self.token.span, limit=MAX_DEPTH)
