"""What the numbers of a model's inputs and outputs are."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


class MotionPlaces(NamedTuple):
    """Where M, f, A (row by row) and γ stand among the outputs of `Model.motion`.

    `mass` has shape (n, n); `triangle` are the row and the column of each entry of M, shape (entries,) each.
    """

    triangle: tuple[NDArray[np.intp], NDArray[np.intp]]
    mass: NDArray[np.intp]
    forces: slice
    rows: slice
    gamma: slice


@dataclass(frozen=True)
class Layout:
    """What the numbers of a model's inputs and outputs are.

    Inputs of both functions: q, q̇ (of the free coordinates), t, parameters.
    """

    free: tuple[str, ...]
    guided: tuple[str, ...]
    parameters: tuple[str, ...]
    places: tuple[str, ...]
    arrows: tuple[str, ...]
    dimension: int
    is_powered: bool
    switches: tuple[str, ...] = ()  # whose rates the switching functions are made of, by function
    multipliers: tuple[str, ...] = ()  # by constraint, the holonomic ones first
    holonomic: int = 0  # how many of the constraints are
    constraints: tuple[int, ...] = ()  # their places in the scene

    @cached_property
    def degrees(self) -> int:
        """The number of free coordinates n; where there are constraints, fewer of them are independent."""
        return len(self.free)

    @property
    def is_holonomic(self) -> bool:
        """Whether all constraints are equations between positions; so it is without any."""
        return self.holonomic == len(self.multipliers)

    @cached_property
    def motion(self) -> MotionPlaces:
        """Where to find what is said of it: the lower triangle of M row by row, f, what power takes, A, γ."""
        n, m = self.degrees, len(self.multipliers)
        size = n * (n + 1) // 2
        first = size + n + (n + 1 if self.is_powered else 0)
        lower, right = np.tril_indices(n)
        mass = np.zeros((n, n), dtype=np.intp)
        mass[lower, right] = mass[right, lower] = np.arange(size)
        behind = first + m * n
        forces, rows, gamma = slice(size, size + n), slice(first, behind), slice(behind, behind + m)
        return MotionPlaces((lower, right), mass, forces, rows, gamma)
