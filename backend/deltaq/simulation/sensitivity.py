"""How far accelerations move with what a model says: bounds of |∂q̈/∂M|, |∂q̈/∂f| and of |∂q̈/∂A|, |∂q̈/∂γ|.

From M q̈ = f: dq̈ = M⁻¹ (df − dM q̈). With constraints q̈ and λ solve K (q̈, λ) = (f, γ), K = [M −Aᵀ; A 0], and
d(q̈, λ) = K⁻¹ (d(f, γ) − dK (q̈, λ)) in the same way.
"""

from __future__ import annotations

from contextlib import suppress

import numpy as np

from ..model.layout import Layout
from ..model.linear_system import linear_system
from .problem import Floats

DEPENDENT = 1e-9  # of the largest singular value of K: what rows that follow from others have but for rounding


def sensitivities(layout: Layout, table: Floats, sizes: Floats, rank: int) -> tuple[Floats, Floats]:
    """By M (packed triangle) and f, shape (states, n (n + 1)/2 + n); by A and γ, shape (states, m n + m).

    `table`, shape (states, outputs), is what the model says of some states; a change of qᵢ counts relative to `sizes`,
    shape (states, n). `rank` constraints are independent.
    """
    n, m, (rows, columns) = layout.degrees, len(layout.multipliers), layout.motion.triangle
    system = linear_system(layout, table)
    matrix = np.zeros((len(table), n + m, n + m))
    matrix[:, :n, :n], matrix[:, n:, :n], matrix[:, :n, n:] = system.mass, system.rows, -system.rows.transpose(0, 2, 1)
    right = np.hstack([system.forces, system.gamma])
    inverse = _inverse(matrix) if rank == m else _inverse_of_independent(matrix)
    with np.errstate(invalid="ignore"):
        weights = (inverse[:, :n] / sizes[:, :, None]).sum(axis=1)
        found = np.nan_to_num(np.abs(inverse @ np.abs(right[:, :, None]))[:, :, 0], nan=0.0)
        accelerations, multipliers = found[:, :n], found[:, n:]
        of_mass = weights[:, rows] * accelerations[:, columns] + np.where(
            rows != columns, weights[:, columns] * accelerations[:, rows], 0.0
        )
        of_rows = weights[:, None, :n] * multipliers[:, :, None] + weights[:, n:, None] * accelerations[:, None, :]
    return np.hstack([of_mass, weights[:, :n]]), np.hstack([of_rows.reshape(len(table), m * n), weights[:, n:]])


def _inverse_of_independent(matrix: Floats) -> Floats:
    """The same where constraints follow from others, for the least λ; infinite where K is not finite."""
    inverse, known = np.full(matrix.shape, np.inf), np.isfinite(matrix).all(axis=(1, 2))
    inverse[known] = np.abs(np.linalg.pinv(matrix[known], rcond=DEPENDENT))
    return inverse


def _inverse(matrix: Floats) -> Floats:
    """The absolute values of K⁻¹, infinite where K has none."""
    if np.isfinite(matrix).all():
        with suppress(np.linalg.LinAlgError):  # where all have one, as nearly always
            return np.asarray(np.abs(np.linalg.inv(matrix)))
    inverse = np.full(matrix.shape, np.inf)
    for k in np.flatnonzero(
        np.isfinite(matrix).all(axis=(1, 2))
    ):  # one by one: determinants may fall below all numbers
        with suppress(np.linalg.LinAlgError):
            inverse[k] = np.abs(np.linalg.inv(matrix[k]))
    return inverse
