"""Symbols in LaTeX: letters with indices, accents, upright words."""

from __future__ import annotations

import re
import unicodedata
from typing import TYPE_CHECKING

from .functions import SPELLINGS
from .latex_source import Range
from .spelling import DOTTED_TWICE, GREEK_NAMES, key
from .tokens import Token, fail
from .tree import Span
from .words import UNITS, word_tokens

if TYPE_CHECKING:
    from .latex_lexer import LatexLexer

_LETTERS = re.compile(r"[A-Za-z]+")
_SIMPLE = re.compile(r"\s*(?:\\([A-Za-z]+)|([A-Za-z])|([^\x00-\x7f]))\s*\Z")
_MARKS = re.compile(r"[\u0307\u0308]+")
_INDEX = re.compile(r"(?:[A-Za-z0-9,\s]|\\(?:mathrm|text|mathit)\b|\\[A-Za-z]+|[{}])*\Z")


def dotted(character: str) -> tuple[str, int]:
    """Base and number of dots of a letter such as ẋ; ä, ö and ü are letters of their own."""
    parts = unicodedata.normalize("NFD", character)
    base, marks = parts[0], parts[1:]
    if marks == "\u0307":
        return base, 1
    return (base, 2) if marks == "\u0308" and base in DOTTED_TWICE else (character, 0)


def read_letters(lexer: LatexLexer) -> None:
    """A run of letters: one symbol for each letter, or one word if only that makes sense."""
    start = lexer.source.at
    match = lexer.source.match(_LETTERS)
    run = match[0] if match else ""
    if len(run) == 1 and lexer.source.rest and lexer.source.text[lexer.source.at] in "\u0307\u0308":
        read_symbol(lexer, run, start)
        return
    if run == "e" and lexer.source.next() == "^" and lexer.names.get("e") is None:
        read_exponential_power(lexer, start)
        return
    letters_end = lexer.source.at
    index, power, span = _index_and_power(lexer, start)
    if len(run) > 1:
        single = [lexer.names.resolve(letter) for letter in run[:-1]] + [lexer.names.resolve(run[-1] + index)]
        whole = lexer.names.candidates(run + index) or (run in SPELLINGS and not index)
        if all(single):
            if whole:
                product = "*".join(symbol.name for symbol in single if symbol)
                fail("ambiguous-product", span, text=run + index, first=product, second=run + index)
            _check_unit(lexer, run, span)
            for i, symbol in enumerate(single):
                last = Span(letters_end - 1, span.offset + span.length - letters_end + 1)
                where = Span(start + i, 1) if i < len(run) - 1 else last
                lexer.found.append(Token("name", symbol.name if symbol else "", where))
            lexer.found += power
            return
    lexer.found += word_tokens(run + index, span, lexer.names, after_number=lexer.after_number())
    lexer.found += power


def _check_unit(lexer: LatexLexer, run: str, span: Span) -> None:
    if lexer.after_number() and run in UNITS:
        fail("unit", span, name=run)


def read_symbol(lexer: LatexLexer, base: str, start: int, before: tuple[Token, ...] = ()) -> None:
    """A single letter or Greek name with its index and power; `before` are the tokens of an accent."""
    simple = _SIMPLE.match(base if base.startswith("\\") or len(base) == 1 else "\\" + base)
    if simple is None or (simple[1] and simple[1] not in GREEK_NAMES):
        fail("indexed-operator", lexer.since(start), name=base.strip()[:40])
    dots = lexer.source.match(_MARKS)
    if dots:
        order = sum(1 if mark == "\u0307" else 2 for mark in dots[0])
        if order > 2:
            fail("derivative-order", lexer.since(start), order=order)
        before = (*before, Token("dot", str(order), lexer.since(start)))
    index, power, span = _index_and_power(lexer, start)
    word = key(base.strip().removeprefix("\\")) + index
    lexer.found += [*before, *word_tokens(word, span, lexer.names), *power]


def _index_and_power(lexer: LatexLexer, begin: int) -> tuple[str, list[Token], Span]:
    """The index and the power after a symbol, in either order; where the symbol stands without its power."""
    index = _index(lexer)
    span = lexer.since(begin)
    if lexer.source.next() != "^":
        return index, [], span
    mark = len(lexer.found)
    start = lexer.source.at
    lexer.source.at += 1
    lexer.superscript(start)
    power = lexer.found[mark:]
    del lexer.found[mark:]
    return index or _index(lexer), power, span


def _index(lexer: LatexLexer) -> str:
    if lexer.source.next() != "_":
        return ""
    start = lexer.source.at
    lexer.source.at += 1
    inside = lexer.source.argument(Span(start, 1), "_")
    content = lexer.source.text[slice(*inside)]
    if not _INDEX.match(content):
        fail("unexpected-symbol", Span(inside[0], inside[1] - inside[0]), symbol=content.strip()[:40])
    return "_" + key(content).replace(",", "")


def read_accent(lexer: LatexLexer, name: str, start: int) -> None:
    """\\dot and \\ddot over a symbol, whose index stands outside or inside, or over an expression."""
    inside = lexer.source.argument(lexer.since(start), "\\" + name)
    span = lexer.since(start)
    if name == "dddot":
        fail("derivative-order", span, order=3)
    accent = Token("dot", "1" if name == "dot" else "2", span)
    content = lexer.source.text[slice(*inside)]
    simple = _SIMPLE.match(content)
    if simple and (simple[2] or simple[3] or simple[1] in GREEK_NAMES):
        read_symbol(lexer, content.strip(), start, (accent,))
    else:
        lexer.found += [accent, *lexer.grouped(inside)]


def read_upright(lexer: LatexLexer, start: int) -> None:
    """\\mathrm{…}, \\text{…}, \\operatorname{…}: d, e, a function, a symbol; a unit is refused."""
    inside = lexer.source.argument(lexer.since(start), "\\mathrm")
    word = lexer.source.text[slice(*inside)].strip()
    span = lexer.since(start)
    if word == "d":
        lexer.found.append(Token("differential", "d", span))
    elif word == "e" and lexer.source.next() == "^":
        read_exponential_power(lexer, start)
    elif word in SPELLINGS:
        lexer.found.append(Token("function", SPELLINGS[word].name, span))
    elif word in UNITS and lexer.source.next() != "_" and not _is_typeset_upright(lexer, word):
        fail("unit", span, name=word)
    else:
        _read_upright_symbol(lexer, word, inside, start)


def _is_typeset_upright(lexer: LatexLexer, word: str) -> bool:
    """Whether the scene itself writes this symbol upright; else upright letters are units."""
    return any("rm" in s.typeset for s in lexer.names.candidates(word))


def _read_upright_symbol(lexer: LatexLexer, word: str, inside: Range, start: int) -> None:
    if not re.fullmatch(r"\\?[A-Za-z][A-Za-z0-9]*", word):
        units = re.findall(r"(?<![A-Za-z\\])[A-Za-z]+", word)
        if units and UNITS.issuperset(units):
            fail("unit", Span(inside[0], inside[1] - inside[0]), name=units[0])
        fail("unexpected-symbol", Span(inside[0], max(inside[1] - inside[0], 1)), symbol=word[:40])
    index, power, span = _index_and_power(lexer, start)
    lexer.found += [*word_tokens(key(word) + index, span, lexer.names), *power]


def read_exponential_power(lexer: LatexLexer, start: int) -> None:
    """e^{…}: the exponential function."""
    lexer.source.skip_space()
    lexer.source.at += 1
    inside = lexer.source.argument(lexer.since(start), "e^")
    lexer.found += [Token("function", "exp", Span(start, inside[0] - start)), *lexer.grouped(inside, "(")]
