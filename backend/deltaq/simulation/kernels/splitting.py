"""The stepping loop of partitioned methods where M is constant and forces depend on q and t alone: kick and drift.

Positions and momenta are advanced in turn, each exactly, so nothing is to be solved for.
Source: Hairer, Lubich, Wanner, Geometric Numerical Integration, VI.3.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .compiler import inner, kernel, variable
from .hermite import Ends, make_ends, sample_between, watch_between
from .loop import Result, begin, interruption, passed
from .motion import FINE, NOT_FINITE, TOO_LARGE, Floats, Motion, factor, slope, solve
from .phase import Phase, momenta
from .plan import entered, fitted, record
from .step import LARGEST_VALUE
from .step_control import Control
from .watch import Watch


class SplitWeights(NamedTuple):
    """Kick by kicks[i] h, then drift by drifts[i] h, for every i."""

    kicks: Floats
    drifts: Floats


class SplitRoom(NamedTuple):
    """Both ends of a step, digits below their rounding, the force at hand and the factors of M with room for one."""

    ends: Ends
    lost: Floats
    force: Floats
    spare: Floats
    factors: Floats


def make_split_room(state: Floats, n: int) -> SplitRoom:
    line = np.zeros(n)
    return SplitRoom(make_ends(state), np.zeros(state.size), line, line.copy(), np.zeros(n * (n + 1) // 2 + n))


@inner
def add(d: int, change: float, room: SplitRoom) -> None:
    """Component d of the new state changed, with compensation."""
    change += room.lost[d]
    old = room.ends.new[d]
    room.ends.new[d] = old + change
    room.lost[d] = change - (room.ends.new[d] - old)


@inner
def push(phase: Phase, t: float, room: SplitRoom) -> None:
    """M⁻¹ ṗ at the new positions."""
    n = phase.degrees
    momenta(phase, t, room.ends.new[:n], room.ends.new[n : 2 * n], room.spare, room.force)
    first = n * (n + 1) // 2
    for d in range(n):
        room.factors[first + d] = room.force[d]
    solve(room.factors, n)
    for d in range(n):
        room.force[d] = room.factors[first + d]


@inner
def factorize(phase: Phase, t: float, room: SplitRoom) -> None:
    """The factors of M, which stay."""
    n = phase.degrees
    push(phase, t, room)
    for i in range(n * (n + 1) // 2):
        room.factors[i] = phase.outputs[i]
    factor(room.factors, n)


@inner
def advance(phase: Phase, weights: SplitWeights, t: float, h: float, known: int, room: SplitRoom) -> tuple[bool, int]:
    """All kicks and drifts of a step; `known` says whether the force at the start is at hand.

    Returns whether it is at hand for the end, and how many forces were computed.
    """
    n, computed, place = phase.degrees, 0, 0.0
    is_known = known != 0
    for i in range(weights.kicks.size):
        if weights.kicks[i] != 0.0:
            if not is_known:
                push(phase, t + place * h, room)
                computed += 1
                is_known = True
            for d in range(n):
                add(n + d, weights.kicks[i] * h * room.force[d], room)
        if weights.drifts[i] != 0.0:
            for d in range(n):
                add(d, weights.drifts[i] * h * room.ends.new[n + d], room)
            place += weights.drifts[i]
            is_known = False
    return is_known, computed


@inner
def check(n: int, room: SplitRoom) -> int:
    """Whether the new state is within bounds."""
    for d in range(2 * n):
        size = abs(room.ends.new[d])
        if not size <= LARGEST_VALUE:
            return TOO_LARGE if size < np.inf else NOT_FINITE
    return FINE


@kernel
def work(motion: Motion, t: float, h: float, room: SplitRoom) -> int:
    """∫P dt over the step, by the trapezoidal rule."""
    ends, n = room.ends, motion.degrees
    outcome = slope(motion, t, ends.old, ends.old_slope)
    if outcome == FINE:
        outcome = slope(motion, t + h, ends.new, ends.new_slope)
    add(2 * n, 0.5 * h * (ends.old_slope[2 * n] + ends.new_slope[2 * n]), room)
    return outcome


@kernel
def integrate_split(
    motion: Motion,
    phase: Phase,
    weights: SplitWeights,
    control: Control,
    watch: Watch,
    room: SplitRoom,
    times: Floats,
    out: Floats,
) -> Result:
    """Steps of one size from times[0] past times[-1]; out[i] becomes (q, q̇, ∫P dt) at times[i].

    The initial state stands in room.ends.old and room.ends.new.
    """
    t, lost_time, n, plan, ends = times[0], 0.0, motion.degrees, control.plan, room.ends
    outcome = begin(motion, plan, watch, t, ends.old, ends.old_slope, out)
    if outcome != FINE:
        return Result(outcome, 1, 0, 0, 1, t)
    factorize(phase, t, room)
    filled, steps, evaluations, piece, is_known = variable(1), 0, 2, variable(0), False
    while filled < times.size and outcome == FINE:
        outcome = interruption(control, steps, watch)
        if outcome != FINE:
            break
        piece, t, jumped = entered(plan, piece, t)
        if jumped:
            lost_time, is_known = 0.0, False
            record(plan, t, ends.old)
        h, ends_piece = fitted(plan, piece, t, np.inf)
        is_known, computed = advance(phase, weights, t, h, 1 if is_known else 0, room)
        evaluations += computed
        outcome = check(n, room)
        if outcome == FINE and motion.is_powered:
            outcome = work(motion, t, h, room)
            evaluations += 2
        if outcome != FINE:
            break
        filled, extra = sample_between(motion, t, h, times, out, filled, ends)
        evaluations += extra
        outcome, extra = watch_between(motion, t, h, watch, ends)
        evaluations += extra
        for d in range(ends.old.size):
            ends.old[d] = ends.new[d]
        steps += 1
        t, lost_time = passed(plan, piece, t, h, lost_time, 1 if ends_piece else 0)
        record(plan, t, ends.old)
    return Result(outcome, filled, steps, 0, evaluations, min(t, times[times.size - 1]))
