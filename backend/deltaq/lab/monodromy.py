"""Stability of periodic motions over a plane of two parameters, by Floquet's theorem.

A small deviation from a periodic motion is multiplied each period by the monodromy matrix. Its eigenvalues are the
Floquet multipliers μ: the motion is unstable if any |μ| > 1. A scene without damping has multipliers in pairs μ, 1/μ,
so it is stable at best with all |μ| = 1.
Source: Floquet (1883); Landau, Lifshitz, Mechanics, §27 and §30; Seydel, Practical Bifurcation Analysis, ch. 7.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np
from numpy.typing import NDArray

from ..mechanics.library import load_scene
from ..simulation.integration import Flag, explicit_weights, motion_of
from ..simulation.kernels.monodromy import Flow, Found, Survey, make_newton_workspace, survey
from ..simulation.kernels.motion import CANCELLED, FINE
from ..simulation.kernels.plan import make_plan
from ..simulation.kernels.step import make_workspace
from ..simulation.kernels.step_control import Control
from ..simulation.kernels.watch import unwatched
from ..simulation.library import get_method
from ..simulation.method import Tableau
from ..simulation.problem import Floats
from ..simulation.problem import Problem as InitialValueProblem
from ..simulation.service import problem_of
from ..simulation.stability import real_stability
from .engine import engine, while_wanted

METHOD = "dop853"
TOLERANCE = 1e-12
STEP_LIMIT = 20_000  # in one period
ROUNDING = 1e-6  # of |μ|: central differences leave that much
CHUNK = 256  # points that are worked out at a time
PROBES = 16  # points that are looked at first


@dataclass(frozen=True)
class Axis:
    """One side of the map: a parameter and its values."""

    parameter: str
    values: tuple[float, ...]


@dataclass(frozen=True)
class StabilityMap:
    """For every point of the map the largest |μ| as `growth`, NaN where there is no periodic motion nearby.

    It has shape (second, first), by the axes; `states` are the periodic states (q, q̇) at the start of the period and
    `multipliers` all μ, shape (second, first, 2n).
    """

    first: Axis
    second: Axis
    growth: Floats
    states: Floats
    multipliers: NDArray[np.complex128]

    @property
    def is_stable(self) -> NDArray[np.bool_]:
        """Whether no |μ| exceeds 1: shape (second, first)."""
        return np.asarray(self.growth <= 1.0 + ROUNDING)


@dataclass(frozen=True)
class Plane:
    """The parameter plane of a problem, with the period in seconds at each of its points.

    `periods` has shape (second, first), by the axes.
    """

    problem: InitialValueProblem
    first: Axis
    second: Axis
    periods: Floats

    def map(self, cancelled: Flag | None = None) -> StabilityMap:
        """Every point, on all processors."""
        flag = np.zeros(1, dtype=np.int64) if cancelled is None else cancelled
        start = self._nearest(flag)
        parts = [self._part(slice(first, first + CHUNK)) for first in range(0, self.periods.size, CHUNK)]
        with engine() as executor:
            found = list(executor.map(partial(surveyed, self.problem, start, flag), parts))
        return self._read(Found(*map(np.concatenate, zip(*found, strict=True))))

    def _nearest(self, cancelled: Flag) -> Floats:
        """Of the periodic states at a few points, the one nearest to the problem's own state, so that all follow it."""
        own = self.problem.state[: 2 * self.problem.degrees]
        places = np.unique(np.linspace(0, self.periods.size - 1, PROBES).astype(int))
        found = surveyed(self.problem, own, cancelled, self._part(places))
        good = found.states[found.outcomes == FINE]
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

    def _part(self, places: slice | NDArray[np.int_]) -> Survey:
        """Some rows of the table."""
        values, periods = self._table.values[places], self._table.periods[places]
        return self._table._replace(values=np.ascontiguousarray(values), periods=np.ascontiguousarray(periods))

    def _input(self, axis: Axis) -> int:
        """The place of the parameter among the inputs of the model."""
        return 2 * self.problem.degrees + 1 + self.problem.model.layout.parameters.index(axis.parameter)

    def _read(self, found: Found) -> StabilityMap:
        matrices = np.where(found.outcomes[:, None, None] == FINE, found.matrices, 0.0)
        multipliers = np.linalg.eigvals(matrices).astype(np.complex128)
        growth = np.where(found.outcomes == FINE, np.abs(multipliers).max(axis=1), np.nan)
        shape, width = self.periods.shape, 2 * self.problem.degrees
        states, roots = found.states.reshape(*shape, width), multipliers.reshape(*shape, width)
        return StabilityMap(self.first, self.second, growth.reshape(shape), states, roots)


def surveyed(problem: InitialValueProblem, start: Floats, cancelled: Flag, table: Survey) -> Found:
    """Periodic states and monodromy matrices for the rows of a table.

    Each is looked for from the state `start`, shape (2n,).
    """
    scheme = get_method(METHOD).tableau
    if not isinstance(scheme, Tableau):
        raise TypeError("the survey steps by an explicit Runge–Kutta method")
    weights, width, count = explicit_weights(scheme), 2 * problem.degrees, table.periods.size
    longest = float(table.periods.max())
    plan = make_plan(np.array([longest]), np.array([longest]), width)
    control = Control(TOLERANCE, longest, 8.0, 0.0, STEP_LIMIT, scheme.stages, real_stability(scheme), plan)
    motion, workspace = motion_of(problem)._replace(is_powered=False), make_workspace(start.copy(), weights)
    outcomes = np.full(count, CANCELLED, dtype=np.int64)
    found = Found(np.zeros((count, width)), np.zeros((count, width, width)), outcomes)
    with while_wanted(cancelled) as flag:
        flow = Flow(motion, weights, control, unwatched(flag), workspace, np.zeros(2), np.zeros((2, width)))
        survey(flow, start, table, (0, count), found, make_newton_workspace(width))
    return found


def warm() -> None:
    """Compiles the survey's kernel, or loads it from the cache on disk."""
    problem = problem_of(load_scene("kapitza"), 1.0)
    Plane(problem, Axis("omega", (60.0,)), Axis("y0", (0.07,)), np.full((1, 1), 0.1)).map()
