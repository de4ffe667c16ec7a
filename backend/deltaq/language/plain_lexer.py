"""Plain text → tokens of the common alphabet. Unicode letters, dots over letters, ², ·, √, δ and ∂ are understood."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator
from fractions import Fraction

from .names import Names
from .spelling import DOTTED_TWICE, GREEK, SUBSCRIPTS, SUPERSCRIPTS
from .tokens import Token, fail
from .tree import Span
from .words import word_tokens

MAX_DIGITS = 30

_GREEK = "".join(c for c in GREEK if c != "δ")
_SUB = "".join(SUBSCRIPTS)
_INDEX = rf"(?:_?[0-9{_SUB}]+|_[A-Za-z0-9]+|_\{{[A-Za-z0-9]+\}})"
_TOKEN = re.compile(
    rf"""
    (?P<space>[\s\u200b\u2060-\u2064\ufeff]+)
  | (?P<prefix>0[xXbBoO][0-9A-Fa-f]+)
  | (?P<number>(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d+)?(?P<again>\.\d*|_\d+)?)
  | (?P<second>d(?:\^2|\*\*2|²)\s*(?P<moved>[A-Za-z][A-Za-z0-9_{_SUB}]*|[{_GREEK}]{_INDEX}?|\(\s*[A-Za-z0-9_]+\s*\))?
      \s*/\s*(?:d\s*t|\(\s*dt\s*\))\s*(?:\^2|\*\*2|²)(?![0-9]))
  | (?P<ratio>d\s*/\s*d\s*(?:t(?![A-Za-z0-9_])|\(\s*t\s*\)))
  | (?P<word>(?:[A-Za-z][A-Za-z0-9_{_SUB}]*(?:(?<=_)(?:\{{[A-Za-z0-9]+\}}|[{_GREEK}]))?|[{_GREEK}]{_INDEX}?)
      (?:(?P<marks>[\u0307\u0308]+){_INDEX}?)?)
  | (?P<power>[{"".join(SUPERSCRIPTS)}]+)
  | (?P<fraction>[½¼¾⅓⅔⅙⅚⅛⅜⅝⅞])
  | (?P<operator>\*\*|[-+*/^,;=|'()\[\]]|(?<=[\w)\]])"|[·⋅×∗∙•−–÷∕⁄′’´″”√∂δ°])
    """,
    re.VERBOSE | re.ASCII,
)
_OPERATORS = {
    "**": "^",
    "−": "-",
    "–": "-",
    "÷": "/",
    "∕": "/",
    "⁄": "/",
    "′": "'",
    "’": "'",
    "´": "'",
    **dict.fromkeys("·⋅∗∙•", "*"),
}


def plain_tokens(text: str, names: Names) -> Iterator[Token]:
    """Yield the tokens of `text`, an "end" token last."""
    expanded, origin = _expand(text)
    position, after_number = 0, False
    while position < len(expanded):
        match = _TOKEN.match(expanded, position)
        if match is None:
            fail("unexpected-character", Span(origin[position], 1), character=expanded[position])
        start, end = origin[match.start()], origin[match.end()]
        span = Span(start, max(end - start, 1))
        yield from _lexeme(match, span, names, after_number=after_number)
        after_number = match.lastgroup == "number" or (after_number and match.lastgroup == "space")
        position = match.end()
    yield Token("end", "", Span(len(text), 0))


def _expand(text: str) -> tuple[str, list[int]]:
    """The text with ẋ split into x and its dot, and for each character where it came from."""
    expanded: list[str] = []
    origin: list[int] = []
    for position, character in enumerate(text):
        parts = unicodedata.normalize("NFD", character)
        dotted = len(parts) == 2 and (parts[1] == "\u0307" or (parts[1] == "\u0308" and parts[0] in DOTTED_TWICE))
        parts = parts if dotted else "ℓ" if character == "ℓ" else character
        expanded.append(parts)
        origin += [position] * len(parts)
    return "".join(expanded), [*origin, len(text)]


def _lexeme(match: re.Match[str], span: Span, names: Names, *, after_number: bool) -> Iterator[Token]:
    text = match[0]
    match match.lastgroup:
        case "space":
            pass
        case "prefix":
            fail("number-format", span, number=text[:40])
        case "number" | "again":
            yield number_token(text, span)
        case "ratio":
            yield Token("derivative", "d", span)
            yield Token("open", "", span)
            yield Token("name", "t", span)
            yield Token("close", "", span)
        case "second" | "moved":
            yield from _second_derivative(match, span, names)
        case "word" | "marks":
            yield from _word(match, span, names, after_number=after_number)
        case "power":
            yield Token("operator", "^", span)
            yield number_token("".join(SUPERSCRIPTS[c] for c in text), span)
        case "fraction":
            yield Token("number", text, span, Fraction(unicodedata.numeric(text)).limit_denominator(8))
        case _:
            yield from operator_tokens(text, span)


def _second_derivative(match: re.Match[str], span: Span, names: Names) -> Iterator[Token]:
    """d²φ/dt², or the operator d²/dt²."""
    yield Token("dot", "2", span)
    if match["moved"]:
        yield from word_tokens(match["moved"].strip("() "), span, names)


def _word(match: re.Match[str], span: Span, names: Names, *, after_number: bool) -> Iterator[Token]:
    marks = match["marks"] or ""
    tokens = list(word_tokens(match["word"].replace(marks, "") if marks else match["word"], span, names,
                              after_number=after_number))  # fmt: skip
    if marks:
        order = sum(1 if mark == "\u0307" else 2 for mark in marks)
        if order > 2:
            fail("derivative-order", span, order=order)
        tokens.insert(len(tokens) - 1, Token("dot", str(order), span))
    yield from tokens


def operator_tokens(text: str, span: Span) -> Iterator[Token]:
    """The tokens of one operator or bracket."""
    match text:
        case "(" | "[":
            yield Token("open", text, span)
        case ")" | "]":
            yield Token("close", text, span)
        case "″" | '"' | "”":
            yield Token("operator", "'", span)
            yield Token("operator", "'", span)
        case "√":
            yield Token("function", "sqrt", span)
        case "∂":
            yield Token("partial", text, span)
        case "δ":
            yield Token("variation", text, span)
        case "°":
            fail("unit", span, name=text)
        case _:
            yield Token("operator", _OPERATORS.get(text, text), span)


def number_token(text: str, span: Span) -> Token:
    """An exact number of at most 30 digits, its power of ten within 10^±30."""
    mantissa, _, exponent = text.lower().partition("e")
    if text.count(".") > mantissa.count(".") or mantissa.count(".") > 1 or "_" in text:
        fail("number-format", span, number=text[:40])
    if sum(map(str.isdigit, mantissa)) > MAX_DIGITS:
        fail("too-many-digits", span, limit=MAX_DIGITS)
    if exponent and (len(exponent) > 4 or abs(int(exponent)) > MAX_DIGITS):
        fail("number-range", span, number=text[:40], limit=MAX_DIGITS)
    return Token("number", text, span, Fraction(mantissa.rstrip(".")) * Fraction(10) ** int(exponent or 0))
