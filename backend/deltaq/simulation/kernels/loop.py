"""What all stepping loops do alike: begin, ask whether to go on, let time pass, and tell how it went."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .compiler import inner
from .motion import CANCELLED, FINE, NOT_FINITE, STEP_LIMIT, Floats, Motion, slope
from .plan import Plan, record
from .step_control import Control
from .switch import hold_ahead
from .watch import Watch


class Result(NamedTuple):
    """`outcome` as in `motion`; the first `samples` rows of the samples are filled."""

    outcome: int
    samples: int
    steps: int
    rejected: int
    evaluations: int
    reached: float


@inner
def later(t: float, h: float, lost: float) -> tuple[float, float]:
    """t + h, and what of it is below its rounding, to be given back as `lost` (Kahan's summation)."""
    tick = h + lost
    new = t + tick
    return new, tick - (new - t)


@inner
def passed(plan: Plan, piece: int, t: float, h: float, lost: float, ends_piece: int) -> tuple[float, float]:
    """The time after a step of size h, and what of it is below its rounding; the end of a piece is met exactly."""
    return (plan.ends[piece], 0.0) if ends_piece != 0 else later(t, h, lost)


@inner
def begin(motion: Motion, plan: Plan, watch: Watch, t: float, state: Floats, first_slope: Floats, out: Floats) -> int:
    """The initial state becomes the first sample, `first_slope` its slope; returns how it went.

    A motion may be held by friction from the start.
    """
    outcome = slope(motion, t, state, first_slope)
    for d in range(state.size):
        out[0, d] = state[d]
        if outcome == FINE and not abs(first_slope[d]) < np.inf:
            outcome = NOT_FINITE
    record(plan, t, state)
    return hold_ahead(motion, watch.switch, t, 0.0, state, first_slope) if outcome == FINE else outcome


@inner
def interruption(control: Control, tries: int, watch: Watch) -> int:
    """Whether to stop before the next step, and why."""
    if watch.cancelled[0] != 0:
        return CANCELLED
    return STEP_LIMIT if tries >= control.step_limit else FINE
