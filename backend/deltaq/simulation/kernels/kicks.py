"""Kicks of the momenta at the start of a step that put its end on the constraints.

A step of a symplectic method between two kicks A(q₀)ᵀν and A(q₁)ᵀμ, with ν such that g(q₁) = 0 and μ such that
w(q₁) = 0, is symplectic on the constraints: with Störmer–Verlet this is RATTLE. ν is an unknown of Newton's iteration
beside the velocities Vᵢ of the stages: with its matrix W,

    W δVᵢ = rᵢ + A(q₀)ᵀδν,   g(q₁) + h A(q₁) Σ bⱼ δVⱼ = 0,

where A(q₁) is taken once, where the first guesses lead. Both converge together, as fast as the stages do without
constraints; μ is what the projection of the new rates does.
Source: Hairer, Lubich, Wanner, Geometric Numerical Integration, 2nd ed., VII.1.4.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .compiler import inline
from .constraints import scale
from .linear import Indices, substitute
from .motion import FINE, NOT_FINITE, Floats, Motion
from .pointer import call
from .ranked import factor_ranked, solve_ranked
from .stages import ImplicitWeights, Stages, Start
from .system import (
    COUNT,
    DEGREES,
    GAPS,
    GAPS_DATA,
    IS_UNDER_WAY,
    MOTION,
    MOTION_DATA,
    System,
    block_at,
    place_of_rows,
)


class Kicks(NamedTuple):
    """The arrays of k constraints kept by kicks, with s stages for n coordinates; k = 0 where nothing is.

    `p`, shape (n,), are the momenta before the kick; `responses`, shape (k, s n), the rows of W⁻¹A(q₀)ᵀ, `schur`, shape
    (k²,), is h A(q₁) Σ bᵢ times them, scaled by `scales` and factored, `order` that of its rows, `right` a right side,
    shape (k,) each, and `rank`, shape (1,), how many of them are independent.
    """

    p: Floats
    responses: Floats
    schur: Floats
    order: Indices
    scales: Floats
    right: Floats
    rank: Indices


def make_kicks(kicked: int, stages: int, n: int) -> Kicks:
    """Those of so many constraints."""
    line = np.zeros(kicked)
    return Kicks(
        np.zeros(n),
        np.zeros((kicked, stages * n)),
        np.zeros(kicked * kicked),
        np.zeros(kicked, dtype=np.int64),
        line.copy(),
        line.copy(),
        np.zeros(1, dtype=np.int64),
    )


@inline
def place_new(system: System, weights: ImplicitWeights, t: float, h: float, start: Start, stages: Stages) -> None:
    """The new positions by the present Vᵢ, and t + h, into `inputs`."""
    count, n = stages.q.shape
    for d in range(n):
        rate = 0.0
        for i in range(count):
            rate += weights.b[i] * stages.v[i, d]
        system.inputs[d] = start.q[d] + h * rate
        system.inputs[n + d] = rate
    system.inputs[2 * n] = t + h


@inline
def rows_before(system: System, t: float, start: Start) -> None:
    """A(q₀) into `before`, where no step before this one has left it there."""
    n = system.head[DEGREES]
    if system.head[IS_UNDER_WAY] != 0:
        return
    for d in range(n):
        system.inputs[d], system.inputs[n + d] = start.q[d], start.v[d]
    system.inputs[2 * n] = t
    call(system.head[MOTION], system.head[MOTION_DATA], system.outputs, system.inputs)
    rows = place_of_rows(system)
    for i in range(n * system.head[COUNT]):
        system.before[i] = system.outputs[rows + i]
    system.head[IS_UNDER_WAY] = 1


@inline
def weigh_kicks(system: System, weights: ImplicitWeights, h: float, n: int, kicks: Kicks) -> None:
    """h A(q₁) Σ bᵢ times the responses, A(q₁) from the outputs, scaled to a unit diagonal."""
    rows, count = place_of_rows(system), kicks.right.size
    for j in range(count):
        for k in range(count):
            total = 0.0
            for i in range(weights.b.size):
                for d in range(n):
                    total += weights.b[i] * system.outputs[rows + k * n + d] * kicks.responses[j, i * n + d]
            kicks.schur[k * count + j] = h * total
    for k in range(count):
        kicks.scales[k] = scale(kicks.schur[k * count + k])
    for k in range(count):
        for j in range(count):
            kicks.schur[k * count + j] *= kicks.scales[k] * kicks.scales[j]


@inline
def prepare_kicks(
    motion: Motion, weights: ImplicitWeights, t: float, h: float, start: Start, stages: Stages, kicks: Kicks
) -> int:
    """What every kick of a step needs, by the first guesses of Vᵢ; returns the outcome."""
    system, count, n = block_at(motion.block), weights.b.size, motion.degrees
    rows_before(system, t, start)
    for k in range(kicks.right.size):
        for i in range(count):
            for d in range(n):
                kicks.responses[k, i * n + d] = system.before[k * n + d]
        substitute(stages.matrix, stages.pivots, kicks.responses[k])
    place_new(system, weights, t, h, start, stages)
    call(system.head[MOTION], system.head[MOTION_DATA], system.outputs, system.inputs)
    weigh_kicks(system, weights, h, n, kicks)
    rank, _ = factor_ranked(kicks.schur, kicks.order, kicks.right.size)
    kicks.rank[0] = rank
    return FINE if rank >= 0 else NOT_FINITE


@inline
def kick(
    motion: Motion, weights: ImplicitWeights, t: float, h: float, start: Start, stages: Stages, kicks: Kicks
) -> None:
    """The correction in `residual` completed so that it leads onto g = 0, and the momenta at the start kicked."""
    system, n, count = block_at(motion.block), motion.degrees, kicks.right.size
    rows = place_of_rows(system)
    place_new(system, weights, t, h, start, stages)
    call(system.head[GAPS], system.head[GAPS_DATA], system.gaps, system.inputs)
    for k in range(count):
        moved = 0.0
        for i in range(weights.b.size):
            for d in range(n):
                moved += weights.b[i] * system.outputs[rows + k * n + d] * stages.residual[i * n + d]
        kicks.right[k] = system.gaps[k] + h * moved
    solve_ranked(kicks.schur, kicks.order, count, kicks.rank[0], kicks.scales, kicks.right)
    for k in range(count):
        for d in range(n):
            start.p[d] -= kicks.right[k] * system.before[k * n + d]
        for i in range(stages.residual.size):
            stages.residual[i] -= kicks.right[k] * kicks.responses[k, i]
