"""Solutions of homogeneous linear equations that are known in floats: a basis in which each vector is sparse."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

Row = list[float]

NOTHING = 1e-7  # what is left of an equation, its entries in their scales, that depends on those before
LARGE = 0.05  # of the largest entry: one that may be divided by


def kernel(rows: Iterable[Row], scales: Sequence[float]) -> list[Row]:
    """Vectors that span {c : Σₖ rowₖ cₖ = 0 for all rows}, in reduced form: one free component is 1, the others 0.

    `scales` has for each column how large its entries are where nothing cancels: what is far below that is rounding.
    """
    echelon: dict[int, Row] = {}
    for row in rows:
        _enter(echelon, [entry / scale if scale else 0.0 for entry, scale in zip(row, scales, strict=True)])
    return [_vector(echelon, k, scales) for k in range(len(scales)) if k not in echelon]


def _enter(echelon: dict[int, Row], row: Row) -> None:
    """Takes one more equation into the reduced echelon form; one with entries beyond all numbers says nothing."""
    for pivot, other in echelon.items():
        factor = row[pivot]
        if factor:
            row = [a - factor * b for a, b in zip(row, other, strict=True)]
    if not all(map(math.isfinite, row)):
        return
    size = max(map(abs, row), default=0.0)
    if size < NOTHING:
        return
    pivot = next(k for k, entry in enumerate(row) if abs(entry) >= LARGE * size)
    row = [entry / row[pivot] for entry in row]
    for k, other in echelon.items():
        factor = other[pivot]
        if factor:
            echelon[k] = [a - factor * b for a, b in zip(other, row, strict=True)]
    echelon[pivot] = row


def _vector(echelon: dict[int, Row], free: int, scales: Sequence[float]) -> Row:
    """The solution whose free components are 0 but this one, which is 1."""
    unit = scales[free] or 1.0
    found = [0.0] * len(scales)
    found[free] = 1.0
    for pivot, row in echelon.items():
        if abs(row[free]) > NOTHING:
            found[pivot] = -row[free] * unit / scales[pivot]
    return found
