"""Reactions along a motion: the multipliers of constraints, and what holds released lengths and coordinates."""

from __future__ import annotations

import numpy as np

from .constraints import Reactions, settled
from .derivatives import accelerations
from .problem import Floats, Problem


def reactions_at(problem: Problem, times: Floats, states: Floats) -> tuple[Floats, Reactions]:
    """The states, on their constraints and as far as they are good, and the reactions there, as `Problem.reactions`.

    `times` has shape (samples,), `states` shape (samples, width).
    """
    found = states, Reactions(np.zeros((len(times), 0)), np.zeros(len(times)))
    if problem.is_constrained:
        found = settled(problem, times, states)
    if problem.released is None:
        return found
    states, held = found
    times = times[: len(states)]
    bends = accelerations(problem, times, states)
    rows = np.hstack([problem.inputs(times, states), bends, held.multipliers])
    return states, Reactions(np.hstack([held.multipliers, problem.released.function.table(rows)]), held.gaps)
