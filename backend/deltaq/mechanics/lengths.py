"""The distance between two places, as a tree."""

from __future__ import annotations

from fractions import Fraction

from ..language.expression import Expression
from ..language.tree import Call, Negation, Node, Number, Power, Sum

ZERO, TWO = Number(Fraction(0)), Number(Fraction(2))


def squared_distance(start: tuple[Expression, ...], end: tuple[Expression, ...]) -> Node:
    """s² = |r_end − r_start|²"""
    return Sum(tuple(Power(Sum((b.tree, Negation(a.tree))), TWO) for a, b in zip(start, end, strict=True)))


def distance(start: tuple[Expression, ...], end: tuple[Expression, ...]) -> Node:
    """s = |r_end − r_start|"""
    return Call("sqrt", (squared_distance(start, end),))
