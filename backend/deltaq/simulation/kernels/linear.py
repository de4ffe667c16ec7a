"""Small dense systems of linear equations."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .compiler import inner
from .motion import Floats

Places = NDArray[np.int64]


@inner
def decompose(a: Floats, places: Places) -> bool:
    """P A = L U in place, with partial pivoting; False if A is singular or not finite (Golub, Van Loan, §3.4)."""
    n = places.size
    for k in range(n):
        best = k
        for i in range(k + 1, n):
            if abs(a[i, k]) > abs(a[best, k]):
                best = i
        places[k] = best
        if not 0.0 < abs(a[best, k]) < np.inf:
            return False
        for j in range(n):
            a[k, j], a[best, j] = a[best, j], a[k, j]
        for i in range(k + 1, n):
            a[i, k] /= a[k, k]
            for j in range(k + 1, n):
                a[i, j] -= a[i, k] * a[k, j]
    return True


@inner
def substitute(a: Floats, places: Places, x: Floats) -> None:
    """Solves A x = b in place, b standing in x, for a decomposed A."""
    n = places.size
    for k in range(n):
        x[k], x[places[k]] = x[places[k]], x[k]
    for i in range(n):
        for k in range(i):
            x[i] -= a[i, k] * x[k]
    for i in range(n - 1, -1, -1):
        for k in range(i + 1, n):
            x[i] -= a[i, k] * x[k]
        x[i] /= a[i, i]
