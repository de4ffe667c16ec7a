"""One step of Newmark's family of methods, by Newton's iteration in the accelerations at its end."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .compiler import inline
from .hermite import Ends, make_ends
from .linear import Indices, decompose, substitute
from .motion import (
    FINE,
    NEWTON_FAILED,
    NOT_FINITE,
    ROUNDING,
    TOO_LARGE,
    Floats,
    Motion,
    evaluate,
    finish_constrained,
    rhs,
)
from .phase import NUDGE
from .step import LARGEST_VALUE

MOST_ITERATIONS = 50
DIFFERENCES = 6  # of accelerations that a first guess is made of, the accelerations themselves the first
KNOWN, USEFUL = 0, 1


class NewmarkWeights(NamedTuple):
    """q₁ = q₀ + h q̇₀ + h²((½ − β)q̈₀ + β q̈₁), q̇₁ = q̇₀ + h((1 − γ)q̈₀ + γ q̈₁)."""

    beta: float
    gamma: float


class NewmarkWorkspace(NamedTuple):
    """Both ends of a step, digits below their rounding, the acceleration sought and the matrix of the iteration.

    `compensation` and `new_compensation` have shape (width,); `acceleration`, `residual`, `column` and `pivots` shape
    (n,); `matrix` shape (n, n). `differences`, shape (DIFFERENCES, n), are the backward ones of the accelerations that
    were found in the last steps of the same size; `remembered`, shape (2,), is how many of them are KNOWN, and USEFUL.
    """

    ends: Ends
    compensation: Floats
    new_compensation: Floats
    acceleration: Floats
    residual: Floats
    column: Floats
    matrix: Floats
    pivots: Indices
    differences: Floats
    remembered: Indices


def make_newmark_workspace(state: Floats, n: int) -> NewmarkWorkspace:
    """The workspace for n coordinates, at an initial state of shape (width,)."""
    wide, line = np.zeros(state.size), np.zeros(n)
    lines = (line, line.copy(), line.copy())
    matrix, pivots = np.zeros((n, n)), np.zeros(n, dtype=np.int64)
    differences, remembered = np.zeros((DIFFERENCES, n)), np.zeros(2, dtype=np.int64)
    return NewmarkWorkspace(make_ends(state), wide, wide.copy(), *lines, matrix, pivots, differences, remembered)


@inline
def guess_acceleration(workspace: NewmarkWorkspace) -> None:
    """The first guess of the acceleration at the end: the polynomial through those of the last steps, carried on.

    That is the sum of Newton's backward differences, of as many as are useful. Where constraints move the end of a
    step, the acceleration there is another one than was found.
    """
    n, useful = workspace.residual.size, workspace.remembered[USEFUL]
    for d in range(n):
        guess = workspace.ends.old_derivative[n + d] if useful == 0 else 0.0
        for k in range(useful):
            guess += workspace.differences[k, d]
        workspace.acceleration[d] = guess


@inline
def forget_accelerations(workspace: NewmarkWorkspace) -> None:
    """Those behind a jump, of steps of another size or from where no step was found are of no use."""
    workspace.remembered[KNOWN] = workspace.remembered[USEFUL] = 0


@inline
def remember_acceleration(workspace: NewmarkWorkspace) -> None:
    """The acceleration that was found among the differences; those are useful which become smaller and smaller.

    Where steps are long, or differences are rounding errors, they do not.
    """
    n, remembered = workspace.residual.size, workspace.remembered
    known = min(remembered[KNOWN] + 1, DIFFERENCES)
    useful, larger = known, np.inf
    for d in range(n):
        workspace.residual[d] = workspace.acceleration[d]
    for k in range(known):
        size = 0.0
        for d in range(n):
            difference, before = workspace.residual[d], workspace.differences[k, d]
            workspace.differences[k, d], workspace.residual[d] = difference, difference - before
            size = max(size, abs(difference))
        if not size <= 0.5 * larger:
            useful = min(useful, k)
        larger = size
    remembered[KNOWN], remembered[USEFUL] = known, useful


@inline
def update_state(weights: NewmarkWeights, h: float, workspace: NewmarkWorkspace) -> None:
    """Newmark's formulas: q and q̇ at the end of the step for the acceleration sought, with Kahan's summation."""
    ends, n = workspace.ends, workspace.residual.size
    for d in range(n):
        a, b, v = ends.old_derivative[n + d], workspace.acceleration[d], ends.old[n + d]
        change = h * (v + h * ((0.5 - weights.beta) * a + weights.beta * b)) + workspace.compensation[d]
        ends.new[d] = ends.old[d] + change
        workspace.new_compensation[d] = change - (ends.new[d] - ends.old[d])
        change = h * ((1.0 - weights.gamma) * a + weights.gamma * b) + workspace.compensation[n + d]
        ends.new[n + d] = v + change
        workspace.new_compensation[n + d] = change - (ends.new[n + d] - v)


@inline
def equation_residual(motion: Motion, t: float, workspace: NewmarkWorkspace, out: Floats) -> None:
    """f − M q̈ at the end of the step, for the acceleration sought, into `out` of shape (n,)."""
    n = motion.degrees
    for i in range(2 * n):
        motion.inputs[i] = workspace.ends.new[i]
    motion.inputs[2 * n] = t
    evaluate(motion)
    for i in range(n):
        out[i] = motion.outputs[n * (n + 1) // 2 + i]
        for j in range(n):
            at = i * (i + 1) // 2 + j if j <= i else j * (j + 1) // 2 + i
            out[i] -= motion.outputs[at] * workspace.acceleration[j]


@inline
def differentiate(motion: Motion, weights: NewmarkWeights, t: float, h: float, workspace: NewmarkWorkspace) -> bool:
    """The derivative of the residual by the acceleration sought, by differences, decomposed; False if singular."""
    n = motion.degrees
    update_state(weights, h, workspace)
    equation_residual(motion, t, workspace, workspace.residual)
    for j in range(n):
        base = workspace.acceleration[j]
        nudge = NUDGE * max(1.0, abs(workspace.ends.new[j])) / (weights.beta * h * h)
        workspace.acceleration[j] = base + nudge
        update_state(weights, h, workspace)
        equation_residual(motion, t, workspace, workspace.column)
        workspace.acceleration[j] = base
        for i in range(n):
            workspace.matrix[i, j] = (workspace.residual[i] - workspace.column[i]) / nudge
    return decompose(workspace.matrix, workspace.pivots)


@inline
def newton_iteration(
    motion: Motion, weights: NewmarkWeights, t: float, h: float, workspace: NewmarkWorkspace
) -> tuple[int, int, float]:
    """Newton's iteration down to rounding; returns the outcome, the iterations, the ratio of the first corrections.

    That is 0 if there were but two, of which the second may be a rounding error.
    """
    n, before, ratio, slowness = motion.degrees, np.inf, 0.0, 0.0
    for iteration in range(1, MOST_ITERATIONS + 1):
        update_state(weights, h, workspace)
        equation_residual(motion, t, workspace, workspace.residual)
        substitute(workspace.matrix, workspace.pivots, workspace.residual)
        correction, size, reach = 0.0, 1e-300, 0.0
        for d in range(n):
            workspace.acceleration[d] += workspace.residual[d]
            change = abs(workspace.residual[d])
            correction = change if not change <= correction else correction
            size = max(size, abs(workspace.acceleration[d]))
            reach = max(
                reach, abs(workspace.ends.new[d]), abs(workspace.ends.old[d]), h * abs(workspace.ends.old[n + d])
            )
        if not correction < np.inf:
            return NOT_FINITE, iteration, np.inf
        ratio = correction / before if iteration > 1 else 0.0
        slowness = ratio if iteration == 2 else slowness
        floor = ROUNDING * (size + reach / (weights.beta * h * h))
        left = correction * (ratio / (1.0 - ratio) if 0.0 < ratio < 1.0 else 1.0)
        is_rounding = ratio > 0.3 and correction <= 64.0 * floor
        is_rounding = is_rounding or correction <= ROUNDING * floor  # towards q̈ = 0: below what compensation holds
        if correction <= ROUNDING * size or left <= 0.1 * ROUNDING * size or is_rounding:
            update_state(weights, h, workspace)
            return FINE, iteration, slowness if iteration > 2 else 0.0
        if iteration > 3 and ratio >= 1.0:
            return NEWTON_FAILED, iteration, ratio
        before = correction
    return NEWTON_FAILED, MOST_ITERATIONS, ratio


@inline
def finish_step(motion: Motion, t: float, h: float, workspace: NewmarkWorkspace) -> int:
    """The derivative and the work at the end of the step; returns whether the new state is within bounds."""
    ends, n = workspace.ends, motion.degrees
    for d in range(2 * n):
        size = abs(ends.new[d])
        if not size <= LARGEST_VALUE:
            return TOO_LARGE if size < np.inf else NOT_FINITE
    outcome = FINE
    if motion.finish == 0:
        outcome = rhs(motion, t + h, ends.new, ends.new_derivative)
    else:
        outcome = finish_constrained(motion, t, h, ends.old, ends.new, ends.old_derivative, ends.new_derivative)
    for d in range(2 * n, ends.new.size):
        ends.new[d] = ends.old[d] + 0.5 * h * (ends.old_derivative[d] + ends.new_derivative[d])
    return outcome


@inline
def attempt_newmark(
    motion: Motion, weights: NewmarkWeights, t: float, h: float, is_fresh: int, workspace: NewmarkWorkspace
) -> tuple[int, int, float]:
    """One step, with a fresh matrix if asked.

    Returns the outcome, the evaluations made, and the ratio of the first two corrections.
    """
    n, made, slowness, outcome = motion.degrees, 1, np.inf, FINE
    guess_acceleration(workspace)
    if is_fresh != 0:
        outcome = FINE if differentiate(motion, weights, t + h, h, workspace) else NEWTON_FAILED
        made += 1 + n
    if outcome == FINE:
        outcome, iterations, slowness = newton_iteration(motion, weights, t + h, h, workspace)
        made += iterations
    if outcome == FINE:
        outcome = finish_step(motion, t, h, workspace)
    return outcome, made, slowness


@inline
def accept_step(workspace: NewmarkWorkspace) -> None:
    """The new state becomes the old one."""
    remember_acceleration(workspace)
    for d in range(workspace.ends.old.size):
        workspace.ends.old[d], workspace.ends.old_derivative[d] = (
            workspace.ends.new[d],
            workspace.ends.new_derivative[d],
        )
        workspace.compensation[d] = workspace.new_compensation[d]
