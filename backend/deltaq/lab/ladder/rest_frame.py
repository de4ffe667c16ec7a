"""A scene seen from the frame in which it rests, where another was chosen: all bodies moved along uniformly.

Motions in two frames that move uniformly against each other obey the same equations, but the kinetic energies differ
by the total derivative of Σ m v·r, on which a coordinate that is cyclic in one of them may depend in the other.
Source: Landau, Lifshitz, Mechanics, §2 and §8; Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §2.6.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TypeVar

from ...language.expression import Expression
from ...language.parser import parse
from ...mechanics.bodies import Body
from ...mechanics.point import Point
from ...mechanics.scene import Scene
from ...mechanics.soundness import expressions
from ...model.equations import equations
from ...model.functions import Expr
from ...model.kinetic import Vector, components
from ...model.phase import vanishes
from ...model.symbols import Symbols
from ...model.writing import Writer

Placed = TypeVar("Placed", Point, Body)


def in_rest_frame(scene: Scene) -> Scene:
    """The scene in the frame in which its bodies have no common velocity; the same scene if there is none."""
    if not any("t" in field.expression.names for field in expressions(scene)):
        return scene
    velocity = _velocity(scene)
    if all(speed == "0" for speed in velocity):
        return scene
    points = tuple(_seen(point, velocity, scene) for point in scene.points)
    bodies = tuple(_seen(body, velocity, scene) for body in scene.bodies)
    return replace(scene, points=points, bodies=bodies)


def _velocity(scene: Scene) -> tuple[str, ...]:
    """Along each axis: the common speed as a text; 0 where there is none."""
    symbols = equations(scene).symbols
    given = {symbols.values[name]: value for name, (value, _) in equations(scene).guided.items()}
    moving = tuple(symbols.values[name] for name in symbols.moving)
    by_body = [_explicit(body, symbols, given) for body in scene.bodies]
    writer = Writer(symbols, scene.names)
    return tuple(writer.text(_common(speeds, moving)) for speeds in zip(*by_body, strict=True))


def _explicit(body: Body, symbols: Symbols, given: dict[Expr, Expr]) -> Vector:
    """∂r/∂t with the guided coordinates moving."""
    position = components(tuple(each.tree for each in body.position), symbols.within(body.material))
    return tuple(each.subs(given).diff(symbols.time) for each in position)


def _common(speeds: tuple[Expr, ...], moving: Vector) -> Expr:
    first, *others = speeds
    is_common = all(vanishes(each - first) for each in others)
    is_even = all(vanishes(first.diff(each)) for each in moving)
    still = dict.fromkeys(moving, 0)
    return first.subs(still) if is_common and is_even and not vanishes(first) else 0 * first


def _seen(thing: Placed, velocity: tuple[str, ...], scene: Scene) -> Placed:
    moved = (_less(each, speed, scene) for each, speed in zip(thing.position, velocity, strict=True))
    return replace(thing, position=tuple(moved))  # type: ignore[type-var]


def _less(component: Expression, speed: str, scene: Scene) -> Expression:
    return component if speed == "0" else parse(f"({component.text}) - ({speed})*t", scene.names)
