"""The length of a spring, and how a coordinate can be given up for it."""

from __future__ import annotations

from collections.abc import Iterator
from functools import singledispatch

from ...language.tree import Name, Negation, Node, Power, Product, Quotient, Rate, Sum, walk
from ...mechanics.lengths import TWO, distance
from ...mechanics.loads.potential import Potential
from ...mechanics.loads.spring import Spring
from ...mechanics.scene import Scene


@singledispatch
def length(_load: object, _scene: Scene) -> Node | None:
    """The length of a load's spring, up to a constant; None if the load is no spring."""
    return None


@length.register
def _of_spring(load: Spring, scene: Scene) -> Node:
    """|r_to − r_from|; where all but one component agree, that one's difference, which is smooth also at zero."""
    ends = scene.place(load.start), scene.place(load.end)
    apart = [Sum((b.tree, Negation(a.tree))) for a, b in zip(*ends, strict=True) if a != b]
    return apart[0] if len(apart) == 1 else distance(*ends)


@length.register
def _of_potential(load: Potential, scene: Scene) -> Node | None:
    """x of an energy k x²/2, k of parameters alone."""
    moving = {coordinate.name for coordinate in scene.coordinates} | {"t"}
    moves = [part for part in _factors(load.energy.tree) if _names(part) & moving]
    match moves:
        case [Power(base, exponent)] if exponent == TWO:
            return base
    return None


def _factors(node: Node) -> Iterator[Node]:
    """What a product is made of, the parts of quotients among them."""
    match node:
        case Product(factors):
            for factor in factors:
                yield from _factors(factor)
        case Quotient(numerator, denominator):
            yield from _factors(numerator)
            yield denominator
        case _:
            yield node


def _names(node: Node) -> set[str]:
    return {part.name for part in walk(node) if isinstance(part, Name | Rate)}
