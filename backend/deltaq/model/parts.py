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


def outermost(expression: Expr, kinds: tuple[type, ...]) -> set[Expr]:
    """The distinct parts of some kinds that stand in no other such part."""
    seen: set[Expr] = set()
    found: set[Expr] = set()
    open_ones = [expression]
    while open_ones:
        part = open_ones.pop()
        if part in seen:
            continue
        seen.add(part)
        if isinstance(part, kinds):
            found.add(part)
        else:
            open_ones.extend(part.args)
    return found
