"""What a state says of the motion: accelerations, power, and how fast its fastest part is by linearization."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .problem import Floats, Problem

NUDGE = 1e-6
DEAD = 50.0  # what shrinks by this power of 1/e or more is not worth following


@dataclass(frozen=True)
class Spectrum:
    """Eigenvalues λ of ẏ = f(y) linearized, in 1/s: the largest |λ|, of all and of what lasts through the span."""

    size: float
    lasting: float


def spectrum(problem: Problem, time: float, state: Floats) -> Spectrum:
    """The spectrum at one state (q, q̇); zero where it cannot be had."""
    found = eigenvalues(problem, time, state[: 2 * problem.degrees])
    sizes = np.abs(found)
    lasts = -found.real * problem.t_end < DEAD
    return Spectrum(float(sizes.max()), float(np.max(sizes, where=lasts, initial=0.0)))


def eigenvalues(problem: Problem, time: float, state: Floats) -> np.ndarray:
    """Eigenvalues of ẏ = f(y) linearized at a state (q, q̇); a single zero where it has no value."""
    width = state.size
    nudges = NUDGE * np.maximum(1.0, np.abs(state)) * np.eye(width)
    rows = np.vstack([state + nudges, state - nudges])
    slopes = _slopes(problem, np.full(2 * width, time), rows)
    if not np.isfinite(slopes).all():
        return np.zeros(1, dtype=complex)
    jacobian = (slopes[:width] - slopes[width:]).T / (2.0 * nudges.diagonal())
    return np.asarray(np.linalg.eigvals(jacobian))


def _slopes(problem: Problem, times: Floats, states: Floats) -> Floats:
    return np.hstack([states[:, problem.degrees :], accelerations(problem, times, states)])


def power(problem: Problem, times: Floats, states: Floats) -> Floats:
    """P = P₀ + p₁·q̈ of all that is not in E + V: other forces, guides and explicit time dependence."""
    n = problem.degrees
    if not problem.model.layout.is_powered or not len(times):
        return np.zeros(len(times))
    table = problem.model.motion.table(problem.inputs(times, states))[:, n * (n + 1) // 2 + n :]
    return np.asarray(table[:, 0] + (table[:, 1:] * accelerations(problem, times, states)).sum(axis=1))


def accelerations(problem: Problem, times: Floats, states: Floats) -> Floats:
    """q̈ at the samples, zero where M cannot be inverted."""
    n = problem.degrees
    table = problem.model.motion.table(problem.inputs(times, states))
    lower = np.tril_indices(n)
    matrices = np.zeros((len(times), n, n))
    matrices[:, lower[0], lower[1]] = matrices[:, lower[1], lower[0]] = table[:, : len(lower[0])]
    forcing = table[:, len(lower[0]) : len(lower[0]) + n]
    sound = np.flatnonzero(np.isfinite(table).all(axis=1))
    sound = sound[np.linalg.cond(matrices[sound]) < 1e14]
    result = np.zeros((len(times), n))
    result[sound] = np.linalg.solve(matrices[sound], forcing[sound][..., None])[..., 0]
    return result
