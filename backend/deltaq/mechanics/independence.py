"""Whether constraints say different things, and gaps anything, in plain numbers.

Constraints are looked at by the rows aᵢ = ∂u/∂q̇ᵢ or ∂g/∂qᵢ at random configurations.

Constraints whose rows depend on one another everywhere are functions of one another: one of them says nothing new, or
contradicts the others. Rows that do so only where the constraints hold (a parallelogram with three rods) are for the
numerics to find: the motion is determined, the multipliers are not.
"""

from __future__ import annotations

import math
import random
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from ..errors import Problem
from ..language.floats import evaluate
from ..language.spelling import spell_rate
from ..language.tree import Node
from .conditions import Condition
from .constraints.distance import DistanceConstraint
from .scene import Scene

POINTS = 5
STEP = 1e-5
NOTHING = 1e-7  # the differences are good to about 1e-10

Row = tuple[float, ...]
Point = Mapping[str, float]


def independence_problems(scene: Scene) -> Iterator[Problem]:
    """Constraints without effect on what is free, those that follow from others, and those that contradict them."""
    if not scene.constraints:
        return
    yield from _lengths(scene)
    found = [each for point in _points(scene) if (each := _Rows.at(scene, point)) is not None]
    idle = [i for i in range(len(scene.conditions)) if found and all(each.is_idle(i) for each in found)]
    yield from (Problem("constraint-without-coordinates", f"/constraints/{i}") for i in idle)
    ties = [each.tie() for each in found]
    if not idle and ties and all(ties):
        yield _tied(scene, found, min(ties, key=len))


def gap_problems(scene: Scene) -> Iterator[Problem]:
    """Impacts whose gap no coordinate changes, so that they would have no direction."""
    names = [coordinate.name for coordinate in scene.coordinates]
    for index, event in enumerate(scene.events):
        if not event.bounces or event.value.rates:
            continue
        rows = [[_slope(event.value.tree, point, name, STEP) for name in names] for point in _points(scene)]
        known = [row for row in rows if all(map(math.isfinite, row))]
        if known and not any(any(row) for row in known):
            yield Problem("bounce-without-coordinates", f"/events/{index}/value")


def _lengths(scene: Scene) -> Iterator[Problem]:
    """A rod without length has no direction in which its force could act."""
    start = {p.name: p.value for p in scene.parameters} | {c.name: c.value for c in scene.coordinates} | {"t": 0.0}
    for index, constraint in enumerate(scene.constraints):
        if isinstance(constraint, DistanceConstraint) and (length := evaluate(constraint.length.tree, start)) <= 0:
            yield Problem("length-not-positive", f"/constraints/{index}/length", parameters={"value": f"{length:g}"})


@dataclass(frozen=True)
class _Rows:
    """At one configuration, the values of the conditions and the coefficients of the virtual displacements in each."""

    values: Row
    rows: tuple[Row, ...]

    @classmethod
    def at(cls, scene: Scene, point: Point) -> _Rows | None:
        """None where something is not defined."""
        rows = tuple(_row(condition, scene, point) for condition in scene.conditions)
        values = tuple(evaluate(condition.value, point) for condition in scene.conditions)
        finite = all(math.isfinite(entry) for row in (values, *rows) for entry in row)
        return cls(values, rows) if finite else None

    def is_idle(self, index: int) -> bool:
        return max(map(abs, self.rows[index])) <= NOTHING * max(abs(entry) for row in self.rows for entry in row)

    def tie(self) -> tuple[int, ...]:
        """The rows that depend on one another, the last of them on the others; empty if none does.

        Each row, scaled to length 1, is reduced by an orthonormal basis of those before it.
        """
        basis: list[Row] = []
        for index, row in enumerate(self.rows):
            rest = _unit(row)
            for each in (*basis, *basis):
                rest = _minus(rest, each, _dot(rest, each))
            if math.sqrt(_dot(rest, rest)) < NOTHING:
                return (*(i for i in range(index) if self._is_needed(i, index)), index)
            basis.append(_unit(rest))
        return ()

    def _is_needed(self, without: int, index: int) -> bool:
        """Whether row `index` depends on those before it no longer if one of them is left out."""
        kept = tuple(row for i, row in enumerate(self.rows[:index]) if i != without)
        return not _Rows((), (*kept, self.rows[index])).tie()


def _tied(scene: Scene, found: list[_Rows], tie: tuple[int, ...]) -> Problem:
    names = ", ".join(scene.constraints[i].name for i in tie)
    code = "contradictory-constraints" if _is_contradiction(found, tie) else "dependent-constraints"
    return Problem(
        code, f"/constraints/{tie[-1]}", parameters={"name": scene.constraints[tie[-1]].name, "names": names}
    )


def _is_contradiction(found: list[_Rows], tie: tuple[int, ...]) -> bool:
    """Whether two conditions g and c g differ by a constant other than zero, so that both cannot hold."""
    if len(tie) != 2:
        return False
    first, second = tie
    differences = []
    for each in found:
        factor = _dot(each.rows[first], each.rows[second]) / _dot(each.rows[first], each.rows[first])
        differences.append(each.values[second] - factor * each.values[first])
    return min(map(abs, differences)) > NOTHING and max(differences) - min(differences) < NOTHING


def _row(condition: Condition, scene: Scene, point: Point) -> Row:
    names = [coordinate.name for coordinate in scene.free]
    if condition.is_holonomic:
        return tuple(_slope(condition.value, point, name, STEP) / (2 * STEP) for name in names)
    still = {**point, **{spell_rate(coordinate.name, 1): 0.0 for coordinate in scene.coordinates}}
    return tuple(_slope(condition.value, still, spell_rate(name, 1), 1.0) / 2 for name in names)


def _slope(node: Node, point: Point, name: str, step: float) -> float:
    up, down = {**point, name: point[name] + step}, {**point, name: point[name] - step}
    return evaluate(node, up) - evaluate(node, down)


def _points(scene: Scene) -> Iterator[Point]:
    """Random configurations, away from the symmetric ones that initial values tend to be."""
    source = random.Random(1)
    parameters = {parameter.name: parameter.value for parameter in scene.parameters}
    for _ in range(POINTS):
        values = {c.name: c.value + source.uniform(0.2, 0.9) for c in scene.coordinates}
        rates = {spell_rate(c.name, 1): source.uniform(-1.0, 1.0) for c in scene.coordinates}
        yield parameters | values | rates | {"t": source.uniform(0.1, 1.0)}


def _dot(a: Row, b: Row) -> float:
    return sum(x * y for x, y in zip(a, b, strict=True))


def _minus(a: Row, b: Row, factor: float) -> Row:
    return tuple(x - factor * y for x, y in zip(a, b, strict=True))


def _unit(row: Row) -> Row:
    length = math.sqrt(_dot(row, row))
    return tuple(entry / length for entry in row) if length else row
