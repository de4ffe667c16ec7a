"""Momenta and their rates of a compiled model, and their derivatives by differences."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .compiler import inline
from .motion import FINE, NOT_FINITE, SINGULAR, SMALLEST_PIVOT, Floats, factor, holds, solve
from .pointer import call

NUDGE = 1.5e-8  # of forward differences: the root of the rounding error


class Phase(NamedTuple):
    """A compiled function of q, q̇, t: the packed lower triangle of M, p = ∂E/∂q̇ and ṗ = ∂E/∂q + Q.

    `inputs` has shape (2n + 1 + parameters,), `outputs` shape (n (n + 1)/2 + 2n,).

    Where there are constraints, ṗ contains their reactions, and behind it stand the signs of a solution in symbols (see
    `model.solved`). Where these say that it does not hold, `general` is the address of a function that says the same by
    numbers, else 0; `memory`, shape (size,), at the address `block`, keeps what it reads and writes.
    """

    address: int
    data: int
    degrees: int
    inputs: Floats
    outputs: Floats
    general: int
    block: int
    memory: Floats


class Linear(NamedTuple):
    """Derivatives of momenta and their rates at one state: M = ∂p/∂q̇, A = ∂p/∂q, D = ∂ṗ/∂q̇, K = ∂ṗ/∂q.

    `mass`, `shift`, `damping` and `stiffness` are these in order: shape (n, n) each.
    """

    mass: Floats
    shift: Floats
    damping: Floats
    stiffness: Floats


@inline
def momenta(phase: Phase, t: float, q: Floats, v: Floats, p: Floats, rate: Floats) -> None:
    """p = ∂E/∂q̇ and ṗ = ∂E/∂q + Q at (q, v, t); `q`, `v` and, written, `p` and `rate` have shape (n,)."""
    n = phase.degrees
    for i in range(n):
        phase.inputs[i] = q[i]
        phase.inputs[n + i] = v[i]
    phase.inputs[2 * n] = t
    call(phase.address, phase.data, phase.outputs, phase.inputs)
    first = n * (n + 1) // 2
    if phase.general != 0 and not holds(phase.outputs, first + n, n, first + 2 * n):
        call(phase.general, phase.block, phase.outputs, phase.inputs)
    for i in range(n):
        p[i] = phase.outputs[first + i]
        rate[i] = phase.outputs[first + n + i]


@inline
def velocity(phase: Phase, t: float, q: Floats, p: Floats, v: Floats, spare: Floats) -> int:
    """The rates v that belong to momenta p, which are affine in them; v holds a first guess. Returns the outcome.

    `q`, `p`, `v` and `spare` have shape (n,).
    """
    n = phase.degrees
    momenta(phase, t, q, v, spare, spare)
    first = n * (n + 1) // 2
    for i in range(n):
        phase.outputs[first + i] = p[i] - phase.outputs[first + i]
    ratio = factor(phase.outputs, n)
    if not ratio > SMALLEST_PIVOT:
        return NOT_FINITE if np.isnan(ratio) else SINGULAR
    solve(phase.outputs, n)
    for i in range(n):
        v[i] += phase.outputs[first + i]
    return FINE


@inline
def linearize(phase: Phase, t: float, q: Floats, v: Floats, linear: Linear, spare: Floats) -> None:
    """The derivatives at (q, v, t) into `linear`, by forward differences.

    `q` and `v` have shape (n,), `spare` shape (4, n).
    """
    n = phase.degrees
    momenta(phase, t, q, v, spare[0], spare[1])
    for j in range(n):
        base, nudge = v[j], NUDGE * max(1.0, abs(v[j]))
        v[j] = base + nudge
        momenta(phase, t, q, v, spare[2], spare[3])
        nudge = v[j] - base
        v[j] = base
        for i in range(n):
            linear.mass[i, j] = (spare[2, i] - spare[0, i]) / nudge
            linear.damping[i, j] = (spare[3, i] - spare[1, i]) / nudge
        base, nudge = q[j], NUDGE * max(1.0, abs(q[j]))
        q[j] = base + nudge
        momenta(phase, t, q, v, spare[2], spare[3])
        nudge = q[j] - base
        q[j] = base
        for i in range(n):
            linear.shift[i, j] = (spare[2, i] - spare[0, i]) / nudge
            linear.stiffness[i, j] = (spare[3, i] - spare[1, i]) / nudge
