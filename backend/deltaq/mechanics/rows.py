"""The rows ∂g/∂qᵢ or ∂u/∂q̇ᵢ of constraints in plain numbers, and which of them depend on others."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from ..language.expression import Expression
from ..language.floats import evaluate
from ..language.spelling import spell_rate
from ..language.tree import Node
from .conditions import Condition

STEP = 1e-5
NOTHING = 1e-7  # the differences are good to about 1e-10, of lengths of a millimetre to 1e-8

Row = tuple[float, ...]
Point = Mapping[str, float]


def row_of(condition: Condition, free: Sequence[str], point: Point) -> Row:
    """The coefficients of the virtual displacements in a condition, by central differences of fourth order.

    The point names coordinates, rates, parameters and t.
    """
    if condition.is_holonomic:
        names = Expression("", condition.value).names
        return tuple(_slope(condition.value, point, name) if name in names else 0.0 for name in free)
    still = {**point, **{name: 0.0 for name in point if name.startswith("dot(")}}
    return tuple(growth(condition.value, still, spell_rate(name, 1), 1.0) / 2 for name in free)


def rate_of(condition: Condition, free: Sequence[str], point: Point) -> float:
    """u at a point, or the rate of g, to whose value its coordinates and rates count alike."""
    if not condition.is_holonomic:
        return evaluate(condition.value, point)
    along = dot(row_of(condition, free, point), tuple(point[spell_rate(name, 1)] for name in free))
    return along + (_slope(condition.value, point, "t") if "t" in Expression("", condition.value).names else 0.0)


def _slope(node: Node, point: Point, name: str) -> float:
    near, far = (growth(node, point, name, step) for step in (STEP, 2 * STEP))
    return (8 * near - far) / (12 * STEP)


def growth(node: Node, point: Point, name: str, step: float) -> float:
    """What the value of an expression grows by between a step below and a step above."""
    up, down = {**point, name: point[name] + step}, {**point, name: point[name] - step}
    return evaluate(node, up) - evaluate(node, down)


def independent(rows: Sequence[Row], nothing: float) -> tuple[int, ...]:
    """Rows that all others depend on: each time that of which most is left beside those chosen before.

    Each counts with length 1; what is shorter than `nothing` then depends on the others.
    """
    left, found = {index: unit(row) for index, row in enumerate(rows)}, list[int]()
    while left:
        longest = max(left, key=lambda index: dot(left[index], left[index]))
        if not math.sqrt(dot(left[longest], left[longest])) > nothing:
            break
        along = unit(left.pop(longest))
        found.append(longest)
        left = {index: _beside(row, along) for index, row in left.items()}
    return tuple(sorted(found))


def _beside(row: Row, along: Row) -> Row:
    """What is left of a row beside another one of length 1; taken twice, for what rounding leaves."""
    once = minus(row, along, dot(row, along))
    return minus(once, along, dot(once, along))


def dot(a: Row, b: Row) -> float:
    """a·b"""
    return math.fsum(x * y for x, y in zip(a, b, strict=True))


def minus(a: Row, b: Row, factor: float) -> Row:
    """a − factor b"""
    return tuple(x - factor * y for x, y in zip(a, b, strict=True))


def unit(row: Row) -> Row:
    """The row scaled to length 1; one of zeros stays."""
    length = math.sqrt(dot(row, row))
    return tuple(entry / length for entry in row) if length else row
