"""Bounds that hold before anything is built from a tree."""

from __future__ import annotations

from .measure import Shape, measure
from .tokens import fail
from .tree import Equation, Name, Node, Vector, children, walk

MAX_CHARACTERS = 2000
MAX_NODES = 500
MAX_DEPTH = 60
MAX_NAMES = 64


def check_bounds(tree: Node) -> Shape:
    """The shape of a tree that is within all bounds, else an ExpressionError at the part that is not."""
    _check_depth(tree)
    names = {n.name for n in walk(tree) if isinstance(n, Name)}
    if len(names) > MAX_NAMES:
        fail("too-many-names", tree.span, count=len(names), limit=MAX_NAMES)
    _check_equations(tree)
    return measure(tree).shape


def _check_equations(tree: Node) -> None:
    """An equation is the whole, or one of several equations; it is no part of an expression."""
    parts = tree.components if isinstance(tree, Vector) else (tree,)
    equations = [part for part in parts if isinstance(part, Equation)]
    if equations and len(equations) < len(parts):
        fail("misplaced-equation", equations[0].span)
    below = (side for part in parts for side in (children(part) if isinstance(part, Equation) else (part,)))
    inner = next((node for side in below for node in walk(side) if isinstance(node, Equation)), None)
    if inner:
        fail("misplaced-equation", inner.span)


def shape_of(node: Node) -> Shape:
    """The shape of a part alone."""
    return measure(node).shape


def _check_depth(tree: Node) -> None:
    level: list[Node] = [tree]
    for _ in range(MAX_DEPTH):
        level = [part for node in level for part in children(node)]
        if not level:
            return
    fail("too-deep", tree.span, limit=MAX_DEPTH)
