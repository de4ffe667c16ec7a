"""The running integral of evenly spaced samples.

Over each interval the polynomial of degree 5 through the six nearest samples is integrated, so that the error is of
order h⁶. Source: Davis, Rabinowitz, Methods of Numerical Integration, 2nd ed., §2.5 (interpolatory rules).
"""

from __future__ import annotations

import numpy as np

from ...simulation.problem import Floats

# Weights · 1440 of the six samples, for the first, the second and the middle interval between them.
WEIGHTS = np.array([[475, 1427, -798, 482, -173, 27], [-27, 637, 1022, -258, 77, -11], [11, -93, 802, 802, -93, 11]])
SIX = 6


def running_integral(values: Floats, step: float) -> Floats:
    """∫ from the first sample to each, for values of shape (samples,) that are `step` apart: shape (samples,).

    Fewer than six samples are joined by straight lines.
    """
    if len(values) < SIX:
        return np.asarray(step * np.concatenate([[0.0], np.cumsum((values[1:] + values[:-1]) / 2.0)]))
    windows = np.lib.stride_tricks.sliding_window_view(values, SIX)
    first, second, middle = WEIGHTS / 1440.0
    begin = [windows[0] @ first, windows[0] @ second]
    end = [windows[-1] @ second[::-1], windows[-1] @ first[::-1]]
    pieces = np.concatenate([begin, windows @ middle, end])
    return np.asarray(step * np.concatenate([[0.0], np.cumsum(pieces)]))
