"""Matrices that may have no full rank, symmetric or nearly so: factors with pivoting along the diagonal, and solutions
in what is independent.

Source: Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., §10.3.
"""

from __future__ import annotations

import numpy as np

from .compiler import inline
from .linear import Indices
from .motion import SMALLEST_SCHUR_PIVOT, Floats


@inline
def exchange(a: Floats, count: int, k: int, j: int) -> None:
    """Rows k and j of a matrix by rows, shape (≥ count²,), change places, and so do its columns."""
    for i in range(count):
        a[k * count + i], a[j * count + i] = a[j * count + i], a[k * count + i]
    for i in range(count):
        a[i * count + k], a[i * count + j] = a[i * count + j], a[i * count + k]


@inline
def largest_pivot(matrix: Floats, count: int, k: int) -> int:
    """The row from k on with the largest diagonal entry; −1 if one is not finite. `matrix` has shape (≥ count²,)."""
    best = k
    for i in range(k, count):
        if not abs(matrix[i * count + i]) < np.inf:
            return -1
        if matrix[i * count + i] > matrix[best * count + best]:
            best = i
    return best


@inline
def factor_ranked(matrix: Floats, order: Indices, count: int) -> tuple[int, float]:
    """L D U of a matrix with unit diagonal in place: its rank, and its smallest pivot above SMALLEST_SCHUR_PIVOT.

    L and U have diagonals of ones; of a symmetric matrix U is Lᵀ. `matrix`, shape (≥ count²,), holds it by rows,
    `order`, shape (≥ count,), receives the order of its rows. The rank is −1 if a number is not finite.
    """
    smallest = 1.0
    for k in range(count):
        order[k] = k
    for k in range(count):
        best = largest_pivot(matrix, count, k)
        if best < 0:
            return -1, np.nan
        if best != k:
            order[k], order[best] = order[best], order[k]
            exchange(matrix, count, k, best)
        pivot = matrix[k * count + k]
        if not pivot > SMALLEST_SCHUR_PIVOT:
            return k, smallest
        smallest = min(smallest, pivot)
        for i in range(k + 1, count):
            part = matrix[i * count + k] / pivot
            for j in range(k + 1, count):
                matrix[i * count + j] -= part * matrix[k * count + j]
            matrix[i * count + k] = part
        for j in range(k + 1, count):
            matrix[k * count + j] /= pivot
    return count, smallest


@inline
def solve_ranked(matrix: Floats, order: Indices, count: int, rank: int, scales: Floats, right: Floats) -> None:
    """Solves with the factors for `right`, shape (≥ count,), which becomes λ; 0 for what depends on the others.

    Constraints that depend on one another have no unique multipliers; the motion is the same with any of them.
    """
    for k in range(count):
        right[k] *= scales[k]
    for k in range(rank):
        total = right[order[k]]
        for j in range(k):
            total -= matrix[k * count + j] * right[order[j]]
        right[order[k]] = total
    for k in range(rank - 1, -1, -1):
        total = right[order[k]] / matrix[k * count + k]
        for j in range(k + 1, rank):
            total -= matrix[k * count + j] * right[order[j]]
        right[order[k]] = total
    for k in range(rank, count):
        right[order[k]] = 0.0
    for k in range(count):
        right[k] *= scales[k]


@inline
def determinant(a: Floats, n: int) -> float:
    """The determinant of a matrix by rows, shape (≥ n²,), which is overwritten."""
    if n == 2:
        return float(a[0] * a[3] - a[1] * a[2])
    found = 1.0
    for k in range(n):
        best = k
        for i in range(k + 1, n):
            if abs(a[i * n + k]) > abs(a[best * n + k]):
                best = i
        if a[best * n + k] == 0.0:
            return 0.0
        if best != k:
            found = -found
            for j in range(n):
                a[k * n + j], a[best * n + j] = a[best * n + j], a[k * n + j]
        found *= a[k * n + k]
        for i in range(k + 1, n):
            part = a[i * n + k] / a[k * n + k]
            for j in range(k, n):
                a[i * n + j] -= part * a[k * n + j]
    return found
