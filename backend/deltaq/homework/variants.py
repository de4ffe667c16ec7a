"""Each student's own task: the same system, told in other axes, other coordinates and other quantities.

A variant changes how a system is described, never what it does: the second axis points the other way, the system is
seen from the other side, a coordinate is counted in the other sense or from elsewhere, a quantity is a multiple of its
letter. So the motion, the equilibria and the drawing stay as they are, and the right answers differ.
"""

from __future__ import annotations

import math
import random
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields, is_dataclass, replace
from fractions import Fraction
from typing import Any, TypeAlias, cast

from ..contract.assignment import Aspect
from ..language.expression import Expression
from ..language.rewriting import ZERO, Exchange, Shift, exchanged, expression_of, scaled
from ..language.tree import Name, Negation, Node, Number, Product, walk
from ..mechanics.contributions import Friction
from ..mechanics.coordinate import Coordinate
from ..mechanics.drawing import SIZES, Drawing, Element
from ..mechanics.parameter import Parameter
from ..mechanics.point import Point
from ..mechanics.scene import Scene
from .seeds import seeded

FACTORS = tuple(map(Fraction, ("2", "3", "4", "5", "6", "1/2", "1/3", "3/2")))
MOST_FACTORS = (3, 3, 2, 1, 1, 1, 0)  # of each draw; a statement that changes more letters is hard to keep in mind
DRAWS = len(MOST_FACTORS)
QUARTERS = (0, 1, 2, 3)
TIMES = (1, -1, 2, -2)  # as many lengths away a coordinate may count from
COUNTED = {"angle", "dimension"}  # the elements that can show a coordinate counted otherwise
HANDED = {"moment", "azimuth", "polar", "top"}  # those that would be wrong in a mirror
TURNING = {"disc", "hoop"}  # and these, where they show a coordinate
FLIPPED: Mapping[str, str] = {"up": "down", "down": "up"}


@dataclass(frozen=True)
class Variant:
    """What is told otherwise: axes turned round, the side it is seen from, shifts of coordinates, factors."""

    upside: bool = False
    mirrored: bool = False
    shifts: tuple[Shift, ...] = ()
    factors: tuple[tuple[str, Fraction], ...] = ()

    @property
    def shift_of(self) -> Mapping[str, Shift]:
        """The shifts by coordinate."""
        return {shift.name: shift for shift in self.shifts}


def individual(scene: Scene, seed: str, vary: tuple[Aspect, ...], draw: int = 0) -> tuple[Scene, Variant]:
    """The scene as the student of this seed gets it, and what is told otherwise in it; later draws keep the values."""
    variant = drawn(scene, seed, vary, draw)
    told = varied(scene, variant)
    return (seeded(told, seed) if "values" in vary and not draw else told), variant


# --- drawing lots ----------------------------------------------------------------------------------------------------


def drawn(scene: Scene, seed: str, vary: tuple[Aspect, ...], draw: int = 0) -> Variant:
    """The variant of a seed: the same one every time."""
    source = random.Random(f"{scene.id}/{seed}/variant/{draw}")
    upside, mirrored = source.random() < 0.5, source.random() < 0.5
    shifts = tuple(_shift(scene, coordinate, source) for coordinate in scene.free if _may_shift(scene, coordinate))
    factors = _factors(scene, source, MOST_FACTORS[draw])
    axes = "axes" in vary and scene.dimension == 2
    return Variant(
        axes and upside,
        axes and mirrored and _may_mirror(scene),
        shifts if "coordinates" in vary else (),
        factors if "factors" in vary else (),
    )


def _may_mirror(scene: Scene) -> bool:
    """Whether the drawing shows how every coordinate counts, and can show it from the other side."""
    elements = scene.drawing.elements
    handed = any(one.kind in HANDED or (one.kind in TURNING and "coordinate" in dict(one.options)) for one in elements)
    return not handed and not scene.guides and all(_may_shift(scene, coordinate) for coordinate in scene.free)


def _shown(scene: Scene, coordinate: str) -> list[Element]:
    return [one for one in scene.drawing.elements if dict(one.options).get("coordinate") == coordinate]


def _may_shift(scene: Scene, coordinate: Coordinate) -> bool:
    """Whether the drawing shows from where the coordinate counts, and can show it from elsewhere."""
    elements = _shown(scene, coordinate.name)
    sticks = coordinate.name in _sliding(scene)
    return scene.dimension == 2 and not sticks and bool(elements) and {one.kind for one in elements} <= COUNTED


def _sliding(scene: Scene) -> set[str]:
    """The coordinates that friction acts on; a load names them, and they are counted in no other way."""
    frictions = (part for part in scene.contributions if isinstance(part, Friction))
    return {node.name for part in frictions for node in walk(part.coordinate) if isinstance(node, Name)}


def _shift(scene: Scene, coordinate: Coordinate, source: random.Random) -> Shift:
    """One of the other ways to count a coordinate: an angle from another axis, a length from elsewhere, backwards."""
    if any(one.kind == "angle" for one in _shown(scene, coordinate.name)):
        turns = [Shift(coordinate.name, sign, quarters) for sign in (1, -1) for quarters in QUARTERS]
        return source.choice(turns[1:])
    lengths = [Name(p.name) for p in scene.parameters if p.unit == coordinate.unit == "m"]
    far = [ZERO, *(scaled(Fraction(times), length) for length in lengths for times in TIMES)]
    return source.choice([Shift(coordinate.name, sign, 0, node) for sign in (1, -1) for node in far][1:])


def _factors(scene: Scene, source: random.Random, most: int) -> tuple[tuple[str, Fraction], ...]:
    spoken = {name for expression in expressions(scene) for name in expression.names}
    bounded = {name for event in scene.events if event.restitution for name in event.restitution.names}
    names = [p.name for p in scene.parameters if p.unit not in ("m/s^2", "rad")]
    fitting = [name for name in names if name in spoken - bounded]  # of what bounces back, no more than all does
    chosen = set(source.sample(fitting, min(most, len(fitting))))
    factors = {name: source.choice(FACTORS) for name in fitting}
    return tuple((name, factor) for name, factor in factors.items() if name in chosen)


# --- the scene of a variant ------------------------------------------------------------------------------------------


def varied(scene: Scene, variant: Variant) -> Scene:
    """The same system as the variant describes it. Units, ranges and the drawing go along."""
    turned = _scaled(_shifted(scene, variant), variant)
    signs = (-1 if variant.mirrored else 1, -1 if variant.upside else 1)
    return _turned(turned, signs, variant) if -1 in signs else turned


def expressions(scene: Scene) -> Iterator[Expression]:
    """All that its points, bodies, loads, guides, events and constraints are stated by."""
    found: list[Expression] = []

    def note(expression: Expression) -> Expression:
        found.append(expression)
        return expression

    for things in (scene.points, scene.bodies, scene.loads, scene.guides, scene.events, scene.constraints):
        _each(things, note)
    yield from found


Change: TypeAlias = Any  # of one expression: Expression → Expression


def _each(thing: Any, change: Change) -> Any:
    """Plain data with every expression in it changed."""
    if isinstance(thing, Expression):
        return change(thing)
    if isinstance(thing, tuple):
        return tuple(_each(one, change) for one in thing)
    if is_dataclass(thing) and not isinstance(thing, type):
        parts = {one.name: getattr(thing, one.name) for one in fields(thing) if one.init}
        new = {name: _each(part, change) for name, part in parts.items()}
        return replace(thing, **new) if any(new[name] is not parts[name] for name in new) else thing
    return thing


def _exchanged(scene: Scene, exchange: Exchange) -> Scene:
    def change(expression: Expression) -> Expression:
        return exchanged(expression, exchange)

    return replace(
        scene,
        points=_each(scene.points, change),
        bodies=_each(scene.bodies, change),
        loads=_each(scene.loads, change),
        guides=_each(scene.guides, change),
        events=_each(scene.events, change),
        constraints=_each(scene.constraints, change),
    )


def _shifted(scene: Scene, variant: Variant) -> Scene:
    """Coordinates counted otherwise; a dimension begins where its coordinate is zero now."""
    if not variant.shifts:
        return scene
    told = _exchanged(scene, Exchange(variant.shift_of))
    zeros = {shift.name: f"zero_{shift.name}" for shift in variant.shifts if _dimensions(scene, shift.name)}
    points = tuple(
        Point(place, _at_zero(told.place(dict(_dimensions(scene, name)[0].places)["to"]), name))
        for name, place in zeros.items()
    )
    elements = tuple(_counted(element, variant, zeros) for element in told.drawing.elements)
    values = scene.parameter_values
    return replace(
        told,
        coordinates=tuple(_moved(c, variant.shift_of.get(c.name), values) for c in told.coordinates),
        points=(*told.points, *points),
        drawing=replace(told.drawing, elements=elements),
    )


def _dimensions(scene: Scene, coordinate: str) -> list[Element]:
    return [one for one in _shown(scene, coordinate) if one.kind == "dimension"]


def _at_zero(position: tuple[Expression, ...], coordinate: str) -> tuple[Expression, ...]:
    exchange = Exchange(trees={coordinate: ZERO})
    return tuple(exchanged(part, exchange) for part in position)


def _counted(element: Element, variant: Variant, zeros: Mapping[str, str]) -> Element:
    options = dict(element.options)
    shift = variant.shift_of.get(str(options.get("coordinate", "")))
    if shift is None:
        return element
    if element.kind == "dimension":
        return replace(element, places=(("from", zeros[shift.name]), *(p for p in element.places if p[0] != "from")))
    return _arc(element, shift.quarters * math.pi / 2, shift.sign)


def _arc(element: Element, zero: float, sense: int) -> Element:
    """An angle from a direction on the screen (from downwards, counterclockwise), counted in a sense."""
    kept = [(key, value) for key, value in element.options if key not in ("offset", "direction")]
    start = [("offset", zero)] if zero else []
    turn = [("direction", "clockwise")] if sense < 0 else []
    return replace(element, options=(*kept, *start, *turn))


def _moved(coordinate: Coordinate, shift: Shift | None, values: Mapping[str, float]) -> Coordinate:
    """Initial value and range, counted otherwise."""
    if shift is None:
        return coordinate
    zero = shift.quarters * math.pi / 2 + _length(shift.length, values)

    def new(value: float) -> float:
        return round(shift.sign * (value - zero), 12)

    low, high = (None if bound is None else new(bound) for bound in (coordinate.min, coordinate.max))
    value, turn = new(coordinate.value), 0.0
    if shift.quarters:  # an angle begins within half a turn, and its range goes along
        turn = 2 * math.pi * round(value / (2 * math.pi))
    bounds = [None if bound is None else bound - turn for bound in ((low, high) if shift.sign > 0 else (high, low))]
    return replace(coordinate, value=value - turn, rate=shift.sign * coordinate.rate, min=bounds[0], max=bounds[1])


def _length(node: Node, values: Mapping[str, float]) -> float:
    match node:
        case Name(name):
            return values[name]
        case Number(value):
            return float(value)
        case Negation(operand):
            return -_length(operand, values)
        case Product(factors):
            return math.prod(_length(factor, values) for factor in factors)
    raise ValueError("no multiple of a length")


def _scaled(scene: Scene, variant: Variant) -> Scene:
    """Quantities as multiples of their letters, whose values shrink by as much."""
    factors = dict(variant.factors)
    if not factors:
        return scene
    told = _exchanged(scene, Exchange(trees={name: scaled(factor, Name(name)) for name, factor in factors.items()}))
    values = scene.parameter_values
    elements = tuple(_sized(element, factors.keys() & values.keys(), values) for element in scene.drawing.elements)
    return replace(
        told,
        parameters=tuple(_divided(p, factors.get(p.name)) for p in told.parameters),
        drawing=replace(told.drawing, elements=elements),
    )


def _sized(element: Element, changed: set[str], values: Mapping[str, float]) -> Element:
    """A size in the drawing that was a quantity's, as a number."""
    options = {key: values[str(v)] if key in SIZES and v in changed else v for key, v in element.options}
    return replace(element, options=tuple(options.items()))


def _divided(parameter: Parameter, factor: Fraction | None) -> Parameter:
    if factor is None:
        return parameter
    value, low, high = (
        None if one is None else float(f"{one / factor:.4g}") for one in (parameter.value, parameter.min, parameter.max)
    )
    return replace(parameter, value=cast("float", value), min=low, max=high)


def _turned(scene: Scene, signs: tuple[int, int], variant: Variant) -> Scene:
    """Vectors in the other axes: upside down the drawing stays, mirrored it is seen from the other side."""

    def vectors(thing: Any) -> Any:
        parts = {one.name: getattr(thing, one.name) for one in fields(thing) if one.init}
        new = {name: _in_axes(part, signs) for name, part in parts.items() if _is_vector(name, part)}
        return replace(thing, **new)

    return replace(
        scene,
        points=tuple(map(vectors, scene.points)),
        bodies=tuple(map(vectors, scene.bodies)),
        loads=tuple(map(vectors, scene.loads)),
        drawing=_drawing(scene.drawing, variant),
    )


VECTORS = {"position", "force", "acceleration", "density"}


def _is_vector(name: str, part: object) -> bool:
    return name in VECTORS and isinstance(part, tuple)


def _in_axes(vector: tuple[Expression, ...], signs: tuple[int, int]) -> tuple[Expression, ...]:
    return tuple(part if sign > 0 else _opposite(part) for part, sign in zip(vector, signs, strict=True))


def _opposite(expression: Expression) -> Expression:
    tree = expression.tree
    if tree == ZERO:
        return expression
    return expression_of(tree.operand if isinstance(tree, Negation) else Negation(tree))


def _drawing(drawing: Drawing, variant: Variant) -> Drawing:
    view = drawing.view
    if view and variant.upside:
        view = (view[0], view[1], -view[3], -view[2])
    if view and variant.mirrored:
        view = (-view[1], -view[0], view[2], view[3])
    vertical = FLIPPED[drawing.vertical] if variant.upside else drawing.vertical
    elements = tuple(map(_mirrored, drawing.elements)) if variant.mirrored else drawing.elements
    return replace(drawing, vertical=cast("Any", vertical), view=view, elements=elements)


def _mirrored(element: Element) -> Element:
    """An angle in a mirror, and what stands beside its line on the other side of it."""
    options = dict(element.options)
    beside = options.get("offset")
    offset = -beside if isinstance(beside, float) else 0.0
    if element.kind == "angle":
        return _arc(element, offset, 1 if options.get("direction") == "clockwise" else -1)
    return replace(element, options=tuple((options | {"offset": offset} if offset else options).items()))
