"""The quintic through positions, rates and accelerations at two neighbouring samples of a motion.

Its error falls with the sixth power of their distance.
Source: Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, II.6 (Hermite interpolation).
"""

from __future__ import annotations

import numpy as np

from ..simulation.derivatives import accelerations
from ..simulation.march import Polynomials
from ..simulation.problem import Floats, Problem
from ..simulation.section import Brackets, Surface, refined


def quintics(problem: Problem, begins: Floats, ends: Floats) -> Polynomials:
    """The motion of a problem between rows (q, q̇, t) and others a little later, shape (places, 2n + 1) each."""
    n = problem.degrees
    (q, v, a), (q1, v1, a1) = (
        (rows[:, :n], rows[:, n : 2 * n], accelerations(problem, rows[:, -1], rows)) for rows in (begins, ends)
    )
    h = (ends[:, -1] - begins[:, -1])[:, None]
    d, v, v1, a, a1 = q1 - q, h * v, h * v1, h**2 * a, h**2 * a1
    third = 10.0 * d - 6.0 * v - 4.0 * v1 - 1.5 * a + 0.5 * a1
    fourth = -15.0 * d + 8.0 * v + 7.0 * v1 + 1.5 * a - a1
    fifth = 6.0 * d - 3.0 * (v + v1) - 0.5 * (a - a1)
    positions = np.stack([q, v, 0.5 * a, third, fourth, fifth], axis=1)
    rates = np.stack([v, a, 3.0 * third, 4.0 * fourth, 5.0 * fifth, np.zeros_like(v)], axis=1) / h[:, None]
    coefficients, old = np.concatenate([positions, rates], axis=2), begins[:, : 2 * n]
    return Polynomials(coefficients, old, np.zeros_like(old), begins[:, -1], h[:, 0], n)


def crossings(problem: Problem, rows: Floats, surface: Surface) -> Floats:
    """Where a motion through rows (q, q̇, t), shape (samples, 2n + 1), crosses a surface, as shape (crossings, 2n + 1).

    Between samples it is the quintic, and the root is sought on that.
    """
    found = surface.values(rows)[:, 0]
    shift = surface.shift(0.5 * (found[:-1] + found[1:]))
    left, right = found[:-1] - shift, found[1:] - shift
    (where,) = np.nonzero(surface.is_crossed(left, right) & np.isfinite(left + right))
    if not len(where):
        return rows[:0]
    series = quintics(problem, rows[where], rows[where + 1])
    ends = np.zeros(len(where)), np.ones(len(where))
    brackets = Brackets(where, series, *ends, left[where], right[where], shift[where])
    return refined(brackets, surface).rows
