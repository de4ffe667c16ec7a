"""How many constraints are independent where they all hold, in plain numbers.

A linkage may have more rods than it needs to move in one way only, as a platform on three parallel ones does: the rows
∂g/∂qᵢ or ∂u/∂q̇ᵢ depend on one another wherever all constraints hold, and nowhere else. A count of constraints then
tells too few degrees of freedom. The rank of the rows is looked at in positions beside the initial one: there it may be
lower, as in a linkage that is stretched. Where no other position is near there is no motion, whatever the rank.
Source: Nikravesh, Computer-Aided Analysis of Mechanical Systems, §3.4 (redundant constraints); positions by the method
of Levenberg and Marquardt, which converges fast where rows depend on one another: Yamashita, Fukushima, Computing
Suppl. 15 (2001) 239–249.
"""

from __future__ import annotations

import math
import random
from collections.abc import Sequence
from dataclasses import dataclass

from ..language.floats import evaluate
from .conditions import Condition
from .rows import Point, Row, dot, independent, row_of

PASSES = 60
SETTLED = 1e-14  # corrections relative to coordinates above 1
KEPT = 1e-9  # of what a constraint changes by when coordinates change by 1 or their own size
LEAST = 1e-13  # the damping that is left at last: rows count with length 1
AROUND, POINTS = (1e-3, 1e-5), 3  # how far around a position, the second for millimetres, and at how many points
STAYS = 0.1  # of that distance: what comes back closer to the position has no other one near
WEAK = 1e-6  # of a row of length 1: what is no more independent than that


@dataclass(frozen=True)
class Independence:
    """Constraints that are independent of one another, by their numbers, and how many rates they leave.

    From these `chosen` ones the others follow. `unmet` is the constraint that the start is furthest from where no
    position that keeps all is near, and `gap` what it is off by; all count as independent then.
    """

    chosen: tuple[int, ...]
    freedoms: int
    unmet: int | None = None
    gap: float = 0.0


def independence(conditions: Sequence[Condition], free: Sequence[str], start: Point) -> Independence:
    """Of constraints near a point that names coordinates, rates, parameters and t."""
    held = _Held(tuple(conditions), tuple(free))
    place = held.settled(start)
    if place is None or held.worst(place) is not None:
        index = held.worst(start) or 0
        gap = abs(evaluate(conditions[index].value, start))
        return Independence(tuple(range(len(conditions))), len(free) - len(conditions), index, gap)
    here = held.independent(place)
    beside = [held.independent(each) for each in held.beside(place)]
    found = max(beside, key=len, default=here)
    is_fixed = not beside and len(here) < len(free) and any(each.is_holonomic for each in conditions)
    return Independence(found, 0 if is_fixed else len(free) - len(found))


def position_on(conditions: Sequence[Condition], free: Sequence[str], start: Point) -> Point | None:
    """A point near `start` whose coordinates keep all holonomic conditions; None if none is found."""
    held = _Held(tuple(conditions), tuple(free))
    place = held.settled(start)
    return None if place is None or held.worst(place) is not None else place


@dataclass(frozen=True)
class _Held:
    conditions: tuple[Condition, ...]
    free: tuple[str, ...]

    @property
    def _holonomic(self) -> tuple[Condition, ...]:
        return tuple(each for each in self.conditions if each.is_holonomic)

    def independent(self, point: Point) -> tuple[int, ...]:
        rows = [row_of(each, self.free, point) for each in self.conditions]
        return independent(rows, WEAK) if _are_finite(rows) else tuple(range(len(rows)))

    def beside(self, place: Point) -> list[Point]:
        """Positions that keep the constraints a little away from a place that does."""
        source = random.Random(1)
        for reach in AROUND:
            tried = (self._moved(place, reach, source) for _ in range(POINTS))
            found = [each for each in tried if each is not None]
            if found:
                return found
        return []

    def _moved(self, place: Point, reach: float, source: random.Random) -> Point | None:
        """Such a position, if there is one that stays away."""
        near = {q: place[q] + reach * max(1.0, abs(place[q])) * source.uniform(-1.0, 1.0) for q in self.free}
        moved = self.settled({**place, **near})
        if moved is None or self.worst(moved) is not None:
            return None
        return moved if max(_part(moved[q] - place[q], place[q]) for q in self.free) > STAYS * reach else None

    def worst(self, point: Point) -> int | None:
        """The holonomic constraint that is furthest from being kept; None where all are."""
        parts = [self._missed(each, point) if each.is_holonomic else 0.0 for each in self.conditions]
        largest = max(range(len(parts)), key=parts.__getitem__)
        return largest if parts[largest] > KEPT else None

    def _missed(self, condition: Condition, point: Point) -> float:
        gap, row = abs(evaluate(condition.value, point)), row_of(condition, self.free, point)
        size = sum(abs(entry) * max(1.0, abs(point[q])) for entry, q in zip(row, self.free, strict=True))
        part = gap / size if size > 0.0 else math.inf if gap else 0.0
        return part if math.isfinite(part) else math.inf

    def settled(self, point: Point) -> Point | None:
        """The position that Δq = −Aᵀ(AAᵀ + μ)⁻¹g leads to, μ = |g|², each row scaled to length 1; None if to none."""
        here = dict(point)
        for _ in range(PASSES if self._holonomic else 0):
            rows = [row_of(each, self.free, here) for each in self._holonomic]
            gaps = [evaluate(each.value, here) for each in self._holonomic]
            if not _are_finite([*rows, gaps]):
                return None
            lengths = [math.sqrt(dot(row, row)) or 1.0 for row in rows]
            scaled = [tuple(x / length for x in row) for row, length in zip(rows, lengths, strict=True)]
            off = [gap / length for gap, length in zip(gaps, lengths, strict=True)]
            shares = _damped(scaled, off)
            steps = [sum(y * row[i] for y, row in zip(shares, scaled, strict=True)) for i in range(len(self.free))]
            here |= {q: here[q] - step for q, step in zip(self.free, steps, strict=True)}
            if max(_part(step, here[q]) for q, step in zip(self.free, steps, strict=True)) <= SETTLED:
                break
        return here


def _damped(rows: list[Row], off: list[float]) -> list[float]:
    """(AAᵀ + μ)⁻¹g by Cholesky's factors, which exist for any rows."""
    damping, count = max(math.fsum(each * each for each in off), LEAST), len(rows)
    lower = [[0.0] * count for _ in rows]
    found = list(off)
    for i in range(count):
        for j in range(i + 1):
            total = dot(rows[i], rows[j]) + (damping if i == j else 0.0)
            total -= sum(lower[i][k] * lower[j][k] for k in range(j))
            lower[i][j] = math.sqrt(max(total, LEAST * LEAST)) if i == j else total / lower[j][j]
        found[i] = (found[i] - sum(lower[i][k] * found[k] for k in range(i))) / lower[i][i]
    for i in reversed(range(count)):
        found[i] = (found[i] - sum(lower[k][i] * found[k] for k in range(i + 1, count))) / lower[i][i]
    return found


def _part(change: float, value: float) -> float:
    return abs(change) / max(1.0, abs(value))


def _are_finite(rows: Sequence[Sequence[float]]) -> bool:
    return all(math.isfinite(entry) for row in rows for entry in row)
