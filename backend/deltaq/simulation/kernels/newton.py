"""The stages of implicit methods, by simplified Newton iteration in their velocities.

A partitioned Runge–Kutta method for p = p(q, v, t), ṗ = r(q, v, t) has the stages

    Qᵢ = q₀ + h Σ aᵢⱼ Vⱼ,   p(Qᵢ, Vᵢ) = p₀ + h Σ âᵢⱼ r(Qⱼ, Vⱼ).

The velocities Vᵢ are the unknowns, so that no mass matrix is inverted inside the iteration.
Source: Hairer, Nørsett, Wanner II, IV.8; Hairer, Lubich, Wanner, Geometric Numerical Integration, VI.6, VIII.6.
"""

from __future__ import annotations

import numpy as np

from .compiler import inline
from .kicked import Kicked, correct_kicked
from .kicks import Kicks, kick
from .linear import decompose, substitute
from .motion import FINE, NEWTON_FAILED, NOT_FINITE, ROUNDING, Floats, Motion
from .phase import Phase, momenta
from .stages import ImplicitWeights, Stages, Start

MOST_ITERATIONS = 50
GO_ON = -1  # no outcome: there is one more correction to be made
SLOW = 0.002  # a ratio of corrections above which the derivatives are taken anew


@inline
def influence(h: float, n: int, stages: Stages) -> float:
    """The largest part of the momenta that a change of all rates by one part of theirs makes of ṗ in a step."""
    largest, m = 0.0, stages.linear
    for k in range(n):
        total = 0.0
        for d in range(n):
            total += h * (abs(m.damping[k, d]) + h * abs(m.stiffness[k, d]))
        size = total / abs(m.mass[k, k]) if total > 0.0 else 0.0
        largest = size if not size <= largest else largest
    return largest


@inline
def assemble(weights: ImplicitWeights, h: float, stages: Stages) -> bool:
    """The matrix of the iteration, δᵢⱼM + h aᵢⱼA − h âᵢⱼD − h²(âa)ᵢⱼK, decomposed; False if it is singular."""
    count, n = stages.q.shape
    stages.influence[0] = influence(h, n, stages)
    m = stages.linear
    for i in range(count):
        for j in range(count):
            a, b, c = h * weights.a[i, j], h * weights.momentum_a[i, j], h * h * weights.product[i, j]
            for k in range(n):
                for d in range(n):
                    entry = a * m.shift[k, d] - b * m.damping[k, d] - c * m.stiffness[k, d]
                    stages.matrix[i * n + k, j * n + d] = entry + (m.mass[k, d] if i == j else 0.0)
    return decompose(stages.matrix, stages.pivots)


@inline
def evaluate(phase: Phase, weights: ImplicitWeights, t: float, h: float, q: Floats, stages: Stages) -> None:
    """Qᵢ, p and r of every stage for the present Vᵢ; `q`, shape (n,), is the position at the start of the step."""
    count, n = stages.q.shape
    for i in range(count):
        for d in range(n):
            change = 0.0
            for j in range(count):
                change += weights.a[i, j] * stages.v[j, d]
            stages.q[i, d] = q[d] + h * change
        momenta(phase, t + weights.c[i] * h, stages.q[i], stages.v[i], stages.p[i], stages.r[i])


@inline
def correct(weights: ImplicitWeights, h: float, p: Floats, stages: Stages) -> None:
    """Newton's correction of all Vᵢ, into `residual`; `p`, shape (n,), are the momenta at the start."""
    count, n = stages.q.shape
    for i in range(count):
        for d in range(n):
            change = 0.0
            for j in range(count):
                change += weights.momentum_a[i, j] * stages.r[j, d]
            stages.residual[i * n + d] = p[d] - stages.p[i, d] + h * change
    substitute(stages.matrix, stages.pivots, stages.residual)


@inline
def take(stages: Stages) -> float:
    """All Vᵢ corrected; returns the largest component of what corrects them."""
    count, n = stages.q.shape
    largest = 0.0
    for i in range(count):
        for d in range(n):
            size = abs(stages.residual[i * n + d])
            largest = size if not size <= largest else largest
            stages.v[i, d] += stages.residual[i * n + d]
    return largest


@inline
def follow(weights: ImplicitWeights, h: float, stages: Stages) -> None:
    """Qᵢ, p and r of every stage, evaluated before the last correction of Vᵢ, changed by it: to first order."""
    count, n = stages.q.shape
    m, change = stages.linear, stages.spare[0]
    for i in range(count):
        for d in range(n):
            total = 0.0
            for j in range(count):
                total += weights.a[i, j] * stages.residual[j * n + d]
            change[d] = h * total
            stages.q[i, d] += change[d]
        for k in range(n):
            of_p, of_r = 0.0, 0.0
            for d in range(n):
                turned = stages.residual[i * n + d]
                of_p += m.mass[k, d] * turned + m.shift[k, d] * change[d]
                of_r += m.damping[k, d] * turned + m.stiffness[k, d] * change[d]
            stages.p[i, k] += of_p
            stages.r[i, k] += of_r


@inline
def rounding_floor(h: float, q: Floats, v: Floats, stages: Stages) -> tuple[float, float]:
    """The largest velocity, and what the rounding of positions makes of it over a step, ε |q|/h.

    `q` and `v` have shape (n,), those at the start of the step.
    """
    count, n = stages.q.shape
    speed, size = 1e-300, 0.0
    for d in range(n):
        speed, size = max(speed, abs(v[d])), max(size, abs(q[d]))
    for i in range(count):
        for d in range(n):
            speed, size = max(speed, abs(stages.v[i, d])), max(size, abs(stages.q[i, d]))
    return speed, ROUNDING * size / h


@inline
def judge(
    weights: ImplicitWeights,
    now: tuple[float, float, float],
    iteration: int,
    corrections: tuple[float, float],
    is_kicked: int,
    slowness: float,
    start: Start,
    stages: Stages,
) -> tuple[int, float, float]:
    """Whether a correction was the last: the outcome, or GO_ON; the ratio to the one before, and that of the first two.

    `now` = (t, h, tolerance), `corrections` = (this one, the one before), `slowness` is the latter ratio as known
    before. The last correction changes what ṗ adds to the momenta, too, unless that is below their rounding, or
    tolerated.
    """
    _, h, tolerance = now
    correction, before = corrections
    if not correction < np.inf:
        return NOT_FINITE, 0.0, np.inf
    speed, floor = rounding_floor(h, start.q, start.v, stages)
    ratio = correction / before if iteration > 1 else 0.0
    slowness = ratio if iteration == 2 else slowness
    left = correction * (ratio / (1.0 - ratio) if 0.0 < ratio < 1.0 else 1.0)
    is_done = correction <= ROUNDING * speed or left <= 0.1 * ROUNDING * speed
    is_done = is_done or (ratio > 0.3 and correction <= 1e-11 * speed + 64.0 * floor)  # rounding errors
    is_done = is_done or (iteration > 1 and correction <= floor and is_kicked != 0)  # g is not known better
    if is_done or (iteration > 1 and left * max(1.0, h) <= tolerance):
        if is_done and stages.influence[0] * correction > 0.1 * ROUNDING * speed:
            follow(weights, h, stages)
        return FINE, ratio, slowness if iteration > 2 or not is_done else 0.0
    if iteration > 3 and ratio >= 1.0:
        return NEWTON_FAILED, ratio, ratio
    return GO_ON, ratio, slowness


@inline
def newton(
    motion: Motion,
    phase: Phase,
    weights: ImplicitWeights,
    now: tuple[float, float, float],
    start: Start,
    stages: Stages,
    kicks: Kicks,
) -> tuple[int, int, float]:
    """Iterates until corrections are rounding errors, or (tolerance > 0) change positions by less than that.

    `now` = (t, h, tolerance). Where kicks keep constraints, each correction brings the new positions onto them as well.

    Returns the outcome, the number of iterations and the ratio of the first two corrections, 0 if there were no more
    and the second may be a rounding error.
    """
    t, h, _ = now
    before, ratio, slowness, is_kicked = np.inf, 0.0, 0.0, 1 if kicks.right.size > 0 else 0
    for iteration in range(1, MOST_ITERATIONS + 1):
        evaluate(phase, weights, t, h, start.q, stages)
        correct(weights, h, start.p, stages)
        if kicks.right.size > 0:
            kick(motion, weights, t, h, start, stages, kicks)
        correction = take(stages)
        outcome, ratio, slowness = judge(
            weights, now, iteration, (correction, before), is_kicked, slowness, start, stages
        )
        if outcome != GO_ON:
            return outcome, iteration, slowness
        before = correction
    return NEWTON_FAILED, MOST_ITERATIONS, ratio


@inline
def newton_in_symbols(
    weights: ImplicitWeights, now: tuple[float, float, float], start: Start, stages: Stages, kicked: Kicked
) -> tuple[int, int, float]:
    """`newton` with kicks that are solved for in symbols; GO_ON where that does not hold, and numbers have to."""
    before, ratio, slowness = np.inf, 0.0, 0.0
    for iteration in range(1, MOST_ITERATIONS + 1):
        if not correct_kicked(kicked):
            return GO_ON, iteration, slowness
        correction = take(stages)
        outcome, ratio, slowness = judge(weights, now, iteration, (correction, before), 1, slowness, start, stages)
        if outcome != GO_ON:
            return outcome, iteration, slowness
        before = correction
    return NEWTON_FAILED, MOST_ITERATIONS, ratio
