"""A trusted motion: two unlike methods of high order that agree, one explicit and one implicit and symplectic.

Their formulas, error controls and kernels have nothing in common but the model, so that they do not err alike; the
larger of their difference and of what rounding leaves is the reference's own error.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..errors import Problem as Mistake
from ..errors import RequestError
from .driver import simulate
from .library import get_method
from .problem import Floats, Problem
from .trajectory import Trajectory

Indices = NDArray[np.intp]
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
        """The largest error of any coordinate at each time that both have once: shape (common,)."""
        own, other = self.common(trajectory.times)
        return np.asarray(np.abs(trajectory.values[other] - self.values[own]).max(axis=1))

    def common(self, times: Floats) -> tuple[Indices, Indices]:
        """Where the times that both have once stand here and in `times`, shape (samples,): shape (common,) each.

        A motion that goes on behind events has their times twice, and another motion has others.
        """
        return _common(self.times, times)


def reference(problem: Problem) -> Reference:
    """The reference of a problem at its samples. RequestError if it cannot be followed even to the second of them."""
    first, second = (simulate(problem, get_method(name), tolerance=TOLERANCE) for name in METHODS)
    one, other = _common(first.times, second.times)
    times, values = first.times[one], first.values[one]
    require_motion(times)
    apart = np.abs(values - second.values[other]).max(axis=1)
    size = np.maximum(1.0, np.abs(values).max(axis=1))
    floor = np.finfo(np.float64).eps * size
    return Reference(times, values, np.maximum.accumulate(apart) + floor, METHODS)


def _common(one: Floats, other: Floats) -> tuple[Indices, Indices]:
    """Where the times stand that both have, and each once."""
    (here, first), (there, second) = (_single(times) for times in (one, other))
    _, i, j = np.intersect1d(here, there, assume_unique=True, return_indices=True)
    return first[i], second[j]


def _single(times: Floats) -> tuple[Floats, Indices]:
    """The times that stand once, and where."""
    found, at, counts = np.unique(times, return_index=True, return_counts=True)
    return found[counts == 1], at[counts == 1]


def require_motion(times: Floats, size: float = 1.0) -> None:
    """Raises RequestError if a motion has no sample after its start, or no finite size: nothing can be told of it.

    `times` has shape (samples,).
    """
    if len(times) < 2 or not np.isfinite(size):
        raise RequestError(Mistake("no-motion"))
