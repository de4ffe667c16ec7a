"""How far two motions are apart, in one norm for all rungs: metres, in the metric of the kinetic energy,

    d² = Δqᵀ M(q) Δq / m,   Δq = q of the rung − q of the full model,   m the mass of all bodies;

for angles the chord 2 sin(Δφ/2), so that one that is off by a whole turn is right.

E = ½ q̇ᵀ M q̇ makes M the metric of the configuration space, so to first order d is the root mean square distance, over
all mass, between where a particle is and where the rung puts it. Angles and lengths come in one unit, heavy parts
count for more, and no coordinate is invisible, as the spin of a top is in the position of its centre of mass.
Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §8.6 (the metric); Lurie, Analytical Mechanics, ch. 4.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...simulation.problem import Floats, Problem


@dataclass(frozen=True)
class Yardstick:
    """The full motion at `times`, its states (q, q̇), the mass of all bodies, and the error of the integration."""

    problem: Problem
    mass: float
    times: Floats
    states: Floats
    floor: float

    def errors(self, values: Mapping[str, Floats]) -> Floats:
        """d at each sample that a rung, its values by coordinate, has in common with the full motion, in metres."""
        count = min(len(self.times), *(len(each) for each in values.values()))
        rung = np.column_stack([values[name][:count] for name in self.problem.model.layout.free])
        return self._lengths(rung, self.states[:count, : self.problem.degrees])

    @property
    def end(self) -> float:
        """When the motion ends; 0 if it could not begin."""
        return float(self.times[-1]) if len(self.times) else 0.0

    @cached_property
    def extent(self) -> float:
        """How far the motion gets from where it began, in metres."""
        values = self.states[:, : self.problem.degrees]
        return float(self._lengths(values[:1], values).max(initial=0.0))

    def _lengths(self, values: Floats, full: Floats) -> Floats:
        """The distances of values from the full motion, sample by sample."""
        count, angular = len(full), np.array(self.problem.angular)
        apart = np.where(angular, 2.0 * np.sin((values - full) / 2.0), values - full)
        masses = mass_matrices(self.problem, self.times[:count], self.states[:count])
        squares = np.einsum("ti,tij,tj->t", apart, masses, apart)
        return np.asarray(np.sqrt(np.maximum(squares, 0.0) / self.mass))


def mass_matrices(problem: Problem, times: Floats, states: Floats) -> Floats:
    """M(q, t) at the samples: shape (samples, degrees, degrees)."""
    n = problem.degrees
    table = problem.model.motion.table(problem.inputs(times, states))
    lower = np.tril_indices(n)
    matrices = np.zeros((len(times), n, n))
    matrices[:, lower[0], lower[1]] = matrices[:, lower[1], lower[0]] = table[:, : len(lower[0])]
    return matrices
