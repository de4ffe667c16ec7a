"""Roots of small systems of equations, by Newton's method, damped where it would overshoot.

Each step d minimizes |F + J d|² + λ|d|²; λ falls while steps succeed and rises when one fails. With λ → 0 this is
Newton's method; it also converges to sets of roots that are not isolated.
Source: Marquardt, J. SIAM 11 (1963), 431.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from operator import mul
from typing import Any

Vector = list[float]
Matrix = list[Vector]
Field = Callable[[Sequence[float]], Vector]
Slopes = Callable[[Sequence[float]], Matrix]

ITERATIONS = 60
DAMPING, SMALLEST, LARGEST = 1e-3, 1e-14, 1e8
SETTLED = 1e-11


def root(field: Field, slopes: Slopes, start: Vector, scale: float) -> Vector | None:
    """A root near the start, if there is one: |F| is then below 1e-9 of `scale`, and the last step was tiny."""
    if not math.isfinite(scale):
        return None
    x, damping, value = list(start), DAMPING, field(start)
    for _ in range(ITERATIONS):
        if not _finite(value):
            return None
        step = step_of(slopes(x), value, damping)
        if step is None:
            return None
        size, tried = math.hypot(*step), [a + b for a, b in zip(x, step, strict=True)]
        ahead = field(tried)
        if _finite(ahead) and math.hypot(*ahead) <= math.hypot(*value):
            x, value, damping = tried, ahead, max(damping / 10, SMALLEST)
            if size < SETTLED * (1 + math.hypot(*x)) and damping < DAMPING:
                break
        elif size < SETTLED * (1 + math.hypot(*x)):
            break
        else:
            damping *= 10
        if damping > LARGEST:
            break
    settled = math.hypot(*value) <= 1e-9 * scale and size < 1e-6 * (1 + math.hypot(*x))
    return x if settled else None


def _finite(values: Vector) -> bool:
    return all(map(math.isfinite, values))


def step_of(slopes: Matrix, value: Vector, damping: float) -> Vector | None:
    """The d that minimizes |F + J d|² + λ|d|², λ relative to the size of J; None if it is too large."""
    columns = [list(column) for column in zip(*slopes, strict=True)]
    try:
        normal = [[math.fsum(map(mul, a, b)) for b in columns] for a in columns]
        right = [-math.fsum(map(mul, column, value)) for column in columns]
    except (OverflowError, ValueError):  # a sum, or one of its terms, is infinite
        return None
    size = max((normal[i][i] for i in range(len(normal))), default=0.0) or 1.0
    for i, row in enumerate(normal):
        row[i] += damping * size
    return solved(normal, right)


def solved(matrix: list[list[Any]], right: list[Any]) -> list[Any] | None:
    """The solution of A x = b by elimination with pivots; None if A is singular. Takes any kind of number."""
    rows = [[*row, b] for row, b in zip(matrix, right, strict=True)]
    n = len(rows)
    for column in range(n):
        pivot = max(range(column, n), key=lambda r: abs(rows[r][column]))
        if not abs(rows[pivot][column]) > 0:
            return None
        rows[column], rows[pivot] = rows[pivot], rows[column]
        for r in range(column + 1, n):
            factor = rows[r][column] / rows[column][column]
            if factor != 0:
                rows[r] = [a - factor * b for a, b in zip(rows[r], rows[column], strict=True)]
    x: list[Any] = []
    for row in reversed(range(n)):
        known = sum((a * b for a, b in zip(rows[row][row + 1 : n], x, strict=True)), rows[row][n] * 0)
        x.insert(0, (rows[row][n] - known) / rows[row][row])
    return x
