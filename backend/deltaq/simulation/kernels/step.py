"""One step of an explicit Runge–Kutta method: its stages, and the new state by compensated (Kahan) summation."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .compiler import inline, runtime_int
from .motion import FINE, NOT_FINITE, TOO_LARGE, Floats, Motion, rhs, rhs_at_inputs
from .pointer import prevent_vectorization

LARGEST_VALUE = 1e15  # of coordinates and rates: beyond, nothing in a mechanical scene has a meaning


class Weights(NamedTuple):
    """A tableau with s stages as arrays (see `method.Tableau`); `a` and `c` begin with the second stage.

    `a` has shape (s − 1, s), `b` shape (s,), `c` shape (s − 1,), `error` shape (estimates, s + 1). Of the continuous
    extension with e further stages, `dense` has shape (terms, s + 1 + e), `extra_a` shape (e, s + 1 + e), `extra_c`
    (e,). `reads_end`: whether the error depends on the derivative at the end of the step.
    """

    a: Floats
    b: Floats
    c: Floats
    error: Floats
    dense: Floats
    extra_a: Floats
    extra_c: Floats
    reads_end: int


class Workspace(NamedTuple):
    """What a step writes to. Kernels allocate nothing, so that Numba counts no references in the inner loop.

    `derivatives`, shape (s + 1 + e, width), are the kᵢ of all stages, `stage` the state of one stage, `old` and `new`
    the states at the ends of the step, `compensation` and `new_compensation` digits of them below their rounding: shape
    (width,) each. `extension`, shape (3 + terms, width), are the coefficients of the continuous extension.
    """

    derivatives: Floats  # of all stages
    stage: Floats  # the state of one stage
    old: Floats
    new: Floats
    compensation: Floats  # digits of the old state below its rounding
    new_compensation: Floats
    extension: Floats


def make_workspace(state: Floats, weights: Weights) -> Workspace:
    """The workspace of a method, at an initial state of shape (width,)."""
    width, derivatives = state.size, weights.b.size + 1 + weights.extra_c.size
    stage, old, new, compensation, new_compensation = np.zeros((5, width))
    old[:] = state
    extension = np.zeros((3 + weights.dense.shape[0], width))
    return Workspace(np.zeros((derivatives, width)), stage, old, new, compensation, new_compensation, extension)


@inline
def stages(motion: Motion, a: Floats, c: Floats, first: int, t: float, h: float, workspace: Workspace) -> int:
    """The derivatives kᵢ number `first` and on, one for each row of a; returns the outcome.

    `a` has shape (stages, ≥ first + stages), `c` shape (stages,).
    """
    n, old, stage, derivatives, inputs = (
        motion.degrees,
        workspace.old,
        workspace.stage,
        workspace.derivatives,
        motion.inputs,
    )
    for s in range(c.size):
        for d in range(n):  # no derivative depends on ∫P dt
            value, rate = 0.0, 0.0
            for j in range(first + s):
                value += a[s, j] * derivatives[j, d]
                rate += a[s, j] * derivatives[j, n + d]
            stage[d] = inputs[d] = old[d] + h * value
            stage[n + d] = inputs[n + d] = old[n + d] + h * rate
        outcome = rhs_at_inputs(motion, t + c[s] * h, workspace.derivatives[first + s])
        if outcome != FINE:
            return outcome
    return FINE


@inline
def judge_size(value: float, d: int, width: int) -> int:
    """Whether component d of a state (q, q̇) or (q, q̇, ∫P dt) is one to go on from: FINE, TOO_LARGE or NOT_FINITE.

    Work is neither a coordinate nor a rate; it only has to be a number.
    """
    is_work = d == width - 1 and width % 2 == 1
    size = abs(value)
    if size <= LARGEST_VALUE or (is_work and size < np.inf):
        return FINE
    return NOT_FINITE if np.isnan(size) else TOO_LARGE


@inline
def advance(b: Floats, h: float, workspace: Workspace) -> int:
    """The new state y + h Σ bⱼ kⱼ by Kahan's summation; returns the outcome. `b` has shape (s,).

    Σ bⱼ = 1, so what is summed is how the kⱼ differ from the first: large weights then round nothing large.
    """
    for d in range(workspace.old.size):
        first, change = workspace.derivatives[0, d], 0.0
        for j in range(1, b.size):
            change += b[j] * (workspace.derivatives[j, d] - first)
        change = h * (first + change) + workspace.compensation[d]
        workspace.new[d] = workspace.old[d] + change
        workspace.new_compensation[d] = change - (workspace.new[d] - workspace.old[d])
        outcome = judge_size(workspace.new[d], d, workspace.old.size)
        if outcome != FINE:
            return outcome
    return FINE


@inline
def attempt(motion: Motion, weights: Weights, t: float, h: float, reads_end: int, workspace: Workspace) -> int:
    """All stages of one step, the new state and the derivative there; returns the outcome.

    Where the new state will be projected, its derivative is computed then, and here only if it is read before
    (`reads_end`), as by an error that is estimated.
    """
    outcome = stages(motion, weights.a, weights.c, runtime_int(1), t, h, workspace)
    if outcome == FINE:
        outcome = advance(weights.b, h, workspace)
    if outcome == FINE and (motion.finish == 0 or reads_end != 0):
        outcome = rhs(motion, t + h, workspace.new, workspace.derivatives[weights.b.size])
    return outcome


@inline
def accept(end: int, workspace: Workspace) -> None:
    """The new state becomes the old one; `end` is the row of the derivative at the end of the step."""
    prevent_vectorization()
    for d in range(workspace.old.size):
        workspace.old[d] = workspace.new[d]
        workspace.compensation[d] = workspace.new_compensation[d]
        workspace.derivatives[0, d] = workspace.derivatives[end, d]
