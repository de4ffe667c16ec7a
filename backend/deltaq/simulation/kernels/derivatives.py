"""The right-hand side at many states."""

from __future__ import annotations

import numpy as np

from .compiler import kernel
from .motion import FINE, Floats, Motion, rhs


@kernel
def evaluate_rhs(motion: Motion, times: Floats, states: Floats, out: Floats) -> None:
    """The right-hand side at many states; zero where M has no inverse or a number is not finite.

    `times` has shape (states,), `states` shape (states, ≥ 2n), `out`, which is written, shape (states, width).
    """
    for i in range(times.size):
        good = rhs(motion, times[i], states[i], out[i]) == FINE
        for d in range(out.shape[1]):
            good = good and abs(out[i, d]) < np.inf
        if not good:
            out[i] = 0.0
