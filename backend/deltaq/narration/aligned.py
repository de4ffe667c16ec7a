"""The lines of a step, aligned at their signs."""

from __future__ import annotations

import re
from collections.abc import Callable
from itertools import groupby

from ..derivation.formula import Formula
from ..derivation.step import Relation
from .marks import bare

TALL = re.compile(r"\\(?:frac|begin)\b")
SIGNS = {"=": "=", "≠": r"\neq", "≈": r"\approx", "⇔": r"\;\Longleftrightarrow\;", "<": "<", "≤": r"\leq"}


def aligned(
    relations: tuple[Relation, ...], written: Callable[[Formula], str], explained: tuple[tuple[str, str], ...] = ()
) -> str:
    """All lines of a step as one block, and what its letters stand for; empty if it has none."""
    rows = [row for relation in relations for row in _rows(relation, written)]
    rows += [f"{letter} &= {value}" for letter, value in explained] if rows else []
    if not rows:
        return ""
    *upper, last = rows
    return r"\begin{aligned}" + "".join(row + _gap_below(row) for row in upper) + last + r"\end{aligned}"


def _rows(relation: Relation, written: Callable[[Formula], str]) -> list[str]:
    """The first two members share a row, each further member has its own."""
    sign = SIGNS[relation.sign]
    texts = map(written, relation.members)
    # A member that reads like the one before says nothing.
    first, *others = (next(alike) for _, alike in groupby(texts, bare))
    if relation.sign == "⇔":
        return [f"& {first}", *(rf"{sign} & {other}" for other in others)]
    if relation.sign in ("<", "≤"):  # a chain is read in one line
        return [f"& {f' {sign} '.join((first, *others))}"]
    rows = [f"{'' if row else first} &{sign} {other}" for row, other in enumerate(others)]
    return rows or [f"& {first}"]


def _gap_below(row: str) -> str:
    """The end of a row. TeX counts the gap from the line of writing, not from what hangs below it."""
    return r" \\[0.85em] " if TALL.search(row) else r" \\[0.4em] "
