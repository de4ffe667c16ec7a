"""How a motion goes on at given states: accelerations and power, from the right-hand side that is integrated, too."""

from __future__ import annotations

import numpy as np

from .integration import motion_of
from .kernels.slopes import evaluate
from .problem import Floats, Problem


def slopes(problem: Problem, times: Floats, states: Floats) -> Floats:
    """d/dt of (q, q̇ and, where power is fed in, ∫P dt), one row for each of states; zero where that has no value."""
    out = np.zeros((len(times), problem.state.size))
    rows = np.ascontiguousarray(states[:, : 2 * problem.degrees])
    evaluate(motion_of(problem, is_long=False), np.ascontiguousarray(times), rows, out)
    return out


def accelerations(problem: Problem, times: Floats, states: Floats) -> Floats:
    """q̈, one row for each of states (q, q̇, …); zero where they have no value."""
    n = problem.degrees
    return slopes(problem, times, states)[:, n : 2 * n]


def power(problem: Problem, times: Floats, states: Floats) -> Floats:
    """P = P₀ + p₁·q̈ of all that is not in E + V: other forces, guides and explicit time dependence."""
    if not problem.model.layout.is_powered:
        return np.zeros(len(times))
    return slopes(problem, times, states)[:, -1]
