"""All that expressions are made of, each part once: they share what is long, and are walked as often otherwise."""

from __future__ import annotations

from collections.abc import Iterable

import symengine as se

from .functions import Expr


def parts(expressions: Iterable[Expr], kind: type) -> set[Expr]:
    """The distinct parts of a kind within some expressions."""
    seen: set[Expr] = set()
    open_ones = [se.sympify(each) for each in expressions]
    while open_ones:
        part = open_ones.pop()
        if part not in seen:
            seen.add(part)
            open_ones.extend(part.args)
    return {part for part in seen if isinstance(part, kind)}
