"""What is seen of a motion at its samples."""

from __future__ import annotations

from dataclasses import replace

from ..model.model import Observation
from ..model.modes import Modes
from .problem import Floats, Problem, Stretch, inputs_of_stretches


def observed(
    problem: Problem, modes: Modes | None, times: Floats, states: Floats, stretches: tuple[Stretch, ...]
) -> Observation:
    """Energies, positions and forces; along a kink a force is that between its sides which keeps the motion there.

    `times` has shape (samples,), `states` shape (samples, ≥ 2n).
    """
    seen = problem.model.observe(problem.inputs(times, states))
    if modes is None or not modes.switches or not stretches:
        return seen
    in_modes = stretches[0].problem.model.observe(inputs_of_stretches(times, states, stretches))
    return replace(seen, arrows={**seen.arrows, **in_modes.arrows})
