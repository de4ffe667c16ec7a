"""What users write to be read by people: titles, summaries, labels. It is words, never markup, however it is shown.

It is no `str`, so that it cannot slip into LaTeX, Markdown or HTML by being joined to it: whoever shows it says how.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

# Controls, halves of pairs, separators of lines, and what turns the direction of the text that follows.
UNSEEN = re.compile(r"[\x00-\x1f\x7f-\x9f\ud800-\udfff\u2028\u2029\u202a-\u202e\u2066-\u2069\ufeff\ufffe\uffff]")
LONGEST = 1000  # signs of one text
FORMULA = ("=", "+", "-", "@", "\t", "\r", "\n", "＝", "＋", "－", "＠")  # what a spreadsheet takes for a formula


@dataclass(frozen=True, order=True)
class UserText:
    """A text as it was written. Raises TypeError where it is turned into a string without saying how."""

    plain: str

    def __bool__(self) -> bool:
        """Whether there is anything to be seen."""
        return bool(self.line)

    def __str__(self) -> str:
        raise TypeError("a user's text is shown by one of its forms")

    def __format__(self, _spec: str) -> str:
        return str(self)

    @property
    def line(self) -> str:
        """On one line, without signs that cannot be seen: what controls a terminal, or half of a pair, is a space."""
        return " ".join(UNSEEN.sub(" ", self.plain).split())


Translated = Mapping[str, UserText]


def translated(found: object) -> Translated:
    """The texts of a document by language; one without a language is for all."""
    texts = found if isinstance(found, Mapping) else {"en": found or "", "de": found or ""}
    return {str(language): UserText(str(text)[:LONGEST]) for language, text in texts.items()}


def plainly(texts: Translated) -> dict[str, str]:
    """Texts by language as plain data, for documents in which they stand by themselves."""
    return {language: text.plain for language, text in texts.items()}


def in_language(texts: Translated, language: str) -> UserText:
    """The text in this language, else in any; empty if there is none."""
    return texts.get(language) or next(iter(texts.values()), UserText(""))


def as_cell(text: str) -> str:
    """A cell of a table; one that a spreadsheet would take for a formula is made a text, its lines end alike.

    Python's csv quotes no carriage return, so that a row would end there.
    """
    lines = text.replace("\r\n", "\n").replace("\r", "\n")
    return f"'{lines}" if text.lstrip(" \u00a0").startswith(FORMULA) else lines
