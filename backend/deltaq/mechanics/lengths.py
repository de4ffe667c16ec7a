"""The distance between two places, and other differences, as trees."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction

from ..language.expression import Expression
from ..language.floats import evaluate
from ..language.tree import Call, Negation, Node, Number, Power, Span, Sum, TreeAlgebra, fold

ZERO, TWO = Number(Fraction(0)), Number(Fraction(2))


def squared_distance(start: tuple[Expression, ...], end: tuple[Expression, ...]) -> Node:
    """s² = |r_end − r_start|²"""
    return Sum(tuple(Power(Sum((b.tree, Negation(a.tree))), TWO) for a, b in zip(start, end, strict=True)))


def distance(start: tuple[Expression, ...], end: tuple[Expression, ...]) -> Node:
    """s = |r_end − r_start|"""
    return Call("sqrt", (squared_distance(start, end),))


def distance_up_to_sign(start: tuple[Expression, ...], end: tuple[Expression, ...]) -> Node:
    """The same, or on a line along an axis, on which the places differ in one component alone, that difference."""
    apart = [(a.tree, b.tree) for a, b in zip(start, end, strict=True) if a.tree != b.tree]
    return Sum((apart[0][1], Negation(apart[0][0]))) if len(apart) == 1 else distance(start, end)


def difference(left: Node, right: Node) -> Node:
    """left − right; left alone where the other is zero."""
    if right == ZERO:
        return left
    whole = Span(left.span.offset, right.span.offset + right.span.length - left.span.offset)
    return Sum((left, Negation(right, right.span)), whole)


def with_signed_roots(node: Node, start: Mapping[str, float], points: Sequence[Mapping[str, float]]) -> Node:
    """√(u²) = ±u with the sign that u has at the start: a distance along a line, which has no slope at zero.

    Valid as long as u does not pass zero, as in constraints that keep it. Terms of the root that are zero at all of
    some random points do not count.
    """
    found: Node = fold(node, _SignedRoots(start, points))
    return node if found == node else found


class _SignedRoots(TreeAlgebra):
    def __init__(self, start: Mapping[str, float], points: Sequence[Mapping[str, float]]) -> None:
        self._start = start
        self._points = points

    def call(self, function: str, arguments: tuple[Node, ...]) -> Node:
        inside = self._only_square(arguments[0]) if function == "sqrt" else None
        value = 0.0 if inside is None else evaluate(inside, self._start)
        if inside is None or not abs(value) > 0.0:
            return Call(function, arguments)
        return inside if value > 0.0 else Negation(inside)

    def _only_square(self, node: Node) -> Node | None:
        """u of u², where all else is zero."""
        terms = node.terms if isinstance(node, Sum) else (node,)
        left = [term for term in terms if any(evaluate(term, point) for point in self._points)]
        match left:
            case [Power(base, exponent)] if exponent == TWO:
                return base
        return None
