"""The distance between two places, and other differences, as trees."""

from __future__ import annotations

from fractions import Fraction

from ..language.expression import Expression
from ..language.tree import Call, Negation, Node, Number, Power, Span, Sum

ZERO, TWO = Number(Fraction(0)), Number(Fraction(2))


def squared_distance(start: tuple[Expression, ...], end: tuple[Expression, ...]) -> Node:
    """s² = |r_end − r_start|²"""
    return Sum(tuple(Power(Sum((b.tree, Negation(a.tree))), TWO) for a, b in zip(start, end, strict=True)))


def distance(start: tuple[Expression, ...], end: tuple[Expression, ...]) -> Node:
    """s = |r_end − r_start|"""
    return Call("sqrt", (squared_distance(start, end),))


def difference(left: Node, right: Node) -> Node:
    """left − right; left alone where the other is zero."""
    if right == ZERO:
        return left
    whole = Span(left.span.offset, right.span.offset + right.span.length - left.span.offset)
    return Sum((left, Negation(right, right.span)), whole)
