"""Fractions, derivatives written as fractions, roots and environments in LaTeX."""

from __future__ import annotations

import re
from fractions import Fraction
from typing import TYPE_CHECKING

from .latex_source import Range, Source
from .latex_symbols import read_exponential_power
from .tokens import Token, fail
from .tree import Span

if TYPE_CHECKING:
    from .latex_lexer import LatexLexer

_D = re.compile(
    r"\s*(?:(?P<total>d|\\(?:mathrm|text|operatorname|mathit)\s*(?:\{\s*d\s*\}|d)|\\differentialD(?![A-Za-z])|\\dd(?![A-Za-z]))"
    r"|(?P<partial>\\partial(?![A-Za-z])|∂))\s*(?:\^\s*(?P<order>\{\s*\d\s*\}|\d))?(?:\\[,;!: ]|\s)*"
)
_VARIABLES = re.compile(r"[^+\-*/=]*\Z|\s*[({].*\Z", re.DOTALL)
_ORDER = re.compile(r"\s*\^\s*(?:\{\s*(\d)\s*\}|(\d))\s*\Z")
_MATRICES = frozenset({"matrix", "pmatrix", "bmatrix", "Bmatrix", "smallmatrix", "array"})
_SYSTEMS = frozenset(
    {"aligned", "align", "align*", "gathered", "gather", "gather*", "cases", "equation", "equation*", "split"}
)


def read_fraction(lexer: LatexLexer, name: str, start: int) -> None:
    """\\frac{a}{b}, \\frac12 and the derivatives \\frac{d}{dt}, \\frac{d x}{dt}, \\frac{\\partial f}{\\partial q}."""
    owner = lexer.since(start)
    upper = lexer.source.argument(owner, "\\" + name)
    lower = lexer.source.argument(owner, "\\" + name)
    if _read_derivative(lexer, upper, lower, lexer.since(start)):
        return
    span = lexer.since(start)
    lexer.found += [
        Token("open", "", Span(start, 0)),
        *lexer.grouped(upper),
        Token("operator", "/", Span(lower[0], 0)),
        *lexer.grouped(lower),
        Token("close", "", Span(span.offset + span.length, 0)),
    ]


def _read_derivative(lexer: LatexLexer, upper: Range, lower: Range, span: Span) -> bool:
    above, below = _head(lexer, upper), _head(lexer, lower)
    if above is None or below is None:
        return False
    kind, order, rest = above
    if kind != below[0] or not _VARIABLES.match(lexer.source.text, *below[2]):
        return False
    variables = _variables(lexer, below[2], span)
    if sum(times for _, times in variables) != order or order > 2:
        fail("derivative-order", span, order=max(order, sum(times for _, times in variables)))
    function = lexer.grouped(rest, "(") if lexer.source.text[slice(*rest)].strip() else []
    tokens = function
    for inside, times in reversed(variables):
        for _ in range(times):
            tokens = [Token("derivative", kind, span), *lexer.grouped(inside), *tokens]
            if function and (inside, times) != variables[0]:
                tokens = [Token("open", "(", span), *tokens, Token("close", ")", span)]
    lexer.found += tokens
    return True


def _head(lexer: LatexLexer, inside: Range) -> tuple[str, int, Range] | None:
    """Kind and order of the d or ∂ that starts a stretch, and what follows it."""
    match = _D.match(lexer.source.text, *inside)
    if match is None:
        return None
    order = int((match["order"] or "1").strip("{} "))
    return ("d" if match["total"] else "partial"), order, (match.end(), inside[1])


def _variables(lexer: LatexLexer, inside: Range, span: Span) -> list[tuple[Range, int]]:
    """The variables below the line: x, x^2, or x ∂y."""
    text = lexer.source.text
    found: list[tuple[Range, int]] = []
    start, end = inside
    while start < end:
        following = next((m for m in _D.finditer(text, start, end) if m["partial"]), None)
        stop = following.start() if following else end
        order = _ORDER.search(text[start:stop])
        times = int(order[1] or order[2]) if order else 1
        found.append(((start, start + order.start() if order else stop), times))
        start = following.end() if following else end
    if not found or not 1 <= sum(times for _, times in found) <= 3:
        fail("derivative-variable", span, text=text[slice(*inside)])
    return found


def read_root(lexer: LatexLexer, name: str, start: int) -> None:
    """\\sqrt{x} and \\sqrt[3]{x}."""
    index = lexer.source.optional()
    inside = lexer.source.argument(lexer.since(start), "\\" + name)
    span = lexer.since(start)
    if index is None:
        lexer.found += [Token("function", "sqrt", Span(start, inside[0] - start)), *lexer.grouped(inside, "(")]
        return
    one = lexer.grouped(index)
    lexer.found += [
        *(Token("open", "", Span(start, 0)), *lexer.grouped(inside, "("), Token("operator", "^", span)),
        *(Token("open", "", span), Token("number", "1", span, Fraction(1)), Token("operator", "/", span), *one),
        *(Token("close", "", span), Token("close", "", Span(lexer.source.at, 0))),
    ]


def read_exponential(lexer: LatexLexer, _name: str, start: int) -> None:
    """\\exponentialE^{…}"""
    if lexer.source.next() != "^":
        fail("euler-number", lexer.since(start), name="e")
    read_exponential_power(lexer, start)


def read_boxed(lexer: LatexLexer, name: str, start: int) -> None:
    """\\boxed{…}: a frame around a result says nothing about it."""
    lexer.found += lexer.within(lexer.source.argument(lexer.since(start), "\\" + name))


def read_environment(lexer: LatexLexer, _name: str, start: int) -> None:
    """Matrices become vectors; aligned equations and cases a system."""
    name, inside = lexer.source.environment(start)
    span = lexer.since(start)
    if name in _SYSTEMS:
        _read_system(lexer, inside)
    elif name in _MATRICES:
        _read_matrix(lexer, name, inside, span)
    else:
        fail("unknown-environment", span, name=name)


def _read_system(lexer: LatexLexer, inside: Range) -> None:
    rows = [(row[0][0], row[-1][1]) for row in _cells(lexer, inside)]
    filled = [row for row in rows if lexer.source.text[slice(*row)].strip()]
    for position, row in enumerate(filled):
        if position:
            lexer.found.append(Token("operator", ";", Span(row[0], 0)))
        lexer.found += lexer.within(row)


def _read_matrix(lexer: LatexLexer, name: str, inside: Range, span: Span) -> None:
    if name == "array":
        source = Source(lexer.source.text, *inside)
        source.argument(span, "array")
        inside = source.at, inside[1]
    rows = [row for row in _cells(lexer, inside) if lexer.source.text[row[0][0] : row[-1][1]].strip()]
    if not rows:
        fail("empty", span)
    if len(rows) == 1 or all(len(row) == 1 for row in rows):
        lexer.found += _vector([lexer.within(cell) for row in rows for cell in row], span)
    else:
        lexer.found += _vector([_vector([lexer.within(cell) for cell in row], span) for row in rows], span)


def _vector(parts: list[list[Token]], span: Span) -> list[Token]:
    tokens = [Token("open", "[", Span(span.offset, 1))]
    for position, part in enumerate(parts):
        if position:
            tokens.append(Token("operator", ",", Span(span.offset, 0)))
        tokens += part
    return [*tokens, Token("close", "]", Span(span.offset + span.length - 1, 1))]


def _cells(lexer: LatexLexer, inside: Range) -> list[list[Range]]:
    """Rows and cells between & and \\\\, not looking into groups and inner environments."""
    source = Source(lexer.source.text, *inside)
    rows: list[list[Range]] = [[]]
    start = source.at
    while source.rest:
        character = source.text[source.at]
        if character == "{":
            source.group()
        elif character == "&":
            rows[-1].append((start, source.at))
            source.at += 1
            start = source.at
        elif character == "\\":
            at = source.at
            command = source.command()
            if command == "begin":
                source.environment(at)
            elif command == "\\":
                rows[-1].append((start, at))
                rows.append([])
                start = source.at
        else:
            source.at += 1
    rows[-1].append((start, source.end))
    return rows
