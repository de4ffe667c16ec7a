"""Reactions along a motion: the multipliers of constraints, and what holds released lengths and coordinates."""

from __future__ import annotations

import numpy as np

from .constraints import Reactions, settled
from .derivatives import accelerations
from .problem import Floats, Problem, Stretch, numbers_of_stretches


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


def reactions_along(
    problem: Problem, times: Floats, states: Floats, stretches: tuple[Stretch, ...]
) -> tuple[Floats, Reactions]:
    """The same along a motion that goes on behind events: each state counts in the mode of its stretch.

    `times` has shape (samples,), `states` shape (samples, width).
    """
    if not stretches:
        return reactions_at(problem, times, states)
    number = numbers_of_stretches(times, stretches)
    found = np.array(states)
    held = Reactions(np.zeros((len(times), len(problem.reactions))), np.zeros(len(times)))
    for k in np.unique(number):
        here = np.flatnonzero(number == k)
        kept, reactions = reactions_at(stretches[k].problem, times[here], states[here])
        good = here[: len(kept)]
        found[good], held.multipliers[good], held.gaps[good] = kept, reactions.multipliers, reactions.gaps
        if len(kept) < len(here):
            return found[: here[len(kept)]], held.first(int(here[len(kept)]))
    return found, held
