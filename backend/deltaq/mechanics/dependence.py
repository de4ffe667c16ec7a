"""Constraints that depend on one another everywhere, so that one says nothing new, or contradicts the others.

They are looked at by the rows aᵢ = ∂u/∂q̇ᵢ or ∂g/∂qᵢ at random configurations.
"""

from __future__ import annotations

import math
import random
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from ..errors import Problem
from ..language.floats import evaluate
from ..language.spelling import spell_rate
from .conditions import Condition
from .rows import NOTHING, Point, Row, dot, independent, minus, row_of, unit

POINTS = 5


def dependence_problems(
    conditions: Sequence[Condition], free: Sequence[str], points: Iterable[Point]
) -> Iterator[Problem]:
    """Constraints without effect on what is free, those that follow from others, and those that contradict them."""
    found = [each for point in points if (each := _Rows.at(conditions, free, point)) is not None]
    idle = [i for i in range(len(conditions)) if found and all(each.is_idle(i) for each in found)]
    yield from (Problem("constraint-without-coordinates", f"/constraints/{i}") for i in idle)
    ties = [each.tie() for each in found]
    if not idle and ties and all(ties):
        yield _tied([each.source for each in conditions], found, min(ties, key=len))


@dataclass(frozen=True)
class _Rows:
    """At one configuration, the values of the conditions and the coefficients of the virtual displacements in each."""

    values: Row
    rows: tuple[Row, ...]

    @classmethod
    def at(cls, conditions: Sequence[Condition], free: Sequence[str], point: Point) -> _Rows | None:
        """None where something is not defined."""
        rows = tuple(row_of(condition, free, point) for condition in conditions)
        values = tuple(evaluate(condition.value, point) for condition in conditions)
        finite = all(math.isfinite(entry) for row in (values, *rows) for entry in row)
        return cls(values, rows) if finite else None

    def is_idle(self, index: int) -> bool:
        return max(map(abs, self.rows[index])) <= NOTHING * max(abs(entry) for row in self.rows for entry in row)

    def tie(self) -> tuple[int, ...]:
        """The rows that depend on one another, the last of them on the others; empty if none do.

        Each row, scaled to length 1, is reduced by an orthonormal basis of those before it. One row more than there are
        coordinates depends on the others wherever it comes from: that is no tie.
        """
        basis, kept = list[Row](), list[int]()
        for index, row in enumerate(self.rows):
            rest = unit(row)
            for each in (*basis, *basis):
                rest = minus(rest, each, dot(rest, each))
            if math.sqrt(dot(rest, rest)) >= NOTHING:
                basis.append(unit(rest))
                kept.append(index)
                continue
            found = (*(i for i in kept if self._is_needed(i, kept, index)), index)
            if len(found) <= len(row):
                return found
        return ()

    def _is_needed(self, without: int, kept: list[int], index: int) -> bool:
        """Whether row `index` depends on those kept no longer if one of them is left out."""
        others = [self.rows[i] for i in kept if i != without]
        return len(independent([*others, self.rows[index]], NOTHING)) == len(kept)


def _tied(names: Sequence[str], found: list[_Rows], tie: tuple[int, ...]) -> Problem:
    code = "contradictory-constraints" if _is_contradiction(found, tie) else "dependent-constraints"
    parameters = {"name": names[tie[-1]], "names": ", ".join(names[i] for i in tie)}
    return Problem(code, f"/constraints/{tie[-1]}", parameters=parameters)


def _is_contradiction(found: list[_Rows], tie: tuple[int, ...]) -> bool:
    """Whether two conditions g and c g differ by a constant other than zero, so that both cannot hold."""
    if len(tie) != 2:
        return False
    first, second = tie
    differences = []
    for each in found:
        factor = dot(each.rows[first], each.rows[second]) / dot(each.rows[first], each.rows[first])
        differences.append(each.values[second] - factor * each.values[first])
    return min(map(abs, differences)) > NOTHING and max(differences) - min(differences) < NOTHING


def random_points(start: Point, coordinates: Sequence[str]) -> Iterator[Point]:
    """Random configurations beside a start, away from the symmetric ones that initial values tend to be."""
    source = random.Random(1)
    for _ in range(POINTS):
        values = {name: start[name] + source.uniform(0.2, 0.9) for name in coordinates}
        rates = {spell_rate(name, 1): source.uniform(-1.0, 1.0) for name in coordinates}
        yield {**start, **values, **rates, "t": source.uniform(0.1, 1.0)}
