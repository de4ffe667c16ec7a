"""The right-hand side at many states."""

from __future__ import annotations

import numpy as np

from .compiler import kernel
from .motion import FINE, Floats, Motion, slope


@kernel
def evaluate(motion: Motion, times: Floats, states: Floats, out: Floats) -> None:
    """d/dt of each row of states into the same row of `out`; zero where M has no inverse or a number is not finite."""
    for i in range(times.size):
        good = slope(motion, times[i], states[i], out[i]) == FINE
        for d in range(out.shape[1]):
            good = good and abs(out[i, d]) < np.inf
        if not good:
            out[i] = 0.0
