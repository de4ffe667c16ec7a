"""What an expression of a scene depends on, cancellations included, and how to solve it for a coordinate."""

from __future__ import annotations

from ..language.expression import Expression
from ..language.tree import Node
from ..mechanics.scene import Scene
from .functions import Expr
from .phase import vanishes
from .symbols import CLOCK, Symbols
from .symengine_algebra import to_symengine
from .writing import Writer


def dependencies(scene: Scene, node: Node) -> frozenset[str]:
    """The coordinates on which the value depends, and `t`."""
    symbols = Symbols.of(scene)
    value = to_symengine(node, symbols)
    return frozenset(name for name in symbols.moving if not vanishes(value.diff(symbols.values[name])))


def solved(scene: Scene, node: Node, coordinate: str, target: str) -> Expression | None:
    """The coordinate, from node = target (the name of a parameter); None unless the node is a·q + b with constant a.

    a may depend on parameters, b on everything else; guides are put in.
    """
    symbols = Symbols.of(scene)
    guides = {symbols.values[guide.coordinate]: to_symengine(guide.value.tree, symbols) for guide in scene.guides}
    unknown, value = symbols.values[coordinate], to_symengine(node, symbols).subs(guides)
    slope = value.diff(unknown)
    if vanishes(slope) or not all(vanishes(slope.diff(symbols.values[name])) for name in symbols.moving):
        return None
    rest = (value - slope * unknown).expand()
    if unknown in rest.free_symbols or _moves(slope, symbols):
        return None
    return Writer(symbols, scene.names).expression((symbols.values[target] - rest) / slope)


def _moves(expression: Expr, symbols: Symbols) -> bool:
    moving = {symbols.values[name] for name in (*symbols.moving, CLOCK)}
    return bool(expression.free_symbols & moving)
