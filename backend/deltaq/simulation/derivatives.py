"""The right-hand side at given states: derivatives, accelerations and power, as the integrators have them."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from itertools import pairwise

import numpy as np

from .constraints import Finish
from .integration import Workspace, motion_of
from .kernels.derivatives import evaluate_rhs
from .kernels.motion import Motion
from .problem import Floats, Problem, Stretch, numbers_of_stretches


def derivatives(problem: Problem, times: Floats, states: Floats) -> Floats:
    """d/dt of (q, q̇ and, where power is fed in, ∫P dt); zero where that has no value.

    `times` has shape (states,), `states` shape (states, ≥ 2n); returns shape (states, width), width 2n or 2n + 1.
    """
    return _derivatives(motion_of(problem, is_long=False), evaluate_rhs, times, states, problem.width)


def _derivatives(motion: Motion, evaluate: Callable[..., None], times: Floats, states: Floats, width: int) -> Floats:
    """The same by what `evaluate_rhs` is called by."""
    out = np.zeros((len(times), width))
    evaluate(motion, np.ascontiguousarray(times), np.ascontiguousarray(states), out)
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
    if not (stretches[0].problem if stretches else problem).model.layout.is_powered:
        return np.zeros(len(times))
    if not stretches:
        return derivatives(problem, times, states)[:, -1]
    ends = numbers_of_stretches(times, stretches).searchsorted(np.arange(len(stretches) + 1)).tolist()
    workspace, found = Workspace(), np.zeros(len(times))
    evaluate = partial(workspace.call, evaluate_rhs)
    for each, (first, last) in zip(stretches, pairwise(ends), strict=True):
        motion, here = workspace.motion(each.problem, is_long=False, finish=Finish.DERIVATIVE), slice(first, last)
        found[here] = _derivatives(motion, evaluate, times[here], states[here], each.problem.width)[:, -1]
    return found
