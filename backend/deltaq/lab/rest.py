"""The position of rest near a state: where no force is left, ∂V/∂q and all others in balance.

Newton's method on f(q, 0, t = 0) = 0, with a numeric Jacobian; damped, so that it stays near.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..errors import Problem as Mistake
from ..errors import RequestError
from ..simulation.problem import Floats, Problem

PASSES, CLOSE, NUDGE, LONGEST_MOVE = 60, 1e-12, 1e-6, 0.5
LEFT = 1e-6  # of force per unit of stiffness


def at_rest(problem: Problem, pointer: str) -> Problem:
    """The problem with a position of rest for its initial state. Raises RequestError where none is found nearby."""
    values = np.array(problem.values)
    for _ in range(PASSES):
        force = _forces(problem, values[None, :])[0]
        jacobian = _jacobian(problem, values)
        if not (np.isfinite(force).all() and np.isfinite(jacobian).all()):
            break
        move = np.linalg.lstsq(jacobian, -force, rcond=1e-10)[0]  # a direction without forces stays as it is
        values = values + move * min(1.0, LONGEST_MOVE / max(float(np.abs(move).max()), 1e-300))
        if np.abs(move).max() < CLOSE * max(1.0, np.abs(values).max()):
            if np.abs(force).max() > LEFT * np.abs(jacobian).max(initial=1.0):
                break  # a force that no displacement changes
            return replace(problem, values=tuple(map(float, values)), rates=(0.0,) * problem.degrees)
    raise RequestError(Mistake("lab-no-rest", pointer))


def _forces(problem: Problem, values: Floats) -> Floats:
    """f of M q̈ = f at rest, for rows of q."""
    states = np.hstack([values, np.zeros_like(values)])
    return problem.system(np.zeros(len(values)), states).forces


def _jacobian(problem: Problem, values: Floats) -> Floats:
    nudges = NUDGE * np.maximum(1.0, np.abs(values))
    up, down = (_forces(problem, values + sign * np.diag(nudges)) for sign in (1.0, -1.0))
    return np.asarray((up - down).T / (2.0 * nudges))
