"""Whether what must be continuous is: where a potential or a position jumps, or a velocity does, no finite force acts.

A value may have sgn, step, |·|, max or min in it. Along lines through states about the start, and about zero, places
are sought where what these hang on changes its sign. The value jumps there if it has limits on both sides that differ:
x² step(x) has the same, as has x sgn(x), and at a pole there are none. Where the slope ∂r/∂q or ∂r/∂t of a body's
position r jumps, so does its velocity Σ ∂r/∂qᵢ q̇ᵢ + ∂r/∂t, and where that of a constraint g does, the direction of its
reaction. A root √E, asin E and acos E bend so as well where E comes to the end of their range and turns: √(x²) is |x|.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields
from functools import partial
from itertools import combinations, islice, pairwise

from ..errors import Problem
from ..language.expression import Expression
from ..language.floats import evaluate
from ..language.functions import KINKED
from ..language.gradients import gradient
from ..language.tree import Call, Name, Negation, Node, Power, Sum, walk
from .constraints.distance import DistanceConstraint
from .contributions import GeneralizedPotential, PotentialEnergy
from .definedness import points_around
from .scene import Scene

STEPS = 64  # of a line to either side, each longer than the last
NEAREST, GROWTH = 1e-3, 0.25  # the first a quarter of it long, and how much longer each is, as a logarithm
MOST_WORK = 400_000  # terms that are evaluated for one expression, about half a second
MOST = 6  # changes of a sign that are looked at on one line
APART = (1e-7, 1e-8, 1e-9, 1e-10)  # from the place, relative to the coordinate
CLOSE = 1e-17
ALIKE = 0.05  # differences across the place that do not fade
NEGLIGIBLE = 1e-11  # difference, relative to the values
ROUNDED = 1e-6  # difference by the place being a rounded number, relative to how values change beside it

FARTHER = (1e-4, 1e-5, 1e-6)  # the same where close to the place rounding is all that is left, as of √(x² − 2x + 1)
ROOTS = ("sqrt", "asin", "acos")  # which bend where their argument turns at the end of its range
BOTH = 4  # evaluations that one of a slope takes

Point = Mapping[str, float]
Along = Callable[[float], float]
Measure = Callable[[Node, Point, str, float], float]
CONTINUOUS = ("position", "angle")  # fields of places, bodies and moments


@dataclass(frozen=True)
class _Line:
    """A function that may jump or bend where a measure of `switch` changes its sign, as one name changes."""

    node: Node
    switch: Node
    name: str
    measure: Measure


def continuity_problems(scene: Scene) -> Iterator[Problem]:
    """The potentials, positions and angles that jump, and the positions and constraints that bend, by the function."""
    about = tuple(points_around(scene))
    points = (*about, *(_less_start(scene, point) for point in about))
    yield from _of_places(scene, points)
    yield from _of_potentials(scene, points)
    generic = tuple({**point, "t": math.sqrt(k + 1.0) / 4.0} for k, point in enumerate(points) if k % len(about))
    moving = {coordinate.name for coordinate in scene.coordinates} | {"t"}
    for index, body in enumerate(scene.bodies):
        for place, expression in _expressions(body, CONTINUOUS):
            runs = {each.name for each in body.material}
            yield from _of_body(f"/bodies/{index}/{place}", expression, moving, runs, points, generic)
    yield from _of_constraints(scene, moving, generic)


def _less_start(scene: Scene, point: Point) -> dict[str, float]:
    """The same near zero in place of the start."""
    return {**point} | {c.name: point[c.name] - c.value for c in scene.coordinates}


def _of_places(scene: Scene, points: tuple[Point, ...]) -> Iterator[Problem]:
    free = {coordinate.name for coordinate in scene.free}
    for key, things in (("points", scene.points), ("loads", scene.loads)):
        for index, thing in enumerate(things):
            for place, expression in _expressions(thing, CONTINUOUS):
                found = _jump(expression.tree, expression.tree, free, points)
                yield from _told("position-jumps", f"/{key}/{index}/{place}", expression, found, "call")


def _of_potentials(scene: Scene, points: tuple[Point, ...]) -> Iterator[Problem]:
    free = {coordinate.name for coordinate in scene.free}
    for index, load in enumerate(scene.loads):
        for part in load.contributions(scene.places, scene.bodies):
            if isinstance(part, PotentialEnergy | GeneralizedPotential):
                for place, expression in _expressions(load):
                    found = _jump(expression.tree, part.energy, free, points)
                    yield from _told("potential-jumps", f"/loads/{index}/{place}", expression, found, "call")


def _of_body(
    pointer: str,
    expression: Expression,
    moving: Collection[str],
    material: Collection[str],
    points: tuple[Point, ...],
    generic: tuple[Point, ...],
) -> Iterator[Problem]:
    """Where mass is, or how it is turned, neither may jump nor bend, in time either.

    At `generic` places no distance is zero by chance: √(x² + y²) bends in one point alone. A bend that runs along a
    continuum meets little mass at a time.
    """
    tree = expression.tree
    jumping = _jump(tree, tree, moving, points)
    yield from _told("position-jumps", pointer, expression, jumping, "call")
    if jumping is None:
        yield from _told("position-bends", pointer, expression, _bend(tree, moving, generic, material), "call")


def _of_constraints(scene: Scene, moving: Collection[str], points: tuple[Point, ...]) -> Iterator[Problem]:
    """Constraints with a bend, in what is stated or in the place of a point that a rod begins or ends at."""
    ends = {end for rod in scene.constraints if isinstance(rod, DistanceConstraint) for end in (rod.start, rod.end)}
    held = [(f"/constraints/{i}", each, ()) for i, each in enumerate(scene.constraints)]
    placed = [(f"/points/{i}", each, CONTINUOUS) for i, each in enumerate(scene.points) if each.name in ends]
    for pointer, thing, keys in (*held, *placed):
        for place, expression in _expressions(thing, keys):
            tree = expression.tree
            found = _jump(tree, tree, moving, points) or _bend(tree, moving, points)
            yield from _told("constraint-not-smooth", f"{pointer}/{place}", expression, found, "function")


def _told(code: str, pointer: str, expression: Expression, node: Node | None, key: str) -> Iterator[Problem]:
    if node is not None:
        span = node.span
        call = expression.text[span.offset : span.offset + span.length]
        yield Problem(code, pointer, span.offset, span.length, {key: call[:60]})


def _expressions(thing: object, keys: tuple[str, ...] = ()) -> Iterator[tuple[str, Expression]]:
    """Scalars and components of vectors, all or those of some keys, with where they stand."""
    for item in fields(thing):  # type: ignore[arg-type] # every kind of point, body and load is a dataclass
        if keys and item.name not in keys:
            continue
        match getattr(thing, item.name):
            case Expression() as expression:
                yield item.name, expression
            case tuple(parts):
                yield from ((f"{item.name}/{i}", part) for i, part in enumerate(parts) if isinstance(part, Expression))


def _jump(tree: Node, whole: Node, names: Collection[str], points: tuple[Point, ...]) -> Node | None:
    """A function in a tree with which the whole jumps, as far as so much work tells."""
    return _first((*_lines(tree, names), *_turning(tree, names)), whole, _at, (APART,), points)


def _bend(tree: Node, names: Collection[str], points: tuple[Point, ...], without: Collection[str] = ()) -> Node | None:
    """A function in a tree, `without` some names in it, with which the slope jumps, as far as so much work tells."""
    lines = (*_lines(tree, names), *_turning(tree, names))
    lines = tuple(line for line in lines if not _names(line.node, without))
    return _first(lines, tree, _slope_at, (APART, FARTHER), points)


def _first(
    lines: tuple[_Line, ...],
    whole: Node,
    measure: Measure,
    sides: tuple[tuple[float, ...], ...],
    points: tuple[Point, ...],
) -> Node | None:
    size = sum(1 for _ in walk(whole)) * (1 if measure is _at else BOTH)
    work = (2 * STEPS * sum(1 for _ in walk(line.switch)) + 2 * MOST * size for line in lines)
    looks = int(MOST_WORK // max(work, default=1))
    every = ((line, point) for point in points for line in lines)
    for line, point in islice(every, looks):
        start = 0.0 if line.name == "t" else point[line.name]
        switch = partial(line.measure, line.switch, point, line.name)
        value = partial(measure, whole, point, line.name)
        if _jumps_along(switch, value, start, sides, is_time=line.name == "t"):
            return line.node
    return None


def _lines(tree: Node, names: Collection[str]) -> Iterator[_Line]:
    """Each function that may jump, what it switches by, and a name to change."""
    for node in walk(tree):
        if isinstance(node, Call) and node.function in KINKED:
            yield from (_Line(node, s, name, _at) for s in _switches(node) for name in _names(node, names))


def _turning(tree: Node, names: Collection[str]) -> Iterator[_Line]:
    """Each root that may bend, what turns in it, and a name to change."""
    for node in walk(tree):
        inside = _inside(node)
        if inside is not None:
            yield from (_Line(node, inside, name, _slope_at) for name in _names(inside, names))


def _inside(node: Node) -> Node | None:
    """What a root is of."""
    match node:
        case Call(function, (inside,)) if function in ROOTS:
            return inside
        case Power(base, exponent) if not any(isinstance(part, Name) for part in walk(exponent)):
            return base if 0.0 < evaluate(exponent, {}) < 1.0 else None
    return None


def _names(node: Node, names: Collection[str]) -> list[str]:
    return sorted({part.name for part in walk(node) if isinstance(part, Name)} & set(names))


def _switches(node: Call) -> tuple[Node, ...]:
    """What changes its sign where the function switches."""
    if len(node.arguments) == 1:
        return node.arguments
    return tuple(Sum((one, Negation(other))) for one, other in combinations(node.arguments, 2))


def _at(tree: Node, point: Point, name: str, x: float) -> float:
    return evaluate(tree, {**point, name: x})


def _slope_at(tree: Node, point: Point, name: str, x: float) -> float:
    return gradient(tree, {**point, name: x}, (name,))[0]


def _jumps_along(
    switch: Along, value: Along, start: float, sides: Sequence[tuple[float, ...]], *, is_time: bool
) -> bool:
    """Whether a value jumps where a switch changes its sign; times are those behind the start."""
    unit = max(1.0, abs(start)) * NEAREST
    places = [start + unit * math.sinh(k * GROWTH) for k in range(1 if is_time else -STEPS, STEPS + 1)]
    signs = [_sign(switch(x)) for x in places]
    found = 0
    for (low, below), (high, above) in pairwise(zip(places, signs, strict=True)):
        if below == above or math.isnan(below) or math.isnan(above):
            continue
        place = _narrowed(switch, low, high)
        if any(_differs(value, *place, apart) for apart in sides):
            return True
        found += 1
        if found == MOST:
            break
    return False


def _narrowed(switch: Along, low: float, high: float) -> tuple[float, float]:
    """Numbers between which the sign changes: neighbours, or about zero so close that it makes no difference."""
    below = _sign(switch(low))
    while low < (middle := low + (high - low) / 2) < high and high - low > CLOSE:
        low, high = (middle, high) if _sign(switch(middle)) == below else (low, middle)
    return low, high


def _differs(value: Along, low: float, high: float, aparts: tuple[float, ...]) -> bool:
    """Whether values on both sides tend to different limits."""
    size = max(abs(low), abs(high), NEAREST)
    sides = [(value(low - size * apart), value(high + size * apart)) for apart in aparts]
    differences = [above - below for below, above in sides]
    if not math.isfinite(sum(differences)):
        return False
    last, largest = differences[-1], max(abs(each) for side in sides for each in side)
    change = max(abs(one - other) for one, other in zip(sides[0], sides[-1], strict=True))
    if abs(last) <= NEGLIGIBLE * largest + ROUNDED * change:
        return False
    return all(abs(each - last) <= ALIKE * abs(last) for each in differences)


def _sign(value: float) -> float:
    return value if math.isnan(value) else float((value > 0.0) - (value < 0.0))
