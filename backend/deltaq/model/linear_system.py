"""M q̈ = f + Aᵀλ, A q̈ = γ as matrices: what a model's packed outputs say of some states."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .compiled import Floats
from .layout import Layout


class LinearSystem(NamedTuple):
    """M q̈ = f + Aᵀλ, A q̈ = γ at each of some states, for n coordinates and m constraints.

    `mass` (M) has shape (states, n, n), `forces` (f) shape (states, n), `rows` (A) shape (states, m, n) and `gamma` (γ)
    shape (states, m); of a single state they have no axis of states.
    """

    mass: Floats
    forces: Floats
    rows: Floats
    gamma: Floats


def linear_system(layout: Layout, table: Floats) -> LinearSystem:
    """The system of each row of `table`, shape (states, outputs), or of one of shape (outputs,): see `Model.motion`."""
    n, m, size = layout.degrees, len(layout.multipliers), layout.degrees * (layout.degrees + 1) // 2
    first = size + n + (n + 1 if layout.is_powered else 0)
    rows = table[..., first : first + m * n].reshape(*table.shape[:-1], m, n)
    gamma = table[..., first + m * n : first + m * n + m]
    return LinearSystem(table.take(_places(n), axis=-1), table[..., size : size + n], rows, gamma)


@lru_cache(maxsize=64)
def _places(n: int) -> NDArray[np.intp]:
    """Where each entry of M stands in its lower triangle, packed row by row: shape (n, n)."""
    lower, right = np.tril_indices(n)
    places = np.zeros((n, n), dtype=np.intp)
    places[lower, right] = places[right, lower] = np.arange(lower.size)
    return places
