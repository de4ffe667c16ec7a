"""The stages of implicit methods: their workspace, and the first guesses that Newton's iteration begins with."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .compiler import inline
from .linear import Indices
from .motion import Floats
from .phase import Linear


class ImplicitWeights(NamedTuple):
    """A pair of tableaus with s stages: `a`, `b`, `c` for positions, `momentum_a`, `momentum_b` for momenta.

    `a`, `momentum_a` and `product`, which is momentum_a · a, have shape (s, s); `b`, `c` and `momentum_b` shape (s,).
    `error`, shape (1 + s,) or (0,), holds γ₀ and the weights of the stages in the error estimate, if there is one.
    """

    a: Floats
    b: Floats
    c: Floats
    momentum_a: Floats
    momentum_b: Floats
    product: Floats
    error: Floats


class Start(NamedTuple):
    """`q`, `v` and `p` are positions, velocities and momenta at the start of a step: shape (n,) each."""

    q: Floats
    v: Floats
    p: Floats


class Stages(NamedTuple):
    """The s stages of a step, and the arrays of their iteration.

    `q`, `v`, `p` and `r` are positions, velocities, momenta and their rates, `last_v` the velocities of the step
    before, `carried` what these become when they are carried on: shape (s, n). `missed`, shape (2, s, n), is how far
    that was off in the steps before, the latest first, of which so many, shape (1,), are `remembered`; −1 if the last
    step was not as long as the one before. `matrix`, shape (s n, s n), `pivots` and `residual`, shape (s n,), are the
    linear system of the iteration, and `influence`, shape (1,), what a change of rates makes of ṗ in a step, as a part
    of the momenta; `spare` has shape (4, n). `centre`, shape (2, n), is position and velocity in the
    middle of the step.
    """

    q: Floats
    v: Floats
    p: Floats
    r: Floats
    last_v: Floats
    carried: Floats
    missed: Floats
    remembered: Indices
    matrix: Floats
    pivots: Indices
    residual: Floats
    linear: Linear
    influence: Floats
    spare: Floats
    centre: Floats


def make_stages(stages: int, n: int) -> Stages:
    """The workspace of so many stages for n coordinates."""
    size, line, square = stages * n, np.zeros((stages, n)), np.zeros((n, n))
    q, v, p, r, last, carried = line, line.copy(), line.copy(), line.copy(), line.copy(), line.copy()
    missed, remembered = np.zeros((2, stages, n)), np.full(1, -1)
    linear = Linear(square, square.copy(), square.copy(), square.copy())
    matrix, pivots, residual = np.zeros((size, size)), np.zeros(size, dtype=np.int64), np.zeros(size)
    influence, spare, centre = np.zeros(1), np.zeros((4, n)), np.zeros((2, n))
    return Stages(
        q, v, p, r, last, carried, missed, remembered, matrix, pivots, residual, linear, influence, spare, centre
    )


@inline
def lagrange_basis_before(c: Floats, x: float, j: int) -> float:
    """The value at x of the Lagrange basis polynomial of the last step's node c[j] − 1.

    x is in units of that step, from its end. The nodes are those before the end, and the end; `c` has shape (s,).
    """
    place = c[j] - 1.0
    part = x / place
    for k in range(c.size):
        other = c[k] - 1.0
        if k != j and other < 0.0:
            part *= (x - other) / (place - other)
    return float(part)


@inline
def carry_on(weights: ImplicitWeights, ratio: float, v: Floats, stages: Stages) -> None:
    """The polynomial through v at the start and the stages of the last step, carried on, into `carried`.

    `v` has shape (n,); `ratio` as `predict` has it.
    """
    count, n = stages.q.shape
    for i in range(count):
        x = weights.c[i] * ratio  # in units of the last step, from its end
        for d in range(n):
            stages.carried[i, d] = v[d]
        for j in range(count):
            if x > 0.0 and weights.c[j] < 1.0:
                part = lagrange_basis_before(weights.c, x, j)
                for d in range(n):
                    stages.carried[i, d] += part * (stages.last_v[j, d] - v[d])


@inline
def predict(weights: ImplicitWeights, ratio: float, is_fixed: int, v: Floats, stages: Stages) -> None:
    """First guesses of V: the polynomial of the last step carried on, and by how much that was off before.

    That is known where steps are fixed (1), and carried on itself by a straight line where it changes little; a
    tolerance is met by two corrections anyway. `v`, shape (n,), are the rates at the start. `ratio` is this step over
    the last one; 0 means that there was none.
    """
    count, n = stages.q.shape
    known = min(stages.remembered[0] + 1, 2) if ratio == 1.0 and is_fixed != 0 else -1
    size, change = 0.0, 0.0
    for i in range(count):
        for d in range(n):
            before, missed = stages.missed[0, i, d], stages.v[i, d] - stages.carried[i, d]
            stages.last_v[i, d], stages.missed[1, i, d], stages.missed[0, i, d] = stages.v[i, d], before, missed
            size, change = max(size, abs(missed)), max(change, abs(missed - before))
    carry_on(weights, ratio, v, stages)
    is_smooth = known == 2 and change <= 0.5 * size
    for i in range(count):
        for d in range(n):
            more = 2.0 * stages.missed[0, i, d] - stages.missed[1, i, d] if is_smooth else 0.0
            stages.v[i, d] = stages.carried[i, d] + more
    stages.remembered[0] = known


@inline
def midpoint(weights: ImplicitWeights, h: float, q: Floats, stages: Stages) -> None:
    """Position and velocity in the middle of the step by the first guesses, where derivatives serve all stages.

    `q`, shape (n,), is the position at the start.
    """
    for d in range(q.size):
        rate = 0.0
        for i in range(weights.b.size):
            rate += weights.b[i] * stages.v[i, d]
        stages.centre[0, d] = q[d] + 0.5 * h * rate
        stages.centre[1, d] = rate
