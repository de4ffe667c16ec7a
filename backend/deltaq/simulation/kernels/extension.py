"""Samples from the continuous extension of a step, so that they never shorten it."""

from __future__ import annotations

from .compiler import inner, variable
from .motion import FINE, Floats, Motion
from .step import Room, Weights, stages
from .watch import Watch, look_at, seen


@inner
def extend(dense: Floats, h: float, end: int, room: Room) -> None:
    """The continuous extension of a step: cubic Hermite, then the method's own terms."""
    for d in range(room.old.size):
        change = room.new[d] - room.old[d]
        bend = h * room.slopes[0, d] - change
        room.extension[0, d] = change
        room.extension[1, d] = bend
        room.extension[2, d] = change - h * room.slopes[end, d] - bend
        for r in range(dense.shape[0]):
            term = 0.0
            for j in range(dense.shape[1]):
                term += dense[r, j] * room.slopes[j, d]
            room.extension[3 + r, d] = h * term


@inner
def interpolate(theta: float, room: Room, out: Floats) -> None:
    """y(t + θh) = y + θ(F₀ + (1−θ)(F₁ + θ(F₂ + (1−θ)(F₃ + …)))) into `out`."""
    last = room.extension.shape[0] - 1
    for d in range(room.old.size):
        value = 0.0
        for r in range(last, -1, -1):
            value = (value + room.extension[r, d]) * (theta if r % 2 == 0 else 1.0 - theta)
        out[d] = room.old[d] + value


@inner
def sample(
    motion: Motion, weights: Weights, t: float, h: float, times: Floats, out: Floats, first: int, room: Room
) -> tuple[int, int]:
    """Samples number `first` and on, as far as they lie in the step; returns the next one and the evaluations made."""
    end, count = weights.b.size, times.size
    reached = t + h
    is_last = reached >= times[count - 1] - 1e-9 * h
    if not is_last and times[first] > reached:
        return first, 0
    extra = weights.extra_c.size
    dense = weights.dense
    if stages(motion, weights.extra_a, weights.extra_c, end + 1, t, h, room) != FINE:
        dense = weights.dense[:0]
        for r in range(3, room.extension.shape[0]):
            for d in range(room.old.size):
                room.extension[r, d] = 0.0
    extend(dense, h, end, room)
    while first < count and (is_last or times[first] <= reached):
        interpolate(min((times[first] - t) / h, 1.0), room, out[first])
        first += 1
    return first, extra


@inner
def watch_extension(motion: Motion, weights: Weights, t: float, h: float, watch: Watch, room: Room) -> tuple[int, int]:
    """Whether an event happens in the step; also returns the evaluations made."""
    if watch.functions == 0:
        return FINE, 0
    look_at(watch, t, h)
    _, extra = sample(motion, weights, t, h, watch.times, watch.states, variable(0), room)
    return seen(watch, motion.degrees), extra
