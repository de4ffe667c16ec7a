"""One word of plain text → tokens: a symbol, a function, an operator, or several of them written without `*`."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NoReturn

from .functions import OPERATORS, REFUSED_FUNCTIONS, SPELLINGS
from .names import Names, Symbol
from .spelling import GREEK_NAMES, folded
from .tokens import Token, fail
from .tree import Span

UNITS = frozenset(
    {"m", "s", "kg", "g", "N", "J", "W", "Hz", "rad", "deg", "K", "A", "V", "C", "T", "Pa", "kN", "MPa", "GPa"}
) | {"Nm", "cm", "mm", "km", "kHz", "kJ", "Ns", "grad", "sec", "min"}
_MAX_READINGS = 3
_MAX_COMPOUND = 40
_ACCENTS = ("ddot", "dot")


def word_tokens(word: str, span: Span, names: Names, *, after_number: bool = False) -> Iterator[Token]:
    """The tokens that a word means.

    A known symbol is itself; else `mgl` is read as m·g·l if all parts are known and there is only one way to do so.
    """
    if word in OPERATORS:
        yield _operator(word, span)
        return
    found = names.candidates(word)
    if len(found) > 1:
        fail("ambiguous-name", span, text=word, first=found[0].name, second=found[1].name)
    if found:
        yield Token("name", found[0].name, span)
    elif word in SPELLINGS:
        yield Token("function", SPELLINGS[word].name, span)
    else:
        yield from _compound(word, span, names, after_number=after_number)


def unknown(word: str, span: Span, names: Names) -> NoReturn:
    """Report an unknown word, with what may have been meant."""
    if word in REFUSED_FUNCTIONS:
        fail("function-not-allowed", span, name=word)
    if word in UNITS:
        fail("unit", span, name=word)
    if word == "e":
        fail("euler-number", span, name=word)
    suggestions = _primed(word, names) or names.suggestions(word)
    known = ", ".join(s.name for s in names.symbols[:12])
    if suggestions:
        fail("unknown-name", span, name=word[:40], known=known, suggestion=", ".join(suggestions))
    fail("unknown-name", span, name=word[:40], known=known)


def _operator(word: str, span: Span) -> Token:
    match word:
        case "dot" | "ddot" | "dddot" | "ddddot":
            return Token("dot", str(word.count("d")), span)
        case "delta":
            return Token("variation", word, span)
        case "d":
            return Token("differential", word, span)
        case _:
            return Token("diff", word, span)


def _compound(word: str, span: Span, names: Names, *, after_number: bool) -> Iterator[Token]:
    if after_number and word in UNITS:
        fail("unit", span, name=word)
    prefixed = tuple(_prefixed(word, span, names)) or tuple(_dotted(word, span, names))
    if prefixed:
        yield from prefixed
        return
    one_word = len(word) > _MAX_COMPOUND or word in REFUSED_FUNCTIONS or word in GREEK_NAMES
    readings = [] if one_word else _splits(word, names)
    if len(readings) > 1:
        first, second = ("*".join(part for part, _ in reading) for reading in readings[:2])
        fail("ambiguous-product", span, text=word, first=first, second=second)
    if not readings:
        unknown(word, span, names)
    offset = span.offset
    for part, meaning in readings[0]:
        where = Span(offset, len(part)) if len(word) == span.length else span
        yield Token("name", meaning.name, where) if isinstance(meaning, Symbol) else Token("function", meaning, where)
        offset += len(part)


def _prefixed(word: str, span: Span, names: Names) -> Iterator[Token]:
    """`dphi`, `dt` and `deltaphi`: an operator written together with its coordinate."""
    for prefix, kinds in (("delta_", ("coordinate",)), ("delta", ("coordinate",)), ("d", ("coordinate", "time"))):
        rest = word.removeprefix(prefix)
        symbol = names.resolve(rest) if rest not in (word, "") else None
        if symbol is not None and symbol.kind in kinds:
            yield _operator(prefix.rstrip("_"), span)
            yield Token("name", symbol.name, span)
            return


def _splits(word: str, names: Names) -> list[tuple[tuple[str, Symbol | str], ...]]:
    """All ways (up to three) to read a word as a product of different symbols, functions among them: gsinphi."""
    ways: list[list[tuple[tuple[str, Symbol | str], ...]]] = [[] for _ in range(len(word) + 1)]
    ways[len(word)] = [()]
    for start in reversed(range(len(word))):
        for end in range(start + 1, len(word) + 1):
            if not ways[end] or not word[start].isalpha():
                continue
            part = word[start:end]
            meaning: Symbol | str | None = names.resolve(part)
            if meaning is None and part in SPELLINGS and len(part) > 2 and part != word:
                meaning = SPELLINGS[part].name
            if meaning is not None and not part.endswith("_"):
                ways[start] += [((part, meaning), *rest) for rest in ways[end]]
        del ways[start][_MAX_READINGS:]
    return [way for way in ways[0] if len({part for part, _ in way}) == len(way)]


def _dotted(word: str, span: Span, names: Names) -> Iterator[Token]:
    """`phidot`, `phi_ddot`: a rate written as one word."""
    for accent in _ACCENTS:
        base = word.removesuffix(accent).rstrip("_")
        symbol = names.resolve(base) if base not in (word, "") else None
        if symbol is not None and symbol.kind == "coordinate":
            yield _operator(accent, span)
            yield Token("name", symbol.name, span)
            return


def _primed(word: str, names: Names) -> tuple[str, ...]:
    """`phip`: what to write instead, phi' or its rate, is not known; the coordinate is."""
    return tuple(name for name in names.coordinates if folded(word) == name + "p")
