"""Constraints that depend on one another everywhere, so that one says nothing new, or contradicts the others.

They are looked at by the rows aᵢ = ∂u/∂q̇ᵢ or ∂g/∂qᵢ at random configurations.
"""

from __future__ import annotations

import math
import random
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from ..errors import Problem
from ..language.floats import evaluate
from ..language.spelling import spell_rate
from .conditions import Condition
from .redundancy import position_on
from .rows import NOTHING, Point, Row, dot, independent, minus, rate_of, row_of, unit

POINTS = 5


def dependence_problems(
    conditions: Sequence[Condition], free: Sequence[str], points: Iterable[Point]
) -> Iterator[Problem]:
    """Constraints without effect on what is free, those that follow from others, and those that contradict them."""
    near = tuple(points)
    found = [each for point in near if (each := _Rows.at(conditions, free, point)) is not None]
    idle = [i for i in range(len(conditions)) if found and all(each.is_idle(i) for each in found)]
    yield from (Problem("constraint-without-coordinates", f"/constraints/{i}") for i in idle)
    ties = [each.tie() for each in found]
    if not idle and ties and all(ties):
        several = [tie for tie in ties if len(tie) > 1]  # one alone has no row there, too small or large for numbers
        yield _tied(conditions, free, near, min(several or ties, key=len))


@dataclass(frozen=True)
class _Rows:
    """At one configuration, the coefficients of the virtual displacements in each condition."""

    rows: tuple[Row, ...]

    @classmethod
    def at(cls, conditions: Sequence[Condition], free: Sequence[str], point: Point) -> _Rows | None:
        """None where something is not defined."""
        rows = tuple(row_of(condition, free, point) for condition in conditions)
        return cls(rows) if all(math.isfinite(entry) for row in rows for entry in row) else None

    def is_idle(self, index: int) -> bool:
        return not any(self.rows[index])

    def tie(self) -> tuple[int, ...]:
        """The rows that depend on one another, the last of them on the others; empty if none do.

        Each row, scaled to length 1, is reduced by an orthonormal basis of those before it. One row more than there are
        coordinates depends on the others wherever it comes from: that is no tie.
        """
        basis, kept = list[Row](), list[int]()
        for index, row in enumerate(self._balanced):
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
        others = [self._balanced[i] for i in kept if i != without]
        return len(independent([*others, self._balanced[index]], NOTHING)) == len(kept)

    @cached_property
    def _balanced(self) -> tuple[Row, ...]:
        """The rows with coordinates in units in which each counts as much in some row as any other in its own.

        What depends on what is the same in all units, and lengths may be told in 10⁻¹² or 10¹² of those of others.
        """
        rows = [tuple(entry / largest for entry in row) for row in self.rows if (largest := max(map(abs, row)) or 1.0)]
        units = [max(abs(row[i]) for row in rows) or 1.0 for i in range(len(rows[0]))]
        return tuple(tuple(entry / size for entry, size in zip(row, units, strict=True)) for row in rows)


def _tied(
    conditions: Sequence[Condition], free: Sequence[str], points: Sequence[Point], tie: tuple[int, ...]
) -> Problem:
    *others, last = (conditions[i] for i in tie)
    left = [_left(others, last, free, points, point["t"]) for point in points] if others else []
    code = _verdict(left)
    parameters = {"name": last.source, "names": ", ".join(conditions[i].source for i in tie)}
    return Problem(code, f"/constraints/{tie[-1]}", parameters=parameters)


def _verdict(left: Sequence[Sequence[float]]) -> str:
    """What a condition is beside those it depends on, by what is left of it where they hold, at each of some times.

    Nothing: it follows. The same wherever they hold, but not nothing: both cannot hold. Something here, something else
    there: together they demand more of the coordinates than either.
    """
    if all(abs(each) <= NOTHING for at_once in left for each in at_once):
        return "dependent-constraints"
    if all(max(at_once) - min(at_once) <= NOTHING for at_once in left if at_once):
        return "contradictory-constraints"
    return "constraints-on-coordinates"


def _left(
    others: Sequence[Condition], last: Condition, free: Sequence[str], points: Iterable[Point], time: float
) -> list[float]:
    """What the last condition is off by at points moved to where the others hold, all at one time.

    Holonomic conditions count by themselves if all are, else by their rates; both relative to the size of their terms.
    """
    found, sizes, names = list[float](), [1.0], [spell_rate(name, 1) for name in free]
    for point in points:
        place = position_on(others, free, {**point, "t": time})
        if place is None:
            continue
        if last.is_holonomic and all(each.is_holonomic for each in others):
            off, moving = evaluate(last.value, place), [place[name] for name in free]
        else:
            place = {**place, **_rates_on(others, free, place)}
            off, moving = rate_of(last, free, place), [place[name] for name in names]
        found.append(off)
        row = row_of(last, free, place)
        sizes.append(sum(abs(part) * max(1.0, abs(each)) for part, each in zip(row, moving, strict=True)))
    return [each / max(sizes) for each in found if math.isfinite(each)]


def _rates_on(conditions: Sequence[Condition], free: Sequence[str], place: Point) -> dict[str, float]:
    """The rates nearest to those of a point that keep all conditions there, whose rows are independent."""
    names = [spell_rate(name, 1) for name in free]
    rates, basis = dict(place), list[Row]()
    for condition in conditions:
        row, rest = row_of(condition, free, place), row_of(condition, free, place)
        for each in (*basis, *basis):
            rest = minus(rest, each, dot(rest, each))
        if not dot(rest, rest) > NOTHING * NOTHING * dot(row, row):  # here it depends on those before
            continue
        along = unit(rest)  # moves what keeps the conditions before to what keeps this one as well
        change = rate_of(condition, free, rates) / dot(row, along)
        rates |= {name: rates[name] - change * part for name, part in zip(names, along, strict=True)}
        basis.append(along)
    return {name: rates[name] for name in names}


def random_points(start: Point, coordinates: Sequence[str]) -> Iterator[Point]:
    """Random configurations beside a start, away from the symmetric ones that initial values tend to be."""
    source = random.Random(1)
    for _ in range(POINTS):
        values = {name: start[name] + source.uniform(0.2, 0.9) for name in coordinates}
        rates = {spell_rate(name, 1): source.uniform(-1.0, 1.0) for name in coordinates}
        yield {**start, **values, **rates, "t": source.uniform(0.1, 1.0)}
