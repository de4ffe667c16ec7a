"""One step of Newmark's family of methods, by Newton's iteration in the accelerations at its end."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .compiler import inner
from .hermite import Ends, make_ends
from .linear import Places, decompose, substitute
from .motion import FINE, NEWTON_FAILED, NOT_FINITE, ROUNDING, TOO_LARGE, Floats, Motion, slope
from .phase import NUDGE
from .pointer import call
from .step import LARGEST_VALUE

MOST_ITERATIONS = 50


class NewmarkWeights(NamedTuple):
    """q₁ = q₀ + h q̇₀ + h²((½ − β)q̈₀ + β q̈₁), q̇₁ = q̇₀ + h((1 − γ)q̈₀ + γ q̈₁)."""

    beta: float
    gamma: float


class NewmarkRoom(NamedTuple):
    """Both ends of a step, digits below their rounding, the acceleration sought and the matrix of the iteration."""

    ends: Ends
    lost: Floats
    new_lost: Floats
    acceleration: Floats
    residual: Floats
    column: Floats
    matrix: Floats
    places: Places


def make_newmark_room(state: Floats, n: int) -> NewmarkRoom:
    wide, line = np.zeros(state.size), np.zeros(n)
    lines = (line, line.copy(), line.copy())
    places = np.zeros(n, dtype=np.int64)
    return NewmarkRoom(make_ends(state), wide, wide.copy(), *lines, np.zeros((n, n)), places)


@inner
def place(weights: NewmarkWeights, h: float, room: NewmarkRoom) -> None:
    """The state at the end that belongs to the acceleration sought, with compensation."""
    ends, n = room.ends, room.residual.size
    for d in range(n):
        a, b, v = ends.old_slope[n + d], room.acceleration[d], ends.old[n + d]
        change = h * (v + h * ((0.5 - weights.beta) * a + weights.beta * b)) + room.lost[d]
        ends.new[d] = ends.old[d] + change
        room.new_lost[d] = change - (ends.new[d] - ends.old[d])
        change = h * ((1.0 - weights.gamma) * a + weights.gamma * b) + room.lost[n + d]
        ends.new[n + d] = v + change
        room.new_lost[n + d] = change - (ends.new[n + d] - v)


@inner
def imbalance(motion: Motion, t: float, room: NewmarkRoom, out: Floats) -> None:
    """f − M q̈ at the end of the step, for the acceleration sought."""
    n = motion.degrees
    for i in range(2 * n):
        motion.inputs[i] = room.ends.new[i]
    motion.inputs[2 * n] = t
    call(motion.address, motion.data, motion.outputs, motion.inputs)
    for i in range(n):
        out[i] = motion.outputs[n * (n + 1) // 2 + i]
        for j in range(n):
            at = i * (i + 1) // 2 + j if j <= i else j * (j + 1) // 2 + i
            out[i] -= motion.outputs[at] * room.acceleration[j]


@inner
def differentiate(motion: Motion, weights: NewmarkWeights, t: float, h: float, room: NewmarkRoom) -> bool:
    """The derivative of the imbalance by the acceleration sought, by differences, decomposed; False if singular."""
    n = motion.degrees
    place(weights, h, room)
    imbalance(motion, t, room, room.residual)
    for j in range(n):
        kept = room.acceleration[j]
        nudge = NUDGE * max(1.0, abs(room.ends.new[j])) / (weights.beta * h * h)
        room.acceleration[j] = kept + nudge
        place(weights, h, room)
        imbalance(motion, t, room, room.column)
        room.acceleration[j] = kept
        for i in range(n):
            room.matrix[i, j] = (room.residual[i] - room.column[i]) / nudge
    return decompose(room.matrix, room.places)


@inner
def iterate(motion: Motion, weights: NewmarkWeights, t: float, h: float, room: NewmarkRoom) -> tuple[int, int, float]:
    """Newton's iteration down to rounding; returns how it went, the iterations and the first ratio of corrections."""
    n, before, ratio, slowness = motion.degrees, np.inf, 0.0, 0.0
    for iteration in range(1, MOST_ITERATIONS + 1):
        place(weights, h, room)
        imbalance(motion, t, room, room.residual)
        substitute(room.matrix, room.places, room.residual)
        correction, size, reach = 0.0, 1e-300, 0.0
        for d in range(n):
            room.acceleration[d] += room.residual[d]
            change = abs(room.residual[d])
            correction = change if not change <= correction else correction
            size = max(size, abs(room.acceleration[d]))
            reach = max(reach, abs(room.ends.new[d]), abs(room.ends.old[d]), h * abs(room.ends.old[n + d]))
        if not correction < np.inf:
            return NOT_FINITE, iteration, np.inf
        ratio = correction / before if iteration > 1 else 0.0
        slowness = ratio if iteration == 2 else slowness
        grain = ROUNDING * (size + reach / (weights.beta * h * h))
        if correction <= ROUNDING * size or (ratio > 0.3 and correction <= 64.0 * grain):
            place(weights, h, room)
            return FINE, iteration, slowness
        if iteration > 3 and ratio >= 1.0:
            return NEWTON_FAILED, iteration, ratio
        before = correction
    return NEWTON_FAILED, MOST_ITERATIONS, ratio


@inner
def settle(motion: Motion, t: float, h: float, room: NewmarkRoom) -> int:
    """Slope and work at the end of the step, and whether the new state is within bounds."""
    ends, n = room.ends, motion.degrees
    for d in range(2 * n):
        size = abs(ends.new[d])
        if not size <= LARGEST_VALUE:
            return TOO_LARGE if size < np.inf else NOT_FINITE
    outcome = slope(motion, t + h, ends.new, ends.new_slope)
    for d in range(2 * n, ends.new.size):
        ends.new[d] = ends.old[d] + 0.5 * h * (ends.old_slope[d] + ends.new_slope[d])
    return outcome


@inner
def attempt_newmark(
    motion: Motion, weights: NewmarkWeights, t: float, h: float, is_fresh: int, room: NewmarkRoom
) -> tuple[int, int, float]:
    """One step, with a fresh matrix if asked; returns how it went, the evaluations, the first ratio of corrections."""
    n, made, slowness, outcome = motion.degrees, 1, np.inf, FINE
    for d in range(n):
        room.acceleration[d] = room.ends.old_slope[n + d]
    if is_fresh != 0:
        outcome = FINE if differentiate(motion, weights, t + h, h, room) else NEWTON_FAILED
        made += 1 + n
    if outcome == FINE:
        outcome, iterations, slowness = iterate(motion, weights, t + h, h, room)
        made += iterations
    if outcome == FINE:
        outcome = settle(motion, t, h, room)
    return outcome, made, slowness


@inner
def take(room: NewmarkRoom) -> None:
    """The new state becomes the old one."""
    for d in range(room.ends.old.size):
        room.ends.old[d], room.ends.old_slope[d] = room.ends.new[d], room.ends.new_slope[d]
        room.lost[d] = room.new_lost[d]
