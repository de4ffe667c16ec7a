"""Room for numbers that vectors are read from, and written to."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

LINE = 64  # bytes of a line of a processor's cache


def aligned(*shape: int) -> NDArray[np.float64]:
    """Zeros, shape (…) as given, that begin a line of the processor's cache: no vector lies in two of them."""
    count = math.prod(shape)
    room = np.zeros(count + LINE // 8)
    first = -room.ctypes.data % LINE // 8
    return room[first : first + count].reshape(shape)
