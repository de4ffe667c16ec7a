"""The rows ∂g/∂qᵢ or ∂u/∂q̇ᵢ of constraints in plain numbers, and which of them depend on others."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from ..language.floats import evaluate
from ..language.gradients import gradient
from ..language.spelling import spell_rate
from .conditions import Condition

NOTHING = 1e-7  # of a row of length 1

Row = tuple[float, ...]
Point = Mapping[str, float]


def row_of(condition: Condition, free: Sequence[str], point: Point) -> Row:
    """The coefficients of the virtual displacements in a condition, zero where only rounding leaves something.

    The point names coordinates, rates, parameters and t.
    """
    if condition.is_holonomic:
        return gradient(condition.value, point, free)
    still = {**point, **{name: 0.0 for name in point if name.startswith("dot(")}}
    return gradient(condition.value, still, [spell_rate(name, 1) for name in free])


def rate_of(condition: Condition, free: Sequence[str], point: Point) -> float:
    """u at a point, or the rate of g, to whose value its coordinates and rates count alike."""
    if not condition.is_holonomic:
        return evaluate(condition.value, point)
    along = dot(row_of(condition, free, point), tuple(point[spell_rate(name, 1)] for name in free))
    return along + gradient(condition.value, point, ["t"])[0]


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
    shared = dot(row, along)
    if shared == 0.0:
        return row
    once = minus(row, along, shared)
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
