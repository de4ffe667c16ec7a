"""Roots of small systems of equations, by Newton's method, damped where it would overshoot.

Each step d minimizes |F + J d|² + λ|d|²; λ falls while steps succeed and rises when one fails. With λ → 0 this is
Newton's method; it also converges to sets of roots that are not isolated.
Source: Marquardt, J. SIAM 11 (1963), 431.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

Vector = list[float]
Row = dict[int, float]  # what is not zero, by columns: of a large scene each equation has but a few of the unknowns
Field = Callable[[Sequence[float]], Vector]
Slopes = Callable[[Sequence[float]], list[Row]]

ITERATIONS = 60
DAMPING, SMALLEST, LARGEST = 1e-3, 1e-14, 1e8
SETTLED = 1e-11
DENSE = 12  # unknowns up to which looking for what is not zero does not pay


def root(field: Field, slopes: Slopes, start: Vector, scale: float) -> Vector | None:
    """A root near the start, if there is one: |F| is then below 1e-9 of `scale`, and the last step was tiny."""
    if not math.isfinite(scale):
        return None
    x, damping, value = list(start), DAMPING, field(start)
    for _ in range(ITERATIONS):
        if not _finite(value):
            return None
        step = step_of(slopes(x), value, damping, len(x))
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


def step_of(slopes: Sequence[Row], value: Vector, damping: float, size: int) -> Vector | None:
    """The d of `size` parts that minimizes |F + J d|² + λ|d|², λ relative to the size of J; None if it is too large."""
    products: list[dict[int, list[float]]] = [{} for _ in range(size)]
    turned: list[list[float]] = [[] for _ in range(size)]
    for row, force in zip(slopes, value, strict=True):
        for i, a in row.items():
            turned[i].append(a * force)
            for j, b in row.items():
                products[i].setdefault(j, []).append(a * b)
    try:
        normal = [{j: math.fsum(terms) for j, terms in row.items()} for row in products]
        right = [-math.fsum(terms) for terms in turned]
    except (OverflowError, ValueError):  # a sum, or one of its terms, is infinite
        return None
    largest = max((row.get(i, 0.0) for i, row in enumerate(normal)), default=0.0) or 1.0
    for i, row in enumerate(normal):
        row[i] = row.get(i, 0.0) + damping * largest
    if size <= DENSE:
        return solved([[row.get(j, 0.0) for j in range(size)] for row in normal], right)
    return _eliminated(normal, right)


def _eliminated(rows: list[Row], right: Vector) -> Vector | None:
    """The solution of A x = b for a symmetric positive definite A, which needs no pivots; None if it is not.

    What has the fewest neighbours is eliminated first, so that few entries are filled in (George, Liu, Computer
    Solution of Large Sparse Positive Definite Systems, ch. 5).
    """
    left, done = set(range(len(rows))), []
    while left:
        column = min(left, key=lambda i: (len(rows[i]), i))
        left.remove(column)
        top = rows[column]
        pivot = top.pop(column)
        if not pivot > 0:
            return None
        for r, a in top.items():
            factor, row = a / pivot, rows[r]
            del row[column]
            for k, b in top.items():
                row[k] = row.get(k, 0.0) - factor * b
            right[r] -= factor * right[column]
        done.append((column, pivot, top))
    x = [0.0] * len(rows)
    for column, pivot, top in reversed(done):
        x[column] = (right[column] - sum(b * x[k] for k, b in top.items())) / pivot
    return x


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
