"""A trusted motion: two unlike methods of high order that agree, one explicit and one implicit and symplectic.

Their formulas, error controls and kernels have nothing in common but the model, so that they do not err alike; the
larger of their difference and of what rounding leaves is the reference's own error.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..errors import Problem as Mistake
from ..errors import RequestError
from .driver import simulate
from .library import get_method
from .problem import Floats, Problem
from .trajectory import Trajectory

METHODS = ("dop853", "gauss-6")
TOLERANCE = 1e-13


@dataclass(frozen=True)
class Reference:
    """The coordinates as far as both methods came: `values`, shape (samples, n), at `times`, shape (samples,).

    `errors`, shape (samples,), bounds each sample.
    """

    times: Floats
    values: Floats
    errors: Floats
    methods: tuple[str, str]

    def errors_of(self, trajectory: Trajectory) -> Floats:
        """The largest error of any coordinate at each sample that both have: shape (samples,)."""
        count = min(len(self.times), len(trajectory.times))
        return np.asarray(np.abs(trajectory.values[:count] - self.values[:count]).max(axis=1))


def reference(problem: Problem) -> Reference:
    """The reference of a problem at its samples. RequestError if it cannot be followed even to the second of them."""
    first, second = (simulate(problem, get_method(name), tolerance=TOLERANCE) for name in METHODS)
    count = min(len(first.times), len(second.times))
    require_motion(first.times[:count])
    apart = np.abs(first.values[:count] - second.values[:count]).max(axis=1)
    size = np.maximum(1.0, np.abs(first.values[:count]).max(axis=1))
    floor = np.finfo(np.float64).eps * size
    return Reference(first.times[:count], first.values[:count], np.maximum.accumulate(apart) + floor, METHODS)


def require_motion(times: Floats, size: float = 1.0) -> None:
    """Raises RequestError if a motion has no sample after its start, or no finite size: nothing can be told of it.

    `times` has shape (samples,).
    """
    if len(times) < 2 or not np.isfinite(size):
        raise RequestError(Mistake("no-motion"))
