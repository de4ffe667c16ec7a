"""One step of a method as a map of phase space, (q, p) to (q, p)."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from deltaq.simulation.library import get_method
from deltaq.simulation.problem import Problem
from deltaq.simulation.run import Steps, run


def momentum(problem: Problem, q: np.ndarray, v: np.ndarray, t: float) -> tuple[np.ndarray, np.ndarray]:
    """M and p at (q, v, t)."""
    n = problem.degrees
    table = problem.model.phase.function.table(np.array([[*q, *v, t, *problem.parameters]]))[0]
    mass = np.zeros((n, n))
    mass[np.tril_indices(n)] = table[: n * (n + 1) // 2]
    return mass + np.tril(mass, -1).T, table[n * (n + 1) // 2 :][:n]


def velocity(problem: Problem, q: np.ndarray, p: np.ndarray, t: float) -> np.ndarray:
    mass, rest = momentum(problem, q, np.zeros(problem.degrees), t)
    return np.linalg.solve(mass, p - rest)


def stepped(problem: Problem, method: str, h: float, q: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """q and q̇ after one step from t = 0."""
    start = replace(problem, values=tuple(q), rates=tuple(v), t_end=h)
    done = run(start, get_method(method), np.array([0.0, h]), np.zeros(1, dtype=np.int64), Steps(h))
    assert (done.is_complete, done.result.steps) == (True, 1)
    n = problem.degrees
    return done.states[-1, :n], done.states[-1, n : 2 * n]


def jacobian(problem: Problem, method: str, h: float, nudge: float = 1e-5) -> np.ndarray:
    """∂(q₁, p₁)/∂(q₀, p₀) by differences of error nudge⁴."""
    n, q = problem.degrees, np.array(problem.values)
    centre = np.concatenate([q, momentum(problem, q, np.array(problem.rates), 0.0)[1]])

    def image(z: np.ndarray) -> np.ndarray:
        q1, v1 = stepped(problem, method, h, z[:n], velocity(problem, z[:n], z[n:], 0.0))
        return np.concatenate([q1, momentum(problem, q1, v1, h)[1]])

    def column(e: np.ndarray) -> np.ndarray:
        near, far = image(centre + e) - image(centre - e), image(centre + 2 * e) - image(centre - 2 * e)
        return (8 * near - far) / 12

    return np.column_stack([column(100 * nudge * e) / (100 * nudge) for e in np.eye(2 * n)])


def symplectic_defect(matrix: np.ndarray) -> float:
    """The largest entry of Jᵀ Ω J − Ω."""
    n = len(matrix) // 2
    omega = np.block([[np.zeros((n, n)), np.eye(n)], [-np.eye(n), np.zeros((n, n))]])
    return float(np.abs(matrix.T @ omega @ matrix - omega).max())
