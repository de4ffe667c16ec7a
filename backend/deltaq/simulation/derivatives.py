"""The right-hand side at given states: derivatives, accelerations and power, as the integrators have them."""

from __future__ import annotations

import numpy as np

from .integration import motion_of
from .kernels.derivatives import evaluate_rhs
from .problem import Floats, Problem, Stretch, numbers_of_stretches


def derivatives(problem: Problem, times: Floats, states: Floats) -> Floats:
    """d/dt of (q, q̇ and, where power is fed in, ∫P dt); zero where that has no value.

    `times` has shape (states,), `states` shape (states, ≥ 2n); returns shape (states, width), width 2n or 2n + 1.
    """
    out = np.zeros((len(times), problem.state.size))
    at, rows = np.ascontiguousarray(times), np.ascontiguousarray(states)
    evaluate_rhs(motion_of(problem, is_long=False), at, rows, out)
    return out


def accelerations(problem: Problem, times: Floats, states: Floats) -> Floats:
    """q̈ at states (q, q̇, …); zero where it has no value.

    `times` has shape (states,), `states` shape (states, ≥ 2n); returns shape (states, n).
    """
    n = problem.degrees
    return derivatives(problem, times, states)[:, n : 2 * n]


def power(problem: Problem, times: Floats, states: Floats, stretches: tuple[Stretch, ...] = ()) -> Floats:
    """P = P₀ + p₁·q̈ of all that is not in E + V: other forces, guides and explicit time dependence, in W.

    Where a motion goes on behind events, each state counts in the mode of its stretch: what holds a sticking block is
    no sliding friction. Of a time that stands twice, the last state belongs to the stretch that begins then. `times`
    has shape (states,), `states` shape (states, ≥ 2n); returns shape (states,).
    """
    if not stretches:
        return derivatives(problem, times, states)[:, -1] if problem.model.layout.is_powered else np.zeros(len(times))
    number = numbers_of_stretches(times, stretches)
    found = np.zeros(len(times))
    for k in np.unique(number):
        here = number == k
        found[here] = power(stretches[k].problem, times[here], states[here])
    return found
