"""Linear propagation: how small deviations are carried along a motion, D(t) = ∂y(t)/∂(y(0), p) with y = (q, q̇).

Ḋ = J D + B, J = ∂f/∂y and B = ∂f/∂p along the motion, D(0) = (1, 0). So a covariance P₀ of the start becomes D P₀ Dᵀ.
The steps are those of Gauss with three stages, of order 6, which no stiffness makes unstable: parts of those that the
motion itself takes, so that they pass over nothing either, and so many that twice as many say the same. Where forces
may jump, D jumps with them in a way that J does not tell: there neighbours are run.
Source: Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, I.14; Hairer, Wanner, …II, IV.5.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ..simulation.derivatives import derivatives
from ..simulation.ensemble import Ensemble, run_ensemble
from ..simulation.march import Integers
from ..simulation.problem import Floats, Problem
from .nominal import NominalMotion

NUDGE = 1e-6  # of how far a component goes, in difference quotients
LEAST, CARRIED = 2e-10, 1e-4  # of the size of a component, and of the deviation that is to be carried
TURN = 0.5  # of the fastest part in a step, at first
MOST_STEPS = 16_384
TOGETHER = 256  # steps
AGREE, KNOWN = 1e-7, 1e-3  # difference of D by so many and by twice as many steps: to stop, and to be shown
LARGEST = 1e100
NEAR, APART, ACCURATE = 1e-3, 1e-7, 1e-12  # neighbours: over the tolerance, over the values; error of their motions

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
    width = 2 * problem.degrees
    linear = _Linear(NominalMotion.of(problem, samples, sizes[:width], MOST_STEPS // 2), tuple(parameters), sizes)
    parts = linear.parts()
    coarse = linear.solved(parts)
    while True:
        parts = 2 * parts
        fine = linear.solved(parts)
        apart = _apart(coarse.matrices, fine.matrices)
        if not (apart > AGREE).any() or 2 * parts.sum() > MOST_STEPS:
            break
        coarse = fine
    known = (apart <= KNOWN).cumprod(axis=0, dtype=bool)[: len(fine.times), None, None]
    return replace(fine, matrices=np.where(known, fine.matrices, np.nan))


def _by_neighbours(problem: Problem, parameters: tuple[int, ...], sizes: Floats) -> Propagation:
    """D by central differences of motions a little apart; a quantity of size 0 has no neighbours, its column is 0."""
    n, start = problem.degrees, np.array([*problem.values, *problem.rates, *problem.parameters])
    places = np.concatenate([np.arange(2 * n), 2 * n + np.array(parameters, dtype=np.int64)])
    nudges = np.where(sizes > 0.0, np.maximum(NEAR * sizes, APART * np.abs(start[places])), 0.0)
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
    """What is integrated: the deviations of a motion by initial values and by some parameters."""

    motion: NominalMotion
    parameters: tuple[int, ...]
    sizes: Floats

    @property
    def width(self) -> int:
        """Of (q, q̇)."""
        return 2 * self.motion.problem.degrees

    def parts(self) -> Integers:
        """Steps in each interval of the motion that follow the fastest part there: shape (intervals,)."""
        motion = self.motion
        jacobians = self._slopes(motion.grid[: len(motion.states)], motion.states)[:, :, : self.width]
        good = np.flatnonzero(np.isfinite(jacobians).all(axis=(1, 2)))
        fastest = np.zeros(len(motion.grid))
        fastest[good] = np.abs(np.linalg.eigvals(jacobians[good])).max(axis=1)
        wanted = np.diff(motion.grid) * np.maximum(fastest[:-1], fastest[1:]) / TURN
        room = MOST_STEPS // 2 / max(float(np.ceil(wanted).sum()), 1.0)
        return np.asarray(np.maximum(np.ceil(min(room, 1.0) * wanted), 1.0), dtype=np.int64)

    def solved(self, parts: Integers) -> Propagation:
        """D at the samples, by so many steps in each interval of the motion, shape (intervals,)."""
        motion, places = self.motion, self.motion.places
        h = np.repeat(np.diff(motion.grid) / parts, parts)
        begun = np.concatenate([[0], np.cumsum(parts)])  # steps before each interval
        starts = np.repeat(motion.grid[:-1], parts) + h * (np.arange(len(h)) - np.repeat(begun[:-1], parts))
        times = np.concatenate([[0.0], np.column_stack([starts[:, None] + h[:, None] * C, starts + h]).ravel()])
        times[(len(C) + 1) * begun] = motion.grid
        states = motion.at(times)
        done = (len(states) - 1) // (len(C) + 1)
        nodes = np.arange(len(times))[1:].reshape(len(h), len(C) + 1)[:done, :-1]
        matrices = [np.eye(self.width + len(self.parameters))]
        for first in range(0, done, TOGETHER):
            some = slice(first, first + TOGETHER)
            for step in self._steps(times[nodes[some]], states[nodes[some]], h[:done][some]):
                with np.errstate(over="ignore", invalid="ignore"):
                    matrices.append(step @ matrices[-1])
        at = begun[places]
        at = at[at <= done]
        found = np.array(matrices)[at, : self.width]
        found[~(np.abs(found) < LARGEST).all(axis=(1, 2)).cumprod().astype(bool)] = np.nan
        return Propagation(times[(len(C) + 1) * at], states[(len(C) + 1) * at], found)

    def _steps(self, times: Floats, states: Floats, h: Floats) -> Floats:
        """The matrices of steps of lengths h by the motion at their nodes, shapes (steps, 3) and (steps, 3, 2n)."""
        count, stages = times.shape
        whole = self.width + len(self.parameters)
        laws = np.zeros((count, stages, whole, whole))
        laws[:, :, : self.width] = self._slopes(times.ravel(), states.reshape(-1, self.width)).reshape(
            count, stages, self.width, whole
        )
        left = -h[:, None, None, None, None] * laws[:, :, :, None, :] * A[None, :, None, :, None]
        left = left.reshape(count, stages * whole, stages * whole) + np.eye(stages * whole)
        slopes = np.linalg.solve(left, laws.reshape(count, stages * whole, whole)).reshape(laws.shape)
        return np.asarray(np.eye(whole) + h[:, None, None] * np.einsum("i,kiab->kab", WEIGHTS, slopes))

    def _slopes(self, times: Floats, states: Floats) -> Floats:
        """(J, B) at states, shape (states, 2n, 2n + parameters), by central differences."""
        problem, steps = self.motion.problem, self._nudges
        found = np.zeros((len(times), self.width, len(steps)))
        for place in range(self.width):
            step = np.where(np.arange(self.width) == place, steps[place], 0.0)
            up, down = states + step, states - step
            found[:, :, place] = self._quotient(problem, problem, times, up, down)
            found[:, :, place] /= (up - down)[:, [place]]
        for number, place in enumerate(self.parameters, self.width):
            ahead, behind = (_changed(problem, place, sign * steps[number]) for sign in (1.0, -1.0))
            change = self._quotient(ahead, behind, times, states, states)
            found[:, :, number] = change / (ahead.parameters[place] - behind.parameters[place])
        return np.nan_to_num(found, posinf=0.0, neginf=0.0)

    @cached_property
    def _nudges(self) -> Floats:
        """How far neighbours are away from the motion, in each component and parameter: shape (2n + parameters,).

        It is a part of how far they go, the smaller the shorter the steps that the motion takes somewhere: forces
        change there over as short a way. No less than what rounding needs, and what is to be carried.
        """
        motion = self.motion
        values = np.array(motion.problem.parameters)[list(self.parameters)]
        ways = np.concatenate([motion.scales, np.abs(values)])
        sizes = np.concatenate([np.abs(motion.states).max(axis=0), np.abs(values)])
        return np.maximum(np.maximum(NUDGE * motion.finest * ways, LEAST * sizes), CARRIED * self.sizes)

    def _quotient(self, ahead: Problem, behind: Problem, times: Floats, up: Floats, down: Floats) -> Floats:
        found = derivatives(ahead, times, up) - derivatives(behind, times, down)
        return np.asarray(found[:, : self.width])


def _changed(problem: Problem, place: int, change: float) -> Problem:
    """The problem with another value of one parameter."""
    values = list(problem.parameters)
    values[place] += change
    return replace(problem, parameters=tuple(values))
