"""What the equations themselves do with a small deviation: the flow that a method is held against.

A deviation from a motion y(t) obeys δ̇ = J(t) δ, J = ∂f/∂y along y. Where J hardly changes, δ grows like e^{t Re λ} and
the eigenvalues λ of the start say all. Elsewhere both motions, y and y + δ, are integrated far more accurately than any
δ that is looked at: what makes their distance grow makes the error of y grow by the same factor, and that begins ten
millions of times smaller.
Source: Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, I.14.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from ..simulation.library import get_method
from ..simulation.method import Method
from ..simulation.problem import Floats, Problem
from ..simulation.run import Run, Steps, run
from ..simulation.stability import Complexes
from ..simulation.stiffness import jacobians
from .step_matrix import Linear, linear

STEPS = 1200  # in one run
KICK, LINEAR = 1e-6, 1e-1  # deviations: at first, and as long as they follow the linearized motion
NOISE = 1e-9  # of the state; below, deviations are those of rounding and of Newton iterations
SMALL = math.log(LINEAR / KICK)  # powers of e by which a deviation may grow
CONSTANT = 0.05  # change of J, relative to its size, below which one linearization holds for all of the motion
ALIKE = 0.1  # difference of J, relative to its size, up to which two motions are of one kind
SHARES = (0.05, 0.25, 0.5, 0.75, 0.95)  # quantiles
PLACES, GOLDEN = 64, 0.6180339887498949  # at which J is looked at, in unlike distances
EXACT, TOLERANCE, LIMIT = "dop853", 1e-13, 100_000


@dataclass(frozen=True)
class Pair:
    """Two motions a little apart at evenly spread times, and their distance at each that both have.

    `distances` has shape (samples,).
    """

    first: Run
    second: Run
    distances: Floats

    @property
    def small(self) -> int:
        """For how many samples the distance has been small."""
        return int((self.distances < LINEAR).cumprod().sum())


@dataclass(frozen=True)
class Neighbours:
    """A motion, given by its initial value problem, and how deviations from it grow; exact pairs are computed once."""

    problem: Problem
    _known: dict[tuple[float, int], Pair] = field(default_factory=dict)

    @cached_property
    def linear(self) -> Linear:
        """The motion linearized at its start."""
        return linear(self.problem)

    @cached_property
    def eigenvalues(self) -> Complexes:
        """λ of the motion linearized at its start, in 1/s: shape (2n,)."""
        return np.asarray(np.linalg.eigvals(self.linear.jacobian)).astype(np.complex128)

    @cached_property
    def drive(self) -> float:
        """The largest Re λ, in 1/s: how fast deviations grow at the start by themselves; 0 if they do not."""
        found = float(self.eigenvalues.real.max(initial=0.0))
        return found if found > NOISE * float(np.abs(self.eigenvalues).max(initial=0.0)) else 0.0

    @cached_property
    def fastest(self) -> float:
        """The largest |λ| at any place of the motion, in 1/s."""
        return float(np.abs(np.linalg.eigvals(self._along)).max(initial=0.0))

    @cached_property
    def varies(self) -> float:
        """The largest change of J along the motion, relative to the size of J."""
        matrices = self._alike(self._along)
        norms, changes = (np.linalg.norm(one, axis=(1, 2)) for one in (matrices, matrices - matrices[0]))
        return float(changes.max() / max(norms.max(), 1e-300))

    @property
    def is_constant(self) -> bool:
        """Whether one linearization holds along the motion."""
        return self.varies <= CONSTANT

    def exact(self, h: float, steps: int) -> Pair:
        """The pair by an accurate method at the times of so many steps h; shorter where it cannot be known."""
        if (h, steps) not in self._known:
            self._known[h, steps] = self._pair(get_method(EXACT), h, steps, Steps(h * steps, TOLERANCE))
        return self._known[h, steps]

    def by(self, method: Method, h: float, steps: int = STEPS) -> Pair:
        """The pair by a method with the fixed step h."""
        return self._pair(method, h, steps, Steps(h))

    def is_kept(self, true: Run, found: Run, count: int) -> bool:
        """Whether two motions are of one kind: their Jacobians take the same values equally often.

        A motion that is a little late is still the same; one that has lost its energy is another.
        """
        wanted, seen = (self._shares(one, min(count, len(one.times))) for one in (true, found))
        return bool(
            np.linalg.norm(seen - wanted, axis=(1, 2)).max() <= ALIKE * np.linalg.norm(wanted, axis=(1, 2)).max()
        )

    def is_at_start(self, found: Run, count: int) -> bool:
        """Whether the linearization at the start holds on the first samples of a run."""
        places = np.unique(np.linspace(0, min(count, len(found.times)) - 1, PLACES).astype(int))
        matrices = self._alike(self._jacobians(found.times[places], found.states[places]))
        size = np.linalg.norm(self._alike(self.linear.jacobian))
        return bool(np.linalg.norm(matrices - self._alike(self.linear.jacobian), axis=(1, 2)).max() <= ALIKE * size)

    @property
    def _start(self) -> Floats:
        return self.problem.state[: 2 * self.problem.degrees]

    @cached_property
    def scales(self) -> Floats:
        """Units of coordinates and rates, shape (2n,).

        A vibration of the fastest part does not change its size in them while it turns.
        """
        return np.repeat([1.0, self.fastest or 1.0], self.problem.degrees)

    @cached_property
    def _along(self) -> Floats:
        """J at the start and at places of the motion, before what is rounding at the start has grown."""
        span = min(self.problem.t_end, SMALL / max(self.drive, 1e-300))
        times = np.concatenate([[0.0], np.sort(span * np.modf(GOLDEN * np.arange(1, PLACES))[0])])
        problem, flag = replace(self.problem, t_end=span, step_limit=LIMIT), np.zeros(1, dtype=np.int64)
        found = run(problem, get_method(EXACT), times, flag, Steps(span, TOLERANCE))
        return self._jacobians(found.times, found.states)

    @cached_property
    def _masses(self) -> Floats:
        """√Mᵢᵢ at the start: times these, coordinates of any units are of one kind."""
        system = self.problem.system(np.zeros(1), self._start[None, :])
        masses = np.abs(np.diagonal(system.mass[0]))
        return np.asarray(np.sqrt(np.where(masses > 0.0, masses, 1.0)))

    def _jacobians(self, times: Floats, states: Floats) -> Floats:
        found = jacobians(self.problem, times, states[:, : 2 * self.problem.degrees])
        return np.asarray(np.nan_to_num(found, posinf=0.0, neginf=0.0))

    def _alike(self, matrices: Floats) -> Floats:
        """J in coordinates and rates that are all of one kind."""
        sizes = np.tile(self._masses, 2) / self.scales
        return np.asarray(matrices * sizes[:, None] / sizes)

    def _shares(self, found: Run, count: int) -> Floats:
        """Quantiles of each entry of J over the first samples."""
        places = np.unique(np.linspace(0, count - 1, 4 * PLACES).astype(int))
        matrices = self._alike(self._jacobians(found.times[places], found.states[places]))
        return np.asarray(np.quantile(matrices, SHARES, axis=0))

    def _pair(self, method: Method, h: float, count: int, steps: Steps) -> Pair:
        n, t_end = self.problem.degrees, count * h
        start = self._start + KICK * self.scales * np.random.default_rng(0).normal(size=2 * n)
        problem = replace(self.problem, t_end=t_end, step_limit=LIMIT if steps.tolerance else 2 * count)
        other = replace(problem, values=tuple(map(float, start[:n])), rates=tuple(map(float, start[n:])))
        times, flag = np.linspace(0.0, t_end, count + 1), np.zeros(1, dtype=np.int64)
        first, second = run(problem, method, times, flag, steps), run(other, method, times, flag, steps)
        return Pair(first, second, self._distances(first.states, second.states))

    def _distances(self, first: Floats, second: Floats) -> Floats:
        """‖δ‖ at each sample that both have; never less than noise."""
        count, n = min(len(first), len(second)), self.problem.degrees
        apart = (first[:count] - second[:count])[:, : 2 * n] / self.scales
        noise = NOISE * np.abs(first[:count, :n]).max(axis=1)
        return np.asarray(np.maximum(np.linalg.norm(apart, axis=1), noise))
