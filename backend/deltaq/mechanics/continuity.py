"""Whether what must be continuous in the coordinates is: where a potential or a position jumps, no finite force acts.

A value may have sgn, step, |·|, max or min in it. Along lines through states about the start, and about zero, places
are sought where what these hang on changes its sign. The value jumps there if it has limits on both sides that differ:
x² step(x) has the same, as has x sgn(x), and at a pole there are none.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import fields
from functools import partial
from itertools import combinations, islice, pairwise

from ..errors import Problem
from ..language.expression import Expression
from ..language.floats import evaluate
from ..language.functions import KINKED
from ..language.tree import Call, Name, Negation, Node, Sum, walk
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

Point = Mapping[str, float]
Along = Callable[[float], float]
CONTINUOUS = ("position", "angle")  # fields of places, bodies and moments


def continuity_problems(scene: Scene) -> Iterator[Problem]:
    """The potentials, positions and angles that jump as coordinates change, by the function that makes them."""
    about = tuple(points_around(scene))
    points = (*about, *({**point} | {c.name: point[c.name] - c.value for c in scene.coordinates} for point in about))
    for key, things in (("points", scene.points), ("bodies", scene.bodies), ("loads", scene.loads)):
        for index, thing in enumerate(things):
            for place, expression in _expressions(thing, CONTINUOUS):
                pointer = f"/{key}/{index}/{place}"
                yield from _problem(scene, "position-jumps", pointer, expression, expression.tree, points)
    for index, load in enumerate(scene.loads):
        for part in load.contributions(scene.places, scene.bodies):
            if isinstance(part, PotentialEnergy | GeneralizedPotential):
                for place, expression in _expressions(load):
                    pointer = f"/loads/{index}/{place}"
                    yield from _problem(scene, "potential-jumps", pointer, expression, part.energy, points)


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


def _problem(
    scene: Scene, code: str, pointer: str, expression: Expression, whole: Node, points: tuple[Point, ...]
) -> Iterator[Problem]:
    """At a function in an expression with which the whole jumps, as far as so much work tells."""
    lines = tuple(_lines(expression.tree, {coordinate.name for coordinate in scene.free}))
    size = sum(1 for _ in walk(whole))
    work = (2 * STEPS * sum(1 for _ in walk(switch)) + 2 * MOST * size for _, switch, _ in lines)
    looks = int(MOST_WORK // max(work, default=1))
    every = ((*line, point) for point in points for line in lines)
    for node, switch, name, point in islice(every, looks):
        if _jumps_along(partial(_at, switch, point, name), partial(_at, whole, point, name), point[name]):
            span = node.span
            call = expression.text[span.offset : span.offset + span.length]
            yield Problem(code, pointer, span.offset, span.length, {"call": call[:60]})
            return


def _lines(tree: Node, free: set[str]) -> Iterator[tuple[Call, Node, str]]:
    """Each function that may jump, what it switches by, and a coordinate to change; in time alone it may jump."""
    for node in walk(tree):
        if isinstance(node, Call) and node.function in KINKED:
            names = sorted({part.name for part in walk(node) if isinstance(part, Name)} & free)
            yield from ((node, switch, name) for switch in _switches(node) for name in names)


def _switches(node: Call) -> tuple[Node, ...]:
    """What changes its sign where the function switches."""
    if len(node.arguments) == 1:
        return node.arguments
    return tuple(Sum((one, Negation(other))) for one, other in combinations(node.arguments, 2))


def _at(tree: Node, point: Point, name: str, x: float) -> float:
    return evaluate(tree, {**point, name: x})


def _jumps_along(switch: Along, value: Along, start: float) -> bool:
    unit = max(1.0, abs(start)) * NEAREST
    places = [start + unit * math.sinh(k * GROWTH) for k in range(-STEPS, STEPS + 1)]
    signs = [_sign(switch(x)) for x in places]
    found = 0
    for (low, below), (high, above) in pairwise(zip(places, signs, strict=True)):
        if below == above or math.isnan(below) or math.isnan(above):
            continue
        if _differs(value, *_narrowed(switch, low, high)):
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


def _differs(value: Along, low: float, high: float) -> bool:
    """Whether values on both sides tend to different limits."""
    size = max(abs(low), abs(high), NEAREST)
    sides = [(value(low - size * apart), value(high + size * apart)) for apart in APART]
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
