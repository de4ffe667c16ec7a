"""The region of stability of a method as lines in the complex plane of z = hλ.

Source: Hairer, Wanner, Solving Ordinary Differential Equations II, IV.2.
"""

from __future__ import annotations

import numpy as np
from contourpy import contour_generator

from ..simulation.method import Method
from ..simulation.stability import growth
from .report import rounded

REAL, IMAGINARY, FINE = (-8.0, 4.0), 6.5, 240  # the window, and the intervals on its sides
ASIDE = 1e-7 * (1 + 1j)  # a grid that misses the poles
SPECK = 8  # lines of fewer points are artefacts of the grid


def region(method: Method) -> list[list[list[float]]]:
    """The boundary |R(z)| = 1: closed or open lines [[x, y], …], in both half planes."""
    x, y = np.linspace(*REAL, FINE + 1), np.linspace(-IMAGINARY, IMAGINARY, FINE + 1)
    sizes = np.nan_to_num(growth(method.scheme, x + 1j * y[:, None] + ASIDE), nan=2.0, posinf=2.0)
    lines = contour_generator(x, y, np.minimum(sizes, 2.0)).lines(1.0)
    return [[rounded(point, 4) for point in np.asarray(line)] for line in lines if len(line) > SPECK]
