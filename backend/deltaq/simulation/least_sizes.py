"""What places and rates of a scene count as, at least: what is small beside them is rounding."""

from __future__ import annotations

import math
from contextlib import suppress

import numpy as np

from .mode_state import ModeState
from .problem import Floats

ROOMY = 1e3  # of what a scene's places and rates are at first: what they may become


def least_sizes(current: ModeState) -> tuple[Floats, Floats]:
    """What places and rates count as, at least, at this start, by coordinate: 1, or less if all is smaller or slower.

    Where it is, and how fast it may become over its span or by what accelerates it, tell. Angles count by a radian.
    Both have shape (n,).
    """
    n, span, pull = len(current.q), current.problem.t_end, np.zeros(len(current.q))
    with suppress(np.linalg.LinAlgError):  # without an inverse of M nothing is known; the run tells it
        pull = current.shared(current.accelerations)
    speed = current.shared(current.v)
    place = current.shared(np.where(current.problem.angular or (False,) * n, 1.0, current.q))
    with np.errstate(over="ignore", invalid="ignore"):
        place = next((each for each in (place, speed * span, pull * span * span) if each.any()), place)
        rate = np.maximum(np.maximum(speed, place / span), np.sqrt(pull * place))
    return _at_most_one(place), _at_most_one(rate)


def _at_most_one(sizes: Floats) -> Floats:
    """What these sizes, shape (n,), may become, up to 1; 1 where they are not known."""
    is_known = (sizes > 0.0) & (sizes < math.inf)
    return np.minimum(1.0, np.where(is_known, ROOMY * sizes, 1.0))
