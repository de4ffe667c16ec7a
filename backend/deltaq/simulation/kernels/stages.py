"""The stages of implicit methods: their room, and the first guesses that Newton's iteration begins with."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .compiler import inner
from .linear import Places
from .motion import Floats
from .phase import Linear


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
