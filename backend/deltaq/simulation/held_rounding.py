"""How far rounding moves coordinates that constraints hold: an angle that two rods keep at zero is zero but for that.

Positions are those at which rounded g are zero, next to where they were in the metric of M: they are off by
M⁻¹Aᵀ(AM⁻¹Aᵀ)⁺ δg, where δg is the rounding of the terms that g is the difference of.
Source: Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., §25.2 (what Newton's method can reach).
"""

from __future__ import annotations

import numpy as np

from ..model.linear_system import linear_system
from .consistency import unit_diagonal
from .kernels.motion import SMALLEST_SCHUR_PIVOT
from .problem import Floats, Problem

LOOKS = 25  # samples at which it is looked at; the middle one counts, as it grows without bound towards a fork
OF_TERMS = 4.0 * 2.0**-52


def held_rounding(problem: Problem, times: Floats, states: Floats) -> Floats:
    """The rounding of each coordinate that is due to constraints on positions, shape (n, 1); 0 where there are none.

    `times` has shape (samples,), `states` shape (samples, ≥ 2n).
    """
    n, count = problem.degrees, problem.model.layout.holonomic
    if not count or not len(times):
        return np.zeros((n, 1))
    chosen = np.unique(np.linspace(0, len(times) - 1, LOOKS).astype(int))
    table = problem.model.motion.table(problem.inputs(times[chosen], states[chosen]))
    known = np.isfinite(table).all(axis=1)
    if not known.any():
        return np.zeros((n, 1))
    system = linear_system(problem.model.layout, table[known])
    rows = system.rows[:, :count]
    moved = _moved(system.mass, rows, OF_TERMS * np.abs(rows * states[chosen][known][:, None, :n]).sum(axis=2))
    return np.asarray(np.median(moved, axis=0)[:, None])


def _moved(mass: Floats, rows: Floats, terms: Floats) -> Floats:
    """|M⁻¹Aᵀ(AM⁻¹Aᵀ)⁺| δg: shape (samples, n)."""
    responses = np.linalg.pinv(mass, hermitian=True) @ rows.transpose(0, 2, 1)
    schur = rows @ responses
    scales = unit_diagonal(schur)
    inverse = np.linalg.pinv(
        schur * scales[:, :, None] * scales[:, None, :], rcond=SMALLEST_SCHUR_PIVOT, hermitian=True
    )
    shifts = responses @ (inverse * scales[:, :, None] * scales[:, None, :])
    return np.asarray(np.einsum("snk,sk->sn", np.abs(shifts), terms))
