"""Generalized momenta p = ∂E/∂q̇, and the rates that belong to given ones."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...mechanics.scene import Scene
from ...model.cyclic import cyclic_coordinates
from ...simulation.problem import Floats, Problem
from ...simulation.service import problem_of
from .rest_frame import in_rest_frame


def momenta(problem: Problem, times: Floats, states: Floats) -> Floats:
    """p = ∂E/∂q̇ of all free coordinates at the samples: shape (samples, n).

    `times` has shape (samples,), `states` shape (samples, ≥ 2n).
    """
    n = problem.degrees
    first = n * (n + 1) // 2
    table = problem.model.phase.function.table(problem.inputs(times, states))
    return np.asarray(table[:, first : first + n])


REGULAR = 1e12  # condition of the part of M that belongs to the cyclic coordinates


@dataclass(frozen=True)
class Conserved:
    """The cyclic coordinates of a problem, by their places among the free ones, and their momenta at the start.

    `values` has shape (cyclic,).
    """

    problem: Problem
    names: tuple[str, ...]
    places: tuple[int, ...]
    values: Floats

    @classmethod
    def of(cls, scene: Scene) -> Conserved:
        """Those of the frame in which the scene rests: in another they may depend on where it has got to."""
        resting = in_rest_frame(scene)
        names, problem = cyclic_coordinates(resting), problem_of(resting, 1.0)
        places = tuple(index for index, each in enumerate(scene.free) if each.name in names)
        start = momenta(problem, np.zeros(1), problem.state[None, : 2 * problem.degrees])
        return cls(problem, names, places, start[0, list(places)])

    def rates(self, times: Floats, states: Floats) -> Floats:
        """q̇ at the samples, those of the cyclic coordinates from their momenta: M_c q̇_c = p − p(q̇_c = 0).

        `times` has shape (samples,), `states` shape (samples, 2n); returns shape (samples, n), NaN where that has no
        solution.
        """
        n, chosen = self.problem.degrees, np.array(self.places, dtype=int)
        still = states.copy()
        still[:, n + chosen] = 0.0
        found = still[:, n : 2 * n]
        if chosen.size:
            masses = self.problem.system(times, still).mass[:, chosen][:, :, chosen]
            moved = self.values - momenta(self.problem, times, still)[:, chosen]
            found[:, chosen] = _solutions(masses, moved)
        return found


def _solutions(masses: Floats, right: Floats) -> Floats:
    """M⁻¹ p sample by sample; NaN where M has no inverse."""
    found = np.full(right.shape, np.nan)
    regular = np.flatnonzero(np.linalg.cond(np.nan_to_num(masses)) < REGULAR)
    found[regular] = np.linalg.solve(masses[regular], right[regular][..., None])[..., 0]
    return found
