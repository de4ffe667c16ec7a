"""How fast the fastest part of a motion is, by linearization, and how fast what drives it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .derivatives import derivatives
from .problem import Floats, Problem

NUDGE = 1e-6
SMALLEST = 1e-7  # of a place: where all are smaller, they say nothing of how far a motion goes
NOISE = 1e-9  # of a force; what changes less with time is rounding
PLACES, GOLDEN = 64, 0.6180339887498949
DEAD = 50.0  # what shrinks by this power of 1/e or more is not worth following


@dataclass(frozen=True)
class Spectrum:
    """Eigenvalues λ of ẏ = f(y) linearized, in 1/s: the largest |λ|, of all and of what lasts through the span."""

    size: float
    lasting: float


def spectrum(problem: Problem, time: float, state: Floats) -> Spectrum:
    """The spectrum at one state (q, q̇, …), shape (≥ 2n,); zero where it cannot be had."""
    return spectra(problem, np.array([time]), state[None, :])[0]


def spectra(problem: Problem, times: Floats, states: Floats) -> list[Spectrum]:
    """The spectra at several states: `times` has shape (states,), `states` shape (states, ≥ 2n)."""
    matrices = jacobians(problem, times, states[:, : 2 * problem.degrees])
    known = np.isfinite(matrices).all(axis=(1, 2))
    found = np.zeros(matrices.shape[:2], dtype=complex)
    found[known] = np.linalg.eigvals(matrices[known])
    sizes, lasts = np.abs(found), -found.real * problem.t_end < DEAD
    lasting = np.max(sizes, axis=1, where=lasts, initial=0.0)
    return [Spectrum(float(size), float(slow)) for size, slow in zip(sizes.max(axis=1), lasting, strict=True)]


def eigenvalues(problem: Problem, time: float, state: Floats) -> np.ndarray:
    """Eigenvalues, shape (2n,), of ẏ = f(y) linearized at a state (q, q̇); a single zero where it has no value."""
    (jacobian,) = jacobians(problem, np.array([time]), state[None, :])
    return np.asarray(np.linalg.eigvals(jacobian)) if np.isfinite(jacobian).all() else np.zeros(1, dtype=complex)


def _sizes(problem: Problem, states: Floats) -> Floats:
    """How much of each component is much: that of angles is a radian, and that of places by where the motion is.

    A scene in micrometres has the eigenvalues that it has in metres. Where a coordinate is at zero, the others tell;
    rates count by these, and by the span. `states` has shape (states, 2n); returns shape (2n,).
    """
    n = problem.degrees
    is_angle = np.array(problem.angular or (False,) * n)
    place, rate = (float(np.abs(part[:, ~is_angle]).max(initial=0.0)) for part in (states[:, :n], states[:, n:]))
    far = next((each for each in (place, rate * problem.t_end) if each > SMALLEST), 1.0)
    places, per_span = np.where(is_angle, 1.0, far), 1.0 / problem.t_end
    turning = float(np.abs(states[:, n:][:, is_angle]).max(initial=0.0))
    return np.concatenate([places, np.maximum(np.where(is_angle, turning, rate), places * per_span)])


def drive(problem: Problem, state: Floats) -> float:
    """How fast the forces change that time alone changes, in 1/s: ω² = ⟨(∂f/∂t)²⟩ / ⟨(f − ⟨f⟩)²⟩ at one state.

    `state` has shape (≥ 2n,). For a sine of any amplitude this is its angular frequency. Times within the span are
    taken in unlike distances.
    """
    times = problem.t_end * np.modf(GOLDEN * np.arange(1, PLACES + 1))[0]
    later = times + NUDGE * problem.t_end
    rows = np.tile(state[: 2 * problem.degrees], (2 * PLACES, 1))
    now, then = np.split(derivatives(problem, np.concatenate([times, later]), rows), 2)
    swing = float(np.var(now, axis=0).sum())
    rate = float((((then - now) / (later - times)[:, None]) ** 2).mean(axis=0).sum())
    is_driven = swing > NOISE**2 * float((now**2).sum())
    return float(np.sqrt(rate / swing)) if is_driven else 0.0


def jacobians(problem: Problem, times: Floats, states: Floats) -> Floats:
    """∂f/∂y of the right-hand side at each state, by central differences.

    `times` has shape (states,), `states` shape (states, 2n); returns shape (states, 2n, 2n).
    """
    count, width = states.shape
    nudges = NUDGE * np.maximum(_sizes(problem, states), np.abs(states))
    steps = nudges[:, :, None] * np.eye(width)
    rows = np.concatenate([states[:, None, :] + steps, states[:, None, :] - steps]).reshape(-1, width)
    ahead, behind = derivatives(problem, np.tile(np.repeat(times, width), 2), rows)[:, :width].reshape(
        2, count, width, width
    )
    return np.asarray((ahead - behind).transpose(0, 2, 1) / (2.0 * nudges[:, None, :]))
