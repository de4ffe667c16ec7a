"""What is seen of a motion at its samples."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..model.model import Observation
from ..model.modes import Modes
from .problem import Floats, Problem, Stretch, numbers_of_stretches


def observed(
    problem: Problem, modes: Modes | None, times: Floats, states: Floats, stretches: tuple[Stretch, ...]
) -> Observation:
    """Energies, positions and forces; along a kink a force is that between its sides which keeps the motion there.

    `times` has shape (samples,), `states` shape (samples, ≥ 2n).
    """
    seen = problem.model.observe(problem.inputs(times, states))
    if modes is None or not modes.switches or not stretches:
        return seen
    arrows = {name: force.copy() for name, force in seen.arrows.items()}
    number = numbers_of_stretches(times, stretches)
    for k in np.unique(number):
        here, own = number == k, stretches[k].problem
        for name, force in own.model.observe(own.inputs(times[here], states[here])).arrows.items():
            arrows[name][here] = force
    return replace(seen, arrows=arrows)
