"""One step of an implicit method in positions and momenta."""

from __future__ import annotations

import numpy as np

from .compiler import inner
from .implicit_error import error_of, prepare_error
from .implicit_room import ImplicitRoom, add
from .motion import FINE, NEWTON_FAILED, NOT_FINITE, TOO_LARGE, Motion, slope
from .newton import assemble, newton
from .phase import Phase, linearize, velocity
from .stages import ImplicitWeights, Start, middle
from .step import LARGEST_VALUE


@inner
def finish(motion: Motion, phase: Phase, weights: ImplicitWeights, t: float, h: float, room: ImplicitRoom) -> int:
    """The new state from the stages."""
    stages, ends, n = room.stages, room.ends, motion.degrees
    count = weights.b.size
    for d in range(n):
        change, push = 0.0, 0.0
        for i in range(count):
            change += weights.b[i] * stages.v[i, d]
            push += weights.momentum_b[i] * stages.r[i, d]
        ends.new[d] = add(ends.old[d], h * change, d, room)
        room.new_p[d] = add(room.p[d], h * push, n + d, room)
        ends.new[n + d] = stages.v[count - 1, d]
        if not abs(ends.new[d]) + abs(room.new_p[d]) <= LARGEST_VALUE:
            return TOO_LARGE if abs(ends.new[d]) + abs(room.new_p[d]) < np.inf else NOT_FINITE
    if motion.is_powered:
        work = 0.0
        for i in range(count):
            for d in range(n):
                room.state[d] = stages.q[i, d]
                room.state[n + d] = stages.v[i, d]
            if slope(motion, t + weights.c[i] * h, room.state, room.slope) != FINE:
                return NOT_FINITE
            work += weights.b[i] * room.slope[2 * n]
        ends.new[2 * n] = add(ends.old[2 * n], h * work, 2 * n, room)
    return velocity(phase, t + h, ends.new[:n], room.new_p, ends.new[n : 2 * n], stages.spare[0])


@inner
def differentiate(phase: Phase, weights: ImplicitWeights, t: float, h: float, room: ImplicitRoom) -> int:
    """The derivatives in the middle of the step, by the first guesses; returns the evaluations made."""
    stages, n = room.stages, room.p.size
    middle(weights, h, room.ends.old[:n], stages)
    linearize(phase, t + 0.5 * h, stages.centre[0], stages.centre[1], stages.linear, stages.spare)
    return 1 + 2 * n


@inner
def prepare(weights: ImplicitWeights, h: float, room: ImplicitRoom) -> int:
    """The matrices for steps of size h; returns how it went."""
    if not assemble(weights, h, room.stages):
        return NEWTON_FAILED
    if weights.error.size > 0 and not prepare_error(weights, h, room):
        return NEWTON_FAILED
    return FINE


@inner
def attempt_implicit(
    motion: Motion, phase: Phase, weights: ImplicitWeights, tolerance: float, t: float, h: float, room: ImplicitRoom
) -> tuple[int, int, float, float]:
    """Stages, new state and error; returns how it went, the evaluations, the first ratio of corrections, the error."""
    n = room.p.size
    start = Start(room.ends.old[:n], room.ends.old[n : 2 * n], room.p)
    outcome, iterations, slowness = newton(phase, weights, t, h, 0.02 * tolerance, start, room.stages)
    if outcome == FINE:
        outcome = finish(motion, phase, weights, t, h, room)
    error = error_of(weights, tolerance, h, room) if outcome == FINE and tolerance > 0.0 else 0.0
    return outcome, weights.b.size * iterations + 1, slowness, error
