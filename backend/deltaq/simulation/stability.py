"""Where a method is stable: the stability function of its tableau."""

from __future__ import annotations

import math
from functools import cache

import numpy as np

from .method import Row, Scheme, Tableau

FINENESS, FARTHEST = 0.01, 20.0


def stability_function(a: tuple[Row, ...], b: Row, z: complex) -> complex:
    """R(z) = 1 + z bᵀ (1 − zA)⁻¹ 𝟙: the factor by which a step of y′ = λy multiplies y, z = λh."""
    stages = len(b)
    matrix = np.zeros((stages, stages))
    for index, row in enumerate(a):
        matrix[index, : len(row)] = [float(number) for number in row]
    weights = np.array([float(number) for number in b])
    return complex(1.0 + z * (weights @ np.linalg.solve(np.eye(stages) - z * matrix, np.ones(stages))))


@cache
def real_stability(scheme: Scheme) -> float:
    """How far an explicit method is stable on the negative real axis, to about one percent below; others: unasked."""
    if not isinstance(scheme, Tableau):
        return math.inf
    places = np.arange(FINENESS, FARTHEST, FINENESS)
    unstable = (x for x in places if abs(stability_function(scheme.a, scheme.b, -x)) > 1.0)
    return 0.99 * float(next(unstable, FARTHEST))
