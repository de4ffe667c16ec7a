"""What all stepping loops do alike: begin, ask whether to go on, let time pass, and tell how it went."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .compiler import inline
from .motion import CANCELLED, FINE, HELD, NOT_FINITE, STEP_LIMIT, Floats, Motion, rhs
from .plan import Plan, record
from .step_control import Control
from .switch import detect_hold_ahead
from .watch import Watch

SLIGHT = 1e-6  # a part of a step


class Result(NamedTuple):
    """How a run ended: `outcome` as in `motion`; the first `samples` rows of the samples are filled.

    `steps`, `rejected` and `evaluations` are counts, `reached` is the time in seconds.
    """

    outcome: int
    samples: int
    steps: int
    rejected: int
    evaluations: int
    reached: float


@inline
def kahan_add(t: float, h: float, compensation: float) -> tuple[float, float]:
    """t + h, and what of it is below its rounding, to be given back as `compensation` (Kahan's summation)."""
    increment = h + compensation
    new = t + increment
    return new, increment - (new - t)


@inline
def to_a_number(t: float, h: float) -> float:
    """A step of about size h from t to a number, so that samples are taken at the times that are meant.

    At t = 100 s the rounding of a time is 10⁻¹⁴ s, in which a state may change by more than its errors. A step so short
    that it would be another one is left as it is.
    """
    rounded = (t + h) - t
    return rounded if abs(rounded - h) <= SLIGHT * h else h


@inline
def advance_time(
    plan: Plan, piece: int, t: float, h: float, compensation: float, ends_piece: int
) -> tuple[float, float]:
    """The time after a step of size h, and its compensation; the end of a piece is met exactly."""
    return (plan.ends[piece], 0.0) if ends_piece != 0 else kahan_add(t, h, compensation)


@inline
def sample_at_jump(plan: Plan, piece: int, t: float, first: int, out: Floats, state: Floats) -> int:
    """The samples left where a step ends at t and a jump is all that follows it; returns the number of the next one.

    A jump has hardly any length, so that `state`, shape (width,), is that at its end, too. `out` has shape
    (samples, width).
    """
    if t < plan.ends[piece] or piece + 2 != plan.sizes.size or plan.sizes[piece + 1] > 0.0:
        return first
    for k in range(first, out.shape[0]):
        for d in range(state.size):
            out[k, d] = state[d]
    return int(out.shape[0])


@inline
def time_reached(watch: Watch, outcome: int, times: Floats, filled: int, t: float) -> float:
    """How far a run came whose last step ended at t: to where friction holds it, or to the end if no sample is missing.

    The last step may end some rounding before the end, or behind it. `times` has shape (samples,).
    """
    end = times[times.size - 1]
    if outcome == HELD:
        return float(watch.switch.when[0])
    return float(end if filled == times.size else min(t, end))


@inline
def begin(
    motion: Motion, plan: Plan, watch: Watch, t: float, state: Floats, first_derivative: Floats, out: Floats
) -> int:
    """The initial state becomes the first sample; returns the outcome.

    `state` and `first_derivative`, which is written, have shape (width,), `out` shape (samples, width). A motion may be
    held by friction from the start.
    """
    outcome = rhs(motion, t, state, first_derivative)
    for d in range(state.size):
        out[0, d] = state[d]
        if outcome == FINE and not abs(first_derivative[d]) < np.inf:
            outcome = NOT_FINITE
    record(plan, t, state)
    return detect_hold_ahead(motion, watch.switch, t, 0.0, state, first_derivative) if outcome == FINE else outcome


@inline
def interruption(control: Control, tries: int, watch: Watch) -> int:
    """Whether to stop before the next step, and why."""
    if watch.cancelled[0] != 0:
        return CANCELLED
    return STEP_LIMIT if tries >= control.step_limit else FINE
