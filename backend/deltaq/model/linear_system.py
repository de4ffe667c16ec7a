"""M q̈ = f + Aᵀλ, A q̈ = γ as matrices: what a model's packed outputs say of some states."""

from __future__ import annotations

from typing import NamedTuple

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
    at, shape = layout.motion, (*table.shape[:-1], len(layout.multipliers), layout.degrees)
    rows = table[..., at.rows].reshape(shape)
    return LinearSystem(table.take(at.mass, axis=-1), table[..., at.forces], rows, table[..., at.gamma])
