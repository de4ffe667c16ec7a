"""M q̈ = f solved in operations on series."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol


@dataclass(frozen=True)
class Value:
    """A series at a place, or a constant: the formula of that number."""

    place: int
    is_constant: bool


class Arithmetic(Protocol):
    """Writes operations on values."""

    def multiply(self, a: Value, b: Value) -> Value:
        """a b."""

    def subtract(self, a: Value, b: Value) -> Value:
        """a − b."""

    def divide(self, a: Value, b: Value) -> Value:
        """a / b."""

    def minus_products(self, value: Value, a: Sequence[Value], b: Sequence[Value]) -> Value:
        """value − Σ aᵢ bᵢ."""


def solved(writer: Arithmetic, m: list[Value], f: list[Value]) -> tuple[list[Value], list[tuple[Value, Value]]]:
    """q̈ from M q̈ = f, and the pivots with the diagonal entries that they are left of.

    By L D Lᵀ, coordinates of constant inertia first, since a constant pivot divides for nothing; two coordinates of
    inertias that all move by determinants, whose operations wait least for each other.
    """
    n = len(f)
    order = sorted(range(n), key=lambda i: not m[_packed(i, i)].is_constant)
    m = [m[_packed(order[i], order[j])] for i in range(n) for j in range(i + 1)]
    f = [f[i] for i in order]
    has_constants = any(each.is_constant for each in m)
    found, pivots = _by_determinants(writer, m, f) if n == 2 and not has_constants else _by_pivots(writer, m, f)
    return [found[order.index(i)] for i in range(n)], pivots


def _packed(i: int, j: int) -> int:
    """Where entry (i, j) stands in a packed lower triangle."""
    i, j = max(i, j), min(i, j)
    return i * (i + 1) // 2 + j


def _by_determinants(w: Arithmetic, m: list[Value], f: list[Value]) -> tuple[list[Value], list[tuple[Value, Value]]]:
    a, b, c = m
    largest = w.multiply(a, c)
    determinant = w.subtract(largest, w.multiply(b, b))
    first = w.subtract(w.multiply(c, f[0]), w.multiply(b, f[1]))
    second = w.subtract(w.multiply(a, f[1]), w.multiply(b, f[0]))
    return [w.divide(each, determinant) for each in (first, second)], [(a, a), (determinant, largest)]


def _by_pivots(w: Arithmetic, m: list[Value], f: list[Value]) -> tuple[list[Value], list[tuple[Value, Value]]]:
    n = len(f)
    pivots: list[Value] = []
    lower: list[list[Value]] = []
    for i in range(n):
        row = m[i * (i + 1) // 2 : (i + 1) * (i + 2) // 2]
        products: list[Value] = []
        for j in range(i):
            products.append(w.minus_products(row[j], products[:j], lower[j]))
        factors = [w.divide(product, pivots[j]) for j, product in enumerate(products)]
        pivots.append(w.minus_products(row[i], products, factors))
        lower.append(factors)
    x: list[Value] = []
    for i in range(n):
        x.append(w.minus_products(f[i], lower[i], x))
    for i in range(n - 1, -1, -1):
        later = range(i + 1, n)
        x[i] = w.minus_products(w.divide(x[i], pivots[i]), [lower[k][i] for k in later], [x[k] for k in later])
    return x, [(pivots[i], m[_packed(i, i)]) for i in range(n)]
