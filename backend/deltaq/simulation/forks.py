"""Whether a run ended where its constraints lose their independence: a linkage that is stretched or may fold.

There A(q) of A q̇ + b = 0 loses rank. Close to it Newton's corrections and steps fail before the rank does, as what the
constraints determine is a quotient of what both tend to zero.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .problem import Floats, Problem

PART = 0.05  # of the largest independence that the motion had
CLOSE = 1e-5  # the same, where a run has gone on
HALTING = 1e-3  # steps, of the median or, where more than half of all are at the fork, of the mean: it shortens them
NOTHING = 1e-9  # singular values relative to the largest that are rounding errors
PARTS = 64  # of a step in which the rows of A have turned far: smooth ones turn little from part to part


def is_at_fork(problem: Problem, times: Floats, states: Floats, reached: float) -> bool:
    """Whether the smallest singular value of A, each row by its largest length, fell to little of its largest.

    `times` in order, shape (states,), and `states`, shape (states, 2n), tell the motion up to the time `reached`.
    """
    degrees = problem.degrees
    if not (problem.is_constrained and len(times)):
        return False
    last = states[-1].copy()
    last[:degrees] += (reached - times[-1]) * last[degrees:]
    return bool(_independence(problem, np.append(times, reached), np.vstack([states, last]))[-1] <= PART)


def fork_passed(problem: Problem, times: Floats, states: Floats) -> float | None:
    """When a run crept over a fork: what it does behind it, rounding has decided. None if it did not.

    `times`, shape (mesh,), and `states`, shape (mesh, 2n), are its mesh.
    """
    if not problem.is_constrained or len(times) < 3:
        return None
    steps = np.diff(times)
    halting = np.flatnonzero(steps <= HALTING * max(np.median(steps), steps.mean()))
    if not halting.size:
        return None
    left = _independence(problem, times, states)
    forks = halting[np.minimum(left[halting], left[halting + 1]) <= CLOSE]
    return float(times[forks[0]]) if forks.size else None


def fork_crossed(problem: Problem, times: Floats, states: Floats) -> float | None:
    """The start of the first step within which det(A₀A₁ᵀ) changes its sign: a fork lies there. None if there is none.

    The steps of a run are looked at by their cubics in parts, for where rows only turn far, no part shows it. `times`,
    shape (mesh,), and `states`, shape (mesh, 2n), are its whole mesh.
    """
    if not problem.is_constrained or problem.rank < len(problem.model.layout.multipliers) or len(times) < 2:
        return None
    for k in np.flatnonzero(_turned(_rows(problem, times, states))):
        if _turned(_rows(problem, *_between(times[k : k + 2], states[k : k + 2], problem.degrees))).any():
            return float(times[k])
    return None


def _turned(rows: Floats) -> NDArray[np.bool_]:
    """Whether det(A₀A₁ᵀ) is below zero from each A to the next; `rows` have shape (states, m, n)."""
    return np.asarray(np.linalg.det(rows[:-1] @ rows[1:].transpose(0, 2, 1)) < 0.0)


def _between(times: Floats, states: Floats, n: int) -> tuple[Floats, Floats]:
    """Times and states of the cubic through both ends of a step, which have shapes (2,) and (2, 2n)."""
    h, x = times[1] - times[0], np.linspace(0.0, 1.0, PARTS + 1)[:, None]
    (q0, v0), (q1, v1) = ((each[:n], h * each[n:]) for each in states[:, : 2 * n])
    c2, c3 = 3.0 * (q1 - q0) - 2.0 * v0 - v1, v0 + v1 - 2.0 * (q1 - q0)
    values, rates = q0 + x * (v0 + x * (c2 + x * c3)), (v0 + x * (2.0 * c2 + 3.0 * x * c3)) / h
    return times[0] + h * x[:, 0], np.hstack([values, rates])


def _independence(problem: Problem, times: Floats, states: Floats) -> Floats:
    """The smallest singular value of A that is not always zero, relative to its largest, at each state."""
    rows = _rows(problem, times, states)
    lengths = np.linalg.norm(rows, axis=2).max(axis=0)
    if not np.isfinite(rows).all() or not lengths.any():
        return np.ones(len(times))
    values = np.linalg.svd(rows / np.where(lengths > 0.0, lengths, 1.0)[:, None], compute_uv=False)
    largest = values.max(axis=0)
    smallest = values[:, int((largest > NOTHING * largest[0]).sum()) - 1]
    return np.asarray(smallest / smallest.max())


def _rows(problem: Problem, times: Floats, states: Floats) -> Floats:
    """A at each state, shape (states, m, n)."""
    return problem.system(times, states).rows
