"""Coordinates that are held at rest all the time: what rounding leaves them of a motion is none.

Constraints A q̇ = 0, friction that sticks and contacts that rest hold qᵢ if q̇ᵢ is a combination of what they hold.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..model.modes import Modes, modes_of_model
from .mode_state import in_mode_of
from .problem import Floats, Problem
from .run import Mesh
from .sliding import ALONG, unit_row

STILL = 1e-9  # of a coordinate, or of 1: what moves less does not move with a surface either


def held_at_rest(problem: Problem, meshes: Sequence[Mesh], values: Floats) -> NDArray[np.bool_]:
    """The coordinates held in each stretch and not moved: shape (n,); `values` has shape (n, samples).

    That they stay where they begin is known without a second run.
    """
    moved = np.abs(values - values[:, :1]).max(axis=1, initial=0.0)
    is_held = moved <= STILL * np.maximum(1.0, np.abs(values).max(axis=1, initial=0.0))
    modes = modes_of_model(problem.model) if is_held.any() else None
    if modes is None:
        return np.zeros(len(values), dtype=bool)
    for mesh in meshes:
        is_held &= _held(modes, mesh)
    return np.asarray(is_held)


def _held(modes: Modes, mesh: Mesh) -> NDArray[np.bool_]:
    """Whether the rows that hold where a stretch begins have each coordinate's axis in their span: shape (n,)."""
    current = in_mode_of(mesh.problem, modes, mesh.start)
    held = [current.facts.a[row] for row, flag in enumerate(current.mode.flags) if flag]
    rows = [unit_row(current, row) for row in (*current.kept[0], *held)]
    if not rows:
        return np.zeros(len(current.q), dtype=bool)
    _, sizes, directions = np.linalg.svd(np.array(rows))
    free = directions[np.count_nonzero(sizes > ALONG) :]
    return np.asarray(np.abs(free).max(axis=0, initial=0.0) <= ALONG)
