"""Linear propagation: how small deviations are carried along a motion, D(t) = ∂y(t)/∂(y(0), p) with y = (q, q̇).

Ḋ = J D + B, J = ∂f/∂y and B = ∂f/∂p along the motion, D(0) = (1, 0). So a covariance P₀ of the start becomes D P₀ Dᵀ.
The steps are those of Gauss with three stages, of order 6, which no stiffness makes unstable; so many that twice as
many say the same. Where forces may jump, D jumps with them in a way that J does not tell: there neighbours are run.
Source: Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, I.14; Hairer, Wanner, …II, IV.5.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..simulation.derivatives import derivatives
from ..simulation.ensemble import Ensemble, run_ensemble
from ..simulation.library import get_method
from ..simulation.problem import Floats, Problem
from ..simulation.run import run
from .orbits import steps_of

NUDGE = 1e-6  # of the size of a component, in difference quotients
TURN = 0.5  # of the fastest part in a step, at first
MOST_STEPS = 16_384
TOGETHER = 256  # steps
AGREE, KNOWN = 1e-7, 1e-3  # difference of D by so many and by twice as many steps: to stop, and to be shown
LARGEST = 1e100
NEAR, LEAST, ACCURATE = 1e-3, 1e-7, 1e-12  # neighbours: over the tolerance, over the values; error of their motions

_ROOT = math.sqrt(15.0)
C = np.array([0.5 - _ROOT / 10.0, 0.5, 0.5 + _ROOT / 10.0])
A = np.array(
    [
        [5.0 / 36.0, 2.0 / 9.0 - _ROOT / 15.0, 5.0 / 36.0 - _ROOT / 30.0],
        [5.0 / 36.0 + _ROOT / 24.0, 2.0 / 9.0, 5.0 / 36.0 - _ROOT / 24.0],
        [5.0 / 36.0 + _ROOT / 30.0, 2.0 / 9.0 + _ROOT / 15.0, 5.0 / 36.0],
    ]
)
WEIGHTS = np.array([5.0, 8.0, 5.0]) / 18.0


@dataclass(frozen=True)
class Propagation:
    """A motion and its derivatives at `times`, shape (samples,), as far as both are known.

    `states` (q, q̇) has shape (samples, 2n), `matrices` (samples, 2n, 2n + parameters): NaN where not known.
    """

    times: Floats
    states: Floats
    matrices: Floats

    def carried(self, deviations: Floats, row: int) -> Floats:
        """What deviations of (y(0), p) become in one component, shape (count, samples).

        `deviations` has shape (count, 2n + parameters).
        """
        return np.asarray(deviations @ self.matrices[:, row].T)

    def variances(self, sigmas: Floats, row: int) -> Floats:
        """What each quantity adds to the variance of one component: shape (samples, 2n + parameters).

        `sigmas`, shape (2n + parameters,), are the standard deviations of the quantities.
        """
        return np.asarray((self.matrices[:, row] * sigmas) ** 2)


def propagated(problem: Problem, samples: int, parameters: Sequence[int], sizes: Floats) -> Propagation:
    """D at evenly spread times, by initial values and by the parameters at these places.

    `sizes`, shape (2n + parameters,), are deviations that are to be carried: nothing smaller needs to be resolved.
    """
    if problem.model.recurrences.conditions:
        return _by_neighbours(replace(problem, samples=samples), tuple(parameters), sizes)
    linear = _Linear(problem, samples, tuple(parameters), sizes)
    parts = linear.parts()
    coarse = linear.solved(parts)
    while True:
        fine = linear.solved(2 * parts)
        apart = _apart(coarse.matrices, fine.matrices)
        parts *= 2
        if not (apart > AGREE).any() or 2 * parts * (samples - 1) > MOST_STEPS:
            break
        coarse = fine
    known = (apart <= KNOWN).cumprod(axis=0, dtype=bool)[: len(fine.times), None, None]
    return replace(fine, matrices=np.where(known, fine.matrices, np.nan))


def _by_neighbours(problem: Problem, parameters: tuple[int, ...], sizes: Floats) -> Propagation:
    """D by central differences of motions a little apart; a quantity of size 0 has no neighbours, its column is 0."""
    n, start = problem.degrees, np.array([*problem.values, *problem.rates, *problem.parameters])
    places = np.concatenate([np.arange(2 * n), 2 * n + np.array(parameters, dtype=np.int64)])
    nudges = np.where(sizes > 0.0, np.maximum(NEAR * sizes, LEAST * np.abs(start[places])), 0.0)
    steps = np.zeros((len(places), len(start)))
    steps[np.arange(len(places)), places] = nudges
    rows = np.vstack([start, start + steps, start - steps])
    found = run_ensemble(Ensemble(problem, rows[:, : 2 * n].copy(), rows[:, 2 * n :].copy()), ACCURATE)
    states = np.concatenate([found.values, found.rates], axis=2)
    ahead, behind = states[1 : 1 + len(places)], states[1 + len(places) :]
    widths = np.where(nudges > 0.0, 2.0 * nudges, 1.0)[:, None, None]
    known = int(np.isfinite(states[0]).all(axis=1).cumprod().sum())
    matrices = np.moveaxis((ahead - behind) / widths, 0, 2)
    return Propagation(found.times[:known], states[0, :known], matrices[:known])


def _apart(coarse: Floats, fine: Floats) -> Floats:
    """How far two D are from each other in any column, over what it has been at most so far; 1 where one is missing."""
    count = min(len(coarse), len(fine))
    found = np.ones(len(fine))
    with np.errstate(invalid="ignore", over="ignore"):
        rows = np.maximum.accumulate(np.abs(fine[:count]).max(axis=2, keepdims=True), axis=0)
        change = np.abs(coarse[:count] - fine[:count]) / np.maximum(rows, 1e-300)
    found[:count] = np.nan_to_num(change.max(axis=(1, 2)), nan=1.0)
    return found


@dataclass(frozen=True)
class _Linear:
    """What is integrated: a motion with its deviations by initial values and by some parameters."""

    problem: Problem
    samples: int
    parameters: tuple[int, ...]
    sizes: Floats

    @property
    def width(self) -> int:
        """Of (q, q̇)."""
        return 2 * self.problem.degrees

    def parts(self) -> int:
        """Steps between two samples that follow the fastest part."""
        times = np.linspace(0.0, self.problem.t_end, self.samples)
        states = self._states(times)
        jacobians = self._slopes(times[: len(states)], states)[:, :, : self.width]
        good = np.isfinite(jacobians).all(axis=(1, 2))
        fastest = float(np.abs(np.linalg.eigvals(jacobians[good])).max(initial=0.0))
        wanted = math.ceil(min(fastest * times[1] / TURN, 1e9))
        return int(max(1, min(wanted, MOST_STEPS // (2 * (self.samples - 1)))))

    def solved(self, parts: int) -> Propagation:
        """The motion and D by so many steps between two samples."""
        count = parts * (self.samples - 1)
        h = self.problem.t_end / count
        starts = h * np.arange(count)
        times = np.concatenate([[0.0], np.column_stack([starts[:, None] + h * C, starts + h]).ravel()])
        times[-1] = self.problem.t_end
        states = self._states(times)
        done = (len(states) - 1) // (len(C) + 1) // parts * parts
        nodes = np.arange(len(times))[1:].reshape(count, len(C) + 1)[:done, :-1]
        matrices = [np.eye(self.width + len(self.parameters))]
        for first in range(0, done, TOGETHER):
            some = nodes[first : first + TOGETHER]
            for step in self._steps(times[some], states[some], h):
                with np.errstate(over="ignore", invalid="ignore"):
                    matrices.append(step @ matrices[-1])
        found = np.array(matrices[::parts])[:, : self.width]
        found[~(np.abs(found) < LARGEST).all(axis=(1, 2)).cumprod().astype(bool)] = np.nan
        return Propagation(times[:: 4 * parts][: len(found)], states[:: 4 * parts][: len(found)], found)

    def _states(self, times: Floats) -> Floats:
        """(q, q̇) at these times, as far as the motion goes."""
        steps = steps_of(self.problem, is_driven=True)
        found = run(self.problem, get_method("taylor"), times, np.zeros(1, dtype=np.int64), steps)
        return found.states[:, : self.width]

    def _steps(self, times: Floats, states: Floats, h: float) -> Floats:
        """The matrices of steps by the motion at their nodes, shapes (steps, 3) and (steps, 3, 2n)."""
        count, stages = times.shape
        whole = self.width + len(self.parameters)
        laws = np.zeros((count, stages, whole, whole))
        laws[:, :, : self.width] = self._slopes(times.ravel(), states.reshape(-1, self.width)).reshape(
            count, stages, self.width, whole
        )
        left = -h * laws[:, :, :, None, :] * A[None, :, None, :, None]
        left = left.reshape(count, stages * whole, stages * whole) + np.eye(stages * whole)
        slopes = np.linalg.solve(left, laws.reshape(count, stages * whole, whole)).reshape(laws.shape)
        return np.asarray(np.eye(whole) + h * np.einsum("i,kiab->kab", WEIGHTS, slopes))

    def _slopes(self, times: Floats, states: Floats) -> Floats:
        """(J, B) at states, shape (states, 2n, 2n + parameters), by central differences."""
        nudges = NUDGE * np.maximum(np.abs(states).max(axis=0), self.sizes[: self.width])
        found = np.zeros((len(times), self.width, self.width + len(self.parameters)))
        for place in range(self.width):
            step = np.where(np.arange(self.width) == place, nudges[place], 0.0)
            found[:, :, place] = self._quotient(self.problem, self.problem, times, states + step, states - step)
            found[:, :, place] /= 2.0 * nudges[place]
        for number, place in enumerate(self.parameters):
            value = self.problem.parameters[place]
            nudge = NUDGE * max(abs(value), float(self.sizes[self.width + number]))
            ahead, behind = (_changed(self.problem, place, value + sign * nudge) for sign in (1.0, -1.0))
            change = self._quotient(ahead, behind, times, states, states)
            found[:, :, self.width + number] = change / (2.0 * nudge)
        return np.nan_to_num(found, posinf=0.0, neginf=0.0)

    def _quotient(self, ahead: Problem, behind: Problem, times: Floats, up: Floats, down: Floats) -> Floats:
        found = derivatives(ahead, times, up) - derivatives(behind, times, down)
        return np.asarray(found[:, : self.width])


def _changed(problem: Problem, place: int, value: float) -> Problem:
    """The problem with another value of one parameter."""
    values = list(problem.parameters)
    values[place] = value
    return replace(problem, parameters=tuple(values))
