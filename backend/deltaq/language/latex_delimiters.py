"""Brackets in LaTeX: \\left and \\right, sizes, bars, and square brackets that only group."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .tokens import Token, fail
from .tree import Span

if TYPE_CHECKING:
    from .latex_lexer import LatexLexer


def close_bracket(lexer: LatexLexer, opening: int) -> None:
    """Square brackets without a comma are parentheses."""
    first, last = lexer.found[opening], lexer.found[-1]
    if (first.text, last.text) == ("[", "]") and not _has_comma(lexer.found[opening + 1 : -1]):
        lexer.found[opening] = Token("open", "(", first.span)
        lexer.found[-1] = Token("close", ")", last.span)


def _has_comma(tokens: list[Token]) -> bool:
    depth = 0
    for token in tokens:
        depth += (token.kind == "open") - (token.kind == "close")
        if depth == 0 and token.is_operator(",", ";"):
            return True
    return False


def separate(lexer: LatexLexer) -> None:
    """A wide space separates the components of a row in square brackets: [F_x \\quad F_y]^T."""
    if lexer.brackets and lexer.found[lexer.brackets[-1]].text == "[" and not lexer.found[-1].is_operator(","):
        lexer.found.append(Token("operator", ",", Span(lexer.source.at, 0)))


def read_sized(lexer: LatexLexer, size: str, start: int) -> None:
    """\\left, \\right and the like: what they enlarge follows."""
    character = lexer.source.next()
    right = size in ("right", "mright")
    if character == ".":
        lexer.source.at += 1
        if right and lexer.brackets:
            _end_system(lexer)
    elif character == "|" or lexer.source.peek_command() in ("vert", "lvert", "rvert"):
        lexer.source.at += 1 if character == "|" else len(lexer.source.peek_command()) + 1
        _bar(lexer, size, lexer.since(start))
    elif character == "" or character not in "()[]\\":
        fail("missing-argument", Span(start, len(size) + 1), name="\\" + size)


def _end_system(lexer: LatexLexer) -> None:
    """A brace before the lines of a system needs no other; a parenthesis without the other is a slip that is told."""
    span = lexer.found[lexer.brackets[-1]].span
    if lexer.source.text[span.offset : span.offset + span.length] in ("\\{", "\\lbrace"):
        del lexer.found[lexer.brackets.pop()]


def _bar(lexer: LatexLexer, size: str, span: Span) -> None:
    if size in ("left", "mleft"):
        lexer.found += [Token("function", "abs", span), Token("open", "|", span)]
    elif size in ("right", "mright"):
        lexer.found.append(Token("close", "|", span))
    else:
        lexer.found.append(Token("operator", "|", span))
