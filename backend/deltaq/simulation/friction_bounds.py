"""What friction must not do along a motion: drive what slips, or hold less than it brakes."""

from __future__ import annotations

import numpy as np

from .mode_state import ModeState
from .transitions import BoundError

SOON = 1e-6  # of the span
AT_ONCE = 1e-6  # of a change soon: what is as close to zero is there now
SAME = 1e-12  # of a force
STILL = 1e-9  # a rate, relative to the largest


def require_opposing(current: ModeState) -> None:
    """Raises BoundError where a friction force is at zero and about to be negative.

    What happens at the same time, such as a slip since nothing holds any longer, happens no more.
    """
    modes = current.modes
    if not modes.bounds:
        return
    a, near = current.accelerations, SOON * current.problem.t_end
    soon = current.at(current.time + near, current.q + near * (current.v + 0.5 * near * a), current.v + near * a)
    offsets = current.mode.offsets[modes.first_bound :]
    here, there = (each.watched[modes.first_bound :] - offsets for each in (current, soon))
    for k, now, then in zip(modes.bounds, here.tolist(), there.tolist(), strict=True):
        if then < 0.0 and now <= AT_ONCE * -then:
            raise BoundError(k, drives=True)


def require_holding(current: ModeState) -> None:
    """Raises BoundError where a friction that does not slip could hold less than it slips with."""
    modes = current.modes
    count = len(modes.frictions)
    if not count:
        return
    facts = current.facts
    still = [k for k in range(count) if current.mode.flags[k] or abs(facts.w[k]) <= STILL * current.rate_along(k)]
    if not still:
        return
    loose = current.with_flags((0.0,) * modes.rows)
    slipping = np.abs(modes.facts.at(loose.row)[-count:])
    for k in still:
        if facts.limits[k] < slipping[k] * (1.0 - SAME):
            raise BoundError(k, drives=False)
