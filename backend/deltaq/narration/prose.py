"""Sentences of the catalogs: words, with formulas between dollar signs.

Only the catalogs and what δq writes itself may hold formulas. What users wrote is put in as words: its dollar signs are
written ＄, which opens no formula wherever the sentence is read.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from ..mechanics.user_text import UserText

DOLLAR, WORD_DOLLAR = "$", "＄"


class CatalogText(str):
    """A sentence in which whatever stands between two dollar signs is LaTeX made by δq, and nothing else is markup.

    Whatever is done to it as a string makes a mere string of it: that is words again, until a function of this module
    has looked at it.
    """

    __slots__ = ()


@dataclass(frozen=True)
class Piece:
    """A part of a sentence: LaTeX, or words as they are read."""

    text: str
    is_formula: bool


def formula(latex: str) -> CatalogText:
    """LaTeX that δq wrote, as part of a sentence. Raises ValueError if it would end before it ends."""
    if DOLLAR in latex:
        raise ValueError("a formula holds no dollar sign")
    return CatalogText(f"${latex}$") if latex else CatalogText("")


def words(text: object) -> CatalogText:
    """What it says, without any meaning but that; sentences of the catalogs stay what they are."""
    if isinstance(text, CatalogText):
        return text
    plain = text.line if isinstance(text, UserText) else str(text)
    return CatalogText(plain.replace(DOLLAR, WORD_DOLLAR))


def joined(separator: str, parts: Iterable[object]) -> CatalogText:
    """Several as one, with words between them."""
    return CatalogText(words(separator).join(map(words, parts)))


def pieces(sentence: CatalogText) -> Iterator[Piece]:
    """Words and formulas in their order. A dollar sign without a second one is a mistake of ours: KeyError names it."""
    parts = sentence.split(DOLLAR)
    if len(parts) % 2 == 0:
        raise KeyError(f"a formula does not end in {sentence!r}")
    for index, part in enumerate(parts):
        if part:
            yield Piece(part if index % 2 else part.replace(WORD_DOLLAR, DOLLAR), bool(index % 2))


def plain(sentence: CatalogText) -> str:
    """The sentence where no formulas are typeset: the dollar signs around them are left out."""
    return "".join(piece.text for piece in pieces(sentence))
