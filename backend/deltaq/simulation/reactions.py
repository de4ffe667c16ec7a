"""Reactions along a motion: the multipliers of constraints, and what holds released lengths and coordinates."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .consistency import SHARES, idle_multipliers
from .constraints import Reactions, settled
from .derivatives import accelerations
from .problem import Floats, Problem, Released, Stretch, numbers_of_stretches


def releasing(problem: Problem, released: Released) -> Problem:
    """The problem that is asked what holds something; not unique is what changes with multipliers without effect.

    A guide that holds an angle which rods hold as well takes any part of it.
    """
    moved, asked = problem.moved, replace(problem, released=released)
    if moved is None or not moved.undetermined:
        return asked
    idle = idle_multipliers(problem)
    held = np.vstack([np.zeros(idle.shape[1]), idle])
    states = np.tile(problem.state[: 2 * problem.degrees], (len(held), 1))
    given = problem.inputs(np.zeros(len(held)), states)
    table = released.held_by.along(problem.model, np.hstack([given, np.zeros((len(held), problem.degrees)), held]))
    loose = (np.abs(table[1:] - table[0]) > SHARES * np.abs(idle).max(axis=1)[:, None]).any(axis=0)
    names = [name for name, is_loose in zip(released.names, loose, strict=True) if is_loose]
    return replace(asked, moved=replace(moved, undetermined=(*moved.undetermined, *names)))


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
    rows = np.hstack([problem.inputs(times, states), accelerations(problem, times, states), held.multipliers])
    of_released = problem.released.held_by.along(problem.model, rows)
    return states, Reactions(np.hstack([held.multipliers, of_released]), held.gaps)


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
