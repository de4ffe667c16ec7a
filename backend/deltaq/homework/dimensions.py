"""Terms whose units do not fit together: the first thing to say about an answer that has them."""

from __future__ import annotations

from ..errors import Problem
from ..language.tree import Equation, Node, Sum, Vector
from ..mechanics.homogeneity import DimensionCheck
from ..mechanics.scene import Scene
from ..mechanics.units import dimension_of
from .reading import Reading


def dimension_problem(reading: Reading, scene: Scene) -> Problem | None:
    """The first term of an answer whose dimension differs from that of the terms before it."""
    units = {c.name: dimension_of(c.unit) for c in scene.coordinates} | {"t": dimension_of("s")}
    units |= {p.name: dimension_of(p.unit) for p in scene.parameters}
    for text, tree in reading.trees:
        for part in _sums(tree):
            check = DimensionCheck(units, text, [])
            check.of(part)
            if check.problems:
                return check.problems[0]
    return None


def _sums(tree: Node) -> list[Node]:
    """Each component by itself; the terms on both sides of an equation belong together."""
    match tree:
        case Vector(components=components):
            return [part for component in components for part in _sums(component)]
        case Equation(left=left, right=right):
            return [Sum((*_terms(left), *_terms(right)), span=tree.span)]
        case _:
            return [tree]


def _terms(side: Node) -> tuple[Node, ...]:
    return side.terms if isinstance(side, Sum) else (side,)
