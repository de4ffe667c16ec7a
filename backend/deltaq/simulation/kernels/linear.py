"""Small dense systems of linear equations."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .compiler import inline
from .motion import Floats

Indices = NDArray[np.int64]


@inline
def decompose(a: Floats, pivots: Indices) -> bool:
    """P A = L U in place with partial pivoting, 1/U on the diagonal; False if A is singular or not finite.

    Who solves often multiplies then, where one division would wait for another one. `a` has shape (n, n) and becomes
    the factors; `pivots`, shape (n,), receives the rows exchanged.
    Source: Golub, Van Loan, Matrix Computations, 4th ed., §3.4.
    """
    n = pivots.size
    for k in range(n):
        best = k
        for i in range(k + 1, n):
            if abs(a[i, k]) > abs(a[best, k]):
                best = i
        pivots[k] = best
        if not 0.0 < abs(a[best, k]) < np.inf:
            return False
        for j in range(n):
            a[k, j], a[best, j] = a[best, j], a[k, j]
        a[k, k] = inverse = 1.0 / a[k, k]
        if not abs(inverse) < np.inf:
            return False
        for i in range(k + 1, n):
            a[i, k] *= inverse
            for j in range(k + 1, n):
                a[i, j] -= a[i, k] * a[k, j]
    return True


@inline
def substitute(a: Floats, pivots: Indices, x: Floats) -> None:
    """Solves A x = b in place for a decomposed A, shape (n, n); `x`, shape (n,), holds b before and x behind."""
    n = pivots.size
    for k in range(n):
        x[k], x[pivots[k]] = x[pivots[k]], x[k]
    for i in range(n):
        left = x[i]  # a number of its own: sums that are kept in memory wait for it
        for k in range(i):
            left -= a[i, k] * x[k]
        x[i] = left
    for i in range(n - 1, -1, -1):
        left = x[i]
        for k in range(i + 1, n):
            left -= a[i, k] * x[k]
        x[i] = left * a[i, i]
