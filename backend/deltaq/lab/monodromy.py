"""Stability of periodic motions over a plane of two parameters, by Floquet's theorem.

A small deviation from a periodic motion is multiplied each period by the monodromy matrix. Its eigenvalues are the
Floquet multipliers μ: the motion is unstable if any |μ| > 1. A scene without damping has multipliers in pairs μ, 1/μ,
so it is stable at best with all |μ| = 1.
Source: Floquet (1883); Landau, Lifshitz, Mechanics, §27 and §30; Seydel, Practical Bifurcation Analysis, ch. 7.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..mechanics.library import load_scene
from ..simulation.integration import Flag, explicit_weights, motion_of
from ..simulation.kernels.monodromy import Flow, Found, Survey, make_desk, survey
from ..simulation.kernels.motion import CANCELLED, FINE
from ..simulation.kernels.step import make_room
from ..simulation.kernels.step_control import Control
from ..simulation.kernels.watch import unwatched
from ..simulation.library import get_method
from ..simulation.method import Tableau
from ..simulation.problem import Floats
from ..simulation.problem import Problem as InitialValueProblem
from ..simulation.service import problem_of
from ..simulation.stability import real_stability

METHOD = "dop853"
TOLERANCE = 1e-12
STEP_LIMIT = 20_000  # in one period
ROUNDING = 1e-6  # of |μ|: central differences leave that much
CHUNK = 256  # points that a thread takes at once
PROBES = 16  # points that are looked at first


@dataclass(frozen=True)
class Axis:
    """One side of the map: a parameter and its values."""

    parameter: str
    values: tuple[float, ...]


@dataclass(frozen=True)
class StabilityMap:
    """For every point (second axis, first axis): the largest |μ|, NaN where there is no periodic motion nearby.

    `states` are the periodic states (q, q̇) at the start of the period, `multipliers` all μ.
    """

    first: Axis
    second: Axis
    growth: Floats
    states: Floats
    multipliers: NDArray[np.complex128]

    @property
    def is_stable(self) -> NDArray[np.bool_]:
        return np.asarray(self.growth <= 1.0 + ROUNDING)


@dataclass(frozen=True)
class Plane:
    """The parameter plane of a problem, with the period at each of its points (second axis, first axis)."""

    problem: InitialValueProblem
    first: Axis
    second: Axis
    periods: Floats

    def map(self, cancelled: Flag | None = None) -> StabilityMap:
        """Every point, on all processors."""
        flag = np.zeros(1, dtype=np.int64) if cancelled is None else cancelled
        found, count = self._room, self._table.periods.size
        spans = [(start, min(start + CHUNK, count)) for start in range(0, count, CHUNK)]
        start = self._nearest(found, flag)
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            list(pool.map(lambda span: self._fill(span, start, found, flag), spans))
        return self._read(found)

    def _nearest(self, found: Found, cancelled: Flag) -> Floats:
        """Of the periodic states at a few points, the one nearest to the problem's own state, so that all follow it."""
        own = self.problem.state[: 2 * self.problem.degrees]
        places = np.unique(np.linspace(0, len(found.outcomes) - 1, PROBES).astype(int))
        for place in places:
            self._fill((int(place), int(place) + 1), own, found, cancelled)
        good = found.states[places][found.outcomes[places] == FINE]
        return good[np.argmin(np.linalg.norm(good - own, axis=1))] if len(good) else own

    def refined(self, cancelled: Flag | None = None, coarsest: int = 8) -> Iterator[StabilityMap]:
        """The map with every 8th, every 4th, every second point of both axes, and all of them."""
        stride = coarsest
        while stride >= 1:
            first, second = (replace(axis, values=axis.values[::stride]) for axis in (self.first, self.second))
            yield replace(self, first=first, second=second, periods=self.periods[::stride, ::stride]).map(cancelled)
            stride //= 2

    @cached_property
    def _table(self) -> Survey:
        grid = np.array([(a, b) for b in self.second.values for a in self.first.values])
        return Survey(
            self._input(self.first), self._input(self.second), grid, np.ascontiguousarray(self.periods).ravel()
        )

    def _input(self, axis: Axis) -> int:
        """The place of the parameter among the inputs of the model."""
        return 2 * self.problem.degrees + 1 + self.problem.model.layout.parameters.index(axis.parameter)

    @property
    def _room(self) -> Found:
        count, width = self.periods.size, 2 * self.problem.degrees
        outcomes = np.full(count, CANCELLED, dtype=np.int64)
        return Found(np.zeros((count, width)), np.zeros((count, width, width)), outcomes)

    def _fill(self, span: tuple[int, int], start: Floats, found: Found, cancelled: Flag) -> None:
        """Some points of the table; each thread has its own arrays."""
        scheme = get_method(METHOD).tableau
        if not isinstance(scheme, Tableau):
            raise TypeError("the survey steps by an explicit Runge–Kutta method")
        weights, width = explicit_weights(scheme), 2 * self.problem.degrees
        motion = motion_of(self.problem)._replace(is_powered=False)
        longest = float(self.periods.max())
        control = Control(TOLERANCE, longest, longest, 8.0, 0.0, STEP_LIMIT, scheme.stages, real_stability(scheme))
        room = make_room(start.copy(), weights)
        flow = Flow(motion, weights, control, unwatched(cancelled), room, np.zeros(2), np.zeros((2, width)))
        survey(flow, start, self._table, span, found, make_desk(width))

    def _read(self, found: Found) -> StabilityMap:
        matrices = np.where(found.outcomes[:, None, None] == FINE, found.matrices, 0.0)
        multipliers = np.linalg.eigvals(matrices).astype(np.complex128)
        growth = np.where(found.outcomes == FINE, np.abs(multipliers).max(axis=1), np.nan)
        shape, width = self.periods.shape, 2 * self.problem.degrees
        states, roots = found.states.reshape(*shape, width), multipliers.reshape(*shape, width)
        return StabilityMap(self.first, self.second, growth.reshape(shape), states, roots)


def warm() -> None:
    """Compiles the survey's kernel, or loads it from the cache on disk."""
    problem = problem_of(load_scene("kapitza"), 1.0)
    Plane(problem, Axis("omega", (60.0,)), Axis("y0", (0.07,)), np.full((1, 1), 0.1)).map()
