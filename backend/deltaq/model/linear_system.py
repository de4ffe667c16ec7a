"""M q̈ = f + Aᵀλ, A q̈ = γ as matrices: what a model's packed outputs say of some states."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from .compiled import Floats
from .layout import Layout


@dataclass(frozen=True)
class LinearSystem:
    """M q̈ = f + Aᵀλ, A q̈ = γ at each of some states, for n coordinates and m constraints.

    `mass` (M) has shape (states, n, n), `forces` (f) shape (states, n), `rows` (A) shape (states, m, n) and `bends` (γ)
    shape (states, m).
    """

    mass: Floats
    forces: Floats
    rows: Floats
    bends: Floats


def linear_system(layout: Layout, table: Floats) -> LinearSystem:
    """The system of each row of `table`, shape (states, outputs): what `Model.motion` gives."""
    n, m, states = layout.degrees, len(layout.multipliers), len(table)
    lower, right = _triangle(n)
    first = lower.size + n + (n + 1 if layout.is_powered else 0)
    mass = np.zeros((states, n, n))
    mass[:, lower, right] = mass[:, right, lower] = table[:, : lower.size]
    forces = table[:, lower.size : lower.size + n]
    rows = table[:, first : first + m * n].reshape(states, m, n)
    return LinearSystem(mass, forces, rows, table[:, first + m * n : first + m * n + m])


@lru_cache(maxsize=64)
def _triangle(n: int) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """The rows and columns of M's lower triangle, row by row; behind an event they are asked for many times."""
    return np.tril_indices(n)
