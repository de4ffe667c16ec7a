"""The stages of implicit methods, by simplified Newton iteration in their velocities.

A partitioned Runge–Kutta method for p = p(q, v, t), ṗ = r(q, v, t) has the stages

    Qᵢ = q₀ + h Σ aᵢⱼ Vⱼ,   p(Qᵢ, Vᵢ) = p₀ + h Σ âᵢⱼ r(Qⱼ, Vⱼ).

The velocities Vᵢ are the unknowns, so that no mass matrix is inverted inside the iteration.
Source: Hairer, Nørsett, Wanner II, IV.8; Hairer, Lubich, Wanner, Geometric Numerical Integration, VI.6, VIII.6.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .compiler import inner
from .linear import Places, decompose, substitute
from .motion import FINE, NEWTON_FAILED, NOT_FINITE, Floats
from .phase import Linear, Phase, momenta

MOST_ITERATIONS = 50
ROUNDING = 2.3e-16


class ImplicitWeights(NamedTuple):
    """A pair of tableaus: `a`, `b`, `c` for positions, `momentum_a`, `momentum_b` for momenta.

    `product` is momentum_a · a. `error` holds γ₀ and the weights of the stages in the error estimate, if there is one.
    """

    a: Floats
    b: Floats
    c: Floats
    momentum_a: Floats
    momentum_b: Floats
    product: Floats
    error: Floats


class Start(NamedTuple):
    """Positions, velocities and momenta at the start of a step."""

    q: Floats
    v: Floats
    p: Floats


class Stages(NamedTuple):
    """Positions, velocities, momenta and their rates of all stages; the matrix of the iteration and its room;
    position and velocity in the middle of the step."""

    q: Floats
    v: Floats
    p: Floats
    r: Floats
    last_v: Floats
    matrix: Floats
    places: Places
    residual: Floats
    linear: Linear
    spare: Floats
    centre: Floats


def make_stages(stages: int, n: int) -> Stages:
    size, line, square = stages * n, np.zeros((stages, n)), np.zeros((n, n))
    q, v, p, r, last = line, line.copy(), line.copy(), line.copy(), line.copy()
    linear = Linear(square, square.copy(), square.copy(), square.copy())
    matrix, places, residual = np.zeros((size, size)), np.zeros(size, dtype=np.int64), np.zeros(size)
    return Stages(q, v, p, r, last, matrix, places, residual, linear, np.zeros((4, n)), np.zeros((2, n)))


@inner
def assemble(weights: ImplicitWeights, h: float, stages: Stages) -> bool:
    """The matrix of the iteration, δᵢⱼM + h aᵢⱼA − h âᵢⱼD − h²(âa)ᵢⱼK, decomposed; False if it is singular."""
    count, n = stages.q.shape
    m = stages.linear
    for i in range(count):
        for j in range(count):
            a, b, c = h * weights.a[i, j], h * weights.momentum_a[i, j], h * h * weights.product[i, j]
            for k in range(n):
                for d in range(n):
                    entry = a * m.shift[k, d] - b * m.damping[k, d] - c * m.stiffness[k, d]
                    stages.matrix[i * n + k, j * n + d] = entry + (m.mass[k, d] if i == j else 0.0)
    return decompose(stages.matrix, stages.places)


@inner
def share_before(c: Floats, x: float, j: int) -> float:
    """The Lagrange polynomial of the last step's node c[j] − 1 among those before its end, and the end, at x."""
    place = c[j] - 1.0
    part = x / place
    for k in range(c.size):
        other = c[k] - 1.0
        if k != j and other < 0.0:
            part *= (x - other) / (place - other)
    return float(part)


@inner
def predict(weights: ImplicitWeights, ratio: float, v: Floats, stages: Stages) -> None:
    """First guesses of V: the polynomial through v at the start and the stages of the last step, carried on.

    `ratio` is this step over the last one; 0 means that there was none.
    """
    count, n = stages.q.shape
    for i in range(count):
        for d in range(n):
            stages.last_v[i, d] = stages.v[i, d]
            stages.v[i, d] = v[d]
    for i in range(count):
        x = weights.c[i] * ratio  # in units of the last step, from its end
        for j in range(count):
            if x > 0.0 and weights.c[j] < 1.0:
                part = share_before(weights.c, x, j)
                for d in range(n):
                    stages.v[i, d] += part * (stages.last_v[j, d] - v[d])


@inner
def middle(weights: ImplicitWeights, h: float, q: Floats, stages: Stages) -> None:
    """The middle of the step by the first guesses, position and velocity, where derivatives serve all stages."""
    for d in range(q.size):
        rate = 0.0
        for i in range(weights.b.size):
            rate += weights.b[i] * stages.v[i, d]
        stages.centre[0, d] = q[d] + 0.5 * h * rate
        stages.centre[1, d] = rate


@inner
def evaluate(phase: Phase, weights: ImplicitWeights, t: float, h: float, q: Floats, stages: Stages) -> None:
    """Qᵢ, p and r of every stage for the present Vᵢ."""
    count, n = stages.q.shape
    for i in range(count):
        for d in range(n):
            change = 0.0
            for j in range(count):
                change += weights.a[i, j] * stages.v[j, d]
            stages.q[i, d] = q[d] + h * change
        momenta(phase, t + weights.c[i] * h, stages.q[i], stages.v[i], stages.p[i], stages.r[i])


@inner
def correct(weights: ImplicitWeights, h: float, p: Floats, stages: Stages) -> float:
    """One Newton correction of all Vᵢ; returns its largest component."""
    count, n = stages.q.shape
    for i in range(count):
        for d in range(n):
            change = 0.0
            for j in range(count):
                change += weights.momentum_a[i, j] * stages.r[j, d]
            stages.residual[i * n + d] = p[d] - stages.p[i, d] + h * change
    substitute(stages.matrix, stages.places, stages.residual)
    largest = 0.0
    for i in range(count):
        for d in range(n):
            size = abs(stages.residual[i * n + d])
            largest = size if not size <= largest else largest
            stages.v[i, d] += stages.residual[i * n + d]
    return largest


@inner
def floor_of(h: float, q: Floats, v: Floats, stages: Stages) -> tuple[float, float]:
    """The largest velocity, and what the rounding of positions makes of it over a step."""
    count, n = stages.q.shape
    speed, size = 1e-300, 0.0
    for d in range(n):
        speed, size = max(speed, abs(v[d])), max(size, abs(q[d]))
    for i in range(count):
        for d in range(n):
            speed, size = max(speed, abs(stages.v[i, d])), max(size, abs(stages.q[i, d]))
    return speed, ROUNDING * size / h


@inner
def newton(
    phase: Phase, weights: ImplicitWeights, t: float, h: float, tolerance: float, start: Start, stages: Stages
) -> tuple[int, int, float]:
    """Iterates until corrections are rounding errors, or (tolerance > 0) change positions by less than that.

    Returns how it went, the number of iterations and the first ratio of two corrections.
    """
    before, ratio, slowness = np.inf, 0.0, 0.0
    for iteration in range(1, MOST_ITERATIONS + 1):
        evaluate(phase, weights, t, h, start.q, stages)
        correction = correct(weights, h, start.p, stages)
        if not correction < np.inf:
            return NOT_FINITE, iteration, np.inf
        speed, grain = floor_of(h, start.q, start.v, stages)
        ratio = correction / before if iteration > 1 else 0.0
        slowness = ratio if iteration == 2 else slowness
        left = correction * (ratio / (1.0 - ratio) if 0.0 < ratio < 1.0 else 1.0)
        is_grain = ratio > 0.3 and correction <= 1e-11 * speed + 64.0 * grain
        if correction <= ROUNDING * speed or left <= 0.1 * ROUNDING * speed or is_grain:
            return FINE, iteration, slowness
        if iteration > 1 and left * max(1.0, h) <= tolerance:
            return FINE, iteration, slowness
        if iteration > 3 and ratio >= 1.0:
            return NEWTON_FAILED, iteration, ratio
        before = correction
    return NEWTON_FAILED, MOST_ITERATIONS, ratio
