"""Samples from the continuous extension of a step, so that they never shorten it."""

from __future__ import annotations

from .compiler import inline, runtime_int
from .motion import FINE, Floats, Motion
from .plan import comes_to
from .step import Weights, Workspace, stages
from .watch import Watch, check_events, set_sample_times


@inline
def extend(dense: Floats, h: float, end: int, workspace: Workspace) -> None:
    """The coefficients of a step's continuous extension: cubic Hermite interpolation, then the method's own terms.

    `dense` has shape (terms, stages); `end` is the row of the derivative at the end of the step. The coefficients go
    into `workspace.extension`.
    """
    for d in range(workspace.old.size):
        change = workspace.new[d] - workspace.old[d]
        bend = h * workspace.derivatives[0, d] - change
        workspace.extension[0, d] = change
        workspace.extension[1, d] = bend
        workspace.extension[2, d] = change - h * workspace.derivatives[end, d] - bend
        for r in range(dense.shape[0]):
            term = 0.0
            for j in range(dense.shape[1]):
                term += dense[r, j] * workspace.derivatives[j, d]
            workspace.extension[3 + r, d] = h * term


@inline
def interpolate(theta: float, workspace: Workspace, out: Floats) -> None:
    """y(t + θh) = y + θ(F₀ + (1−θ)(F₁ + θ(F₂ + (1−θ)(F₃ + …)))) into `out`, shape (width,)."""
    last = workspace.extension.shape[0] - 1
    for d in range(workspace.old.size):
        value = 0.0
        for r in range(last, -1, -1):
            value = (value + workspace.extension[r, d]) * (theta if r % 2 == 0 else 1.0 - theta)
        out[d] = workspace.old[d] + value


@inline
def sample(
    motion: Motion, weights: Weights, t: float, h: float, times: Floats, out: Floats, first: int, workspace: Workspace
) -> tuple[int, int]:
    """Samples number `first` and on, as far as they lie in the step; returns the next one and the evaluations made.

    `times` has shape (samples,), `out`, which is written, shape (samples, width).
    """
    end, count = weights.b.size, times.size
    reached = t + h
    is_last = comes_to(times[count - 1], reached)
    if not is_last and times[first] > reached:
        return first, 0
    extra = weights.extra_c.size
    dense = weights.dense
    if stages(motion, weights.extra_a, weights.extra_c, end + 1, t, h, workspace) != FINE:
        dense = weights.dense[:0]
        for r in range(3, workspace.extension.shape[0]):
            for d in range(workspace.old.size):
                workspace.extension[r, d] = 0.0
    extend(dense, h, end, workspace)
    while first < count and (is_last or times[first] <= reached):
        interpolate(min((times[first] - t) / h, 1.0), workspace, out[first])
        first += 1
    return first, extra


@inline
def watch_extension(
    motion: Motion, weights: Weights, t: float, h: float, watch: Watch, workspace: Workspace
) -> tuple[int, int]:
    """Whether an event happens in the step; also returns the evaluations made."""
    if watch.functions == 0:
        return FINE, 0
    set_sample_times(watch, t, h)
    _, extra = sample(motion, weights, t, h, watch.times, watch.states, runtime_int(0), workspace)
    return check_events(watch, motion.degrees), extra
