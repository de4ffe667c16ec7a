"""Text → Expression. The one way in: what anyone types goes through here.

Both syntaxes are read by their lexer into one alphabet of tokens, and by one Pratt parser (V. R. Pratt, "Top down
operator precedence", 1973) into one tree. Nothing is ever evaluated as a program, and every bound is checked first.
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import islice
from typing import Literal

from .bounds import MAX_CHARACTERS, MAX_NODES, check_bounds
from .choices import Choices
from .expression import Expression
from .grammar import Grammar
from .names import Names
from .plain_lexer import plain_tokens
from .tokens import Token, fail
from .tree import Span

Syntax = Literal["plain", "latex"]

MAX_TOKENS = 4 * MAX_NODES


def parse(text: str, names: Names, syntax: Syntax = "plain", choices: Choices | None = None) -> Expression:
    """The expression that `text` means, with all names resolved among `names`; `choices` are of answers only.

    Raises ExpressionError with one Problem: code, offset and length in the text, parameters (a suggestion among them
    where there is one).
    """
    if len(text) > MAX_CHARACTERS:
        fail("too-long", Span(MAX_CHARACTERS, len(text) - MAX_CHARACTERS), length=len(text), limit=MAX_CHARACTERS)
    tokens = list(islice(_tokens(text, names, syntax), MAX_TOKENS + 1))
    if len(tokens) > MAX_TOKENS:
        fail("too-many-nodes", Span(0, len(text)), limit=MAX_NODES)
    tree = Grammar(text, tokens, names, choices).whole()
    check_bounds(tree)
    return Expression(text, tree)


def _tokens(text: str, names: Names, syntax: Syntax) -> Iterable[Token]:
    if syntax == "plain":
        return plain_tokens(text, names)
    from .latex_lexer import latex_tokens  # noqa: PLC0415 - scenes are read without it

    return latex_tokens(text, names)
