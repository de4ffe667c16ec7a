"""The weights of methods in double precision: tableaus are given in fractions, or to 40 digits."""

from __future__ import annotations

from functools import cache

import numpy as np

from .kernels.stages import ImplicitWeights
from .kernels.step import Weights
from .method import Partitioned, Row, Tableau
from .problem import Floats


@cache
def explicit_weights(tableau: Tableau) -> Weights:
    """A tableau as the kernel wants it."""
    stages, extra = tableau.stages, len(tableau.extra_c)
    return Weights(
        matrix(tableau.a[1:], stages),
        numbers(tableau.b),
        numbers(tableau.c[1:]),
        matrix(tableau.error, stages + 1),
        matrix(tableau.dense, stages + 1 + extra),
        matrix(tableau.extra_a, stages + 1 + extra),
        numbers(tableau.extra_c),
        int(any(len(row) > stages and row[stages] for row in tableau.error)),
    )


def implicit_weights(scheme: Partitioned) -> ImplicitWeights:
    """A pair of tableaus as the kernel wants it."""
    a, momentum_a = matrix(scheme.a, scheme.stages), matrix(scheme.momentum_a, scheme.stages)
    b, c = numbers(scheme.b), numbers(scheme.c)
    return ImplicitWeights(a, b, c, momentum_a, b, momentum_a @ a, numbers(scheme.error))


def numbers(row: Row) -> Floats:
    """A row of a tableau: shape (entries,)."""
    return np.array([float(number) for number in row])


def matrix(rows: tuple[Row, ...], width: int) -> Floats:
    """Rows of a tableau, each filled up with zeros: shape (rows, width)."""
    found = np.zeros((len(rows), width))
    for index, row in enumerate(rows):
        found[index, : len(row)] = numbers(row)
    return found
