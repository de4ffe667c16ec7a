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
from ..simulation.audit import Audit
from ..simulation.audited import audited_run
from ..simulation.integration import Flag, motion_of
from ..simulation.kernels.monodromy import Flow, Found, Survey, make_newton_workspace, survey
from ..simulation.kernels.motion import CANCELLED, FINE, STEP_UNDERFLOW
from ..simulation.kernels.plan import make_plan
from ..simulation.kernels.sight import Meshes
from ..simulation.kernels.step import make_workspace
from ..simulation.kernels.step_control import Control
from ..simulation.kernels.watch import unwatched
from ..simulation.library import get_method
from ..simulation.method import Tableau
from ..simulation.problem import Floats
from ..simulation.problem import Problem as InitialValueProblem
from ..simulation.run import Steps
from ..simulation.service import problem_of
from ..simulation.stability import real_stability
from ..simulation.weights import explicit_weights
from .engine import engine, while_wanted

METHOD = "dop853"
TOLERANCE, ROUNDED = 1e-8, 1e-14  # local: over the distance of neighbours, but not below the state's rounding
NUDGES = tuple(10.0**-k for k in range(4, 17))  # distances of neighbours
SAME = 3e-7  # of monodromy matrices by neighbours at unlike distances
UNSEEN = 1e-6  # of that distance: what moves a motion by less may be missed
STEP_LIMIT = 20_000  # in one period
ROUNDING = 1e-6  # of |μ|: central differences leave that much
CHUNK = 256  # points that are worked out at a time
PROBES = 16  # points that are looked at first
MESH = 256  # ends of steps in a period that are looked at together
AGAIN, ROUNDS = 4, 12  # of a point, and of the motion beside it, each by shorter steps


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
        start, nudge = self._prepared(flag)
        table = self._table._replace(nudge=nudge)
        parts = [part_of(table, slice(first, first + CHUNK)) for first in range(0, self.periods.size, CHUNK)]
        with engine() as executor:
            found = list(executor.map(partial(surveyed, self.problem, start, flag), parts))
        return self._read(Found(*map(np.concatenate, zip(*found, strict=True))))

    def _prepared(self, cancelled: Flag) -> tuple[Floats, float]:
        """Of the periodic states at a few points, the one nearest to the problem's own state, so that all follow it.

        And how far away neighbours are: so near that a tenth of it says the same.
        """
        own = self.problem.state[: 2 * self.problem.degrees]
        probes = part_of(self._table, np.unique(np.linspace(0, self.periods.size - 1, PROBES).astype(int)))
        tried = [surveyed(self.problem, own, cancelled, probes)]
        while len(tried) < len(NUDGES) and not (len(tried) > 1 and _agree(*tried[-2:])):
            nearer = probes._replace(nudge=NUDGES[len(tried)])
            tried.append(surveyed(self.problem, own, cancelled, nearer))
        which = max(len(tried) - 2, 0) if _agree(*tried[-2:]) else 0
        good = tried[which].states[tried[which].outcomes == FINE]
        nearest = good[np.argmin(np.linalg.norm(good - own, axis=1))] if len(good) else own
        return nearest, NUDGES[which]

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
        periods = np.ascontiguousarray(self.periods).ravel()
        return Survey(self._input(self.first), self._input(self.second), grid, periods, periods, NUDGES[0])

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


def part_of(table: Survey, places: slice | NDArray[np.int_]) -> Survey:
    """Some rows of a table, by their numbers: shape (rows,)."""
    values, periods = (np.ascontiguousarray(each[places]) for each in (table.values, table.periods))
    return table._replace(values=values, periods=periods, steps=periods)


def _agree(one: Found, other: Found) -> bool:
    """Whether monodromy matrices say the same, wherever both have some, and somewhere they have."""
    both = (one.outcomes == FINE) & (other.outcomes == FINE)
    apart, sizes = np.abs(one.matrices - other.matrices)[both], np.maximum(1.0, np.abs(other.matrices[both]))
    return bool(both.any() and (apart <= SAME * sizes).all())


def surveyed(problem: InitialValueProblem, start: Floats, cancelled: Flag, table: Survey) -> Found:
    """Periodic states and monodromy matrices for the rows of a table.

    Each is looked for from the state `start`, shape (2n,). Where steps may have passed over what the forces do within a
    period they are taken again, shorter.
    """
    longest = replace(problem, t_end=float(table.periods.max()))
    found, meshes = _surveyed(longest, start, cancelled, table)
    watcher, places = Audit(longest, get_method(METHOD)).watcher(MESH), np.flatnonzero(found.outcomes == FINE)
    parameters = _parameters(problem, table)
    kept = places[meshes.counts[places] > 0]
    blind = kept[watcher.blind(meshes, parameters, kept, UNSEEN * table.nudge)]
    for place in np.union1d(blind, places[meshes.counts[places] == 0]).tolist():
        _look_again(replace(problem, parameters=tuple(parameters[place].tolist())), cancelled, table, place, found)
    return found


def _surveyed(problem: InitialValueProblem, start: Floats, cancelled: Flag, table: Survey) -> tuple[Found, Meshes]:
    """What steps find that are bounded as the table says, and where those beside the periodic motions end."""
    scheme = get_method(METHOD).scheme
    if not isinstance(scheme, Tableau):
        raise TypeError("the survey steps by an explicit Runge–Kutta method")
    weights, width, count = explicit_weights(scheme), 2 * problem.degrees, table.periods.size
    plan = make_plan(np.array([problem.t_end]), np.array([problem.t_end]), width, MESH)
    floor = ROUNDED * max(1e-300, float(np.abs(start).max()))
    tolerance = max(TOLERANCE * table.nudge, floor)
    control = Control(tolerance, problem.t_end, 8.0, 0.0, STEP_LIMIT, scheme.stages, real_stability(scheme), plan)
    motion, workspace = motion_of(problem)._replace(is_powered=False), make_workspace(start.copy(), weights)
    outcomes, counts = np.full(count, CANCELLED, dtype=np.int64), np.zeros(count, dtype=np.int64)
    found = Found(np.zeros((count, width)), np.zeros((count, width, width)), outcomes)
    meshes = Meshes(np.zeros((count, MESH, width + 1)), counts)
    with while_wanted(cancelled) as flag:
        flow = Flow(
            motion, weights, control, unwatched(flag), workspace, np.zeros(2), np.zeros((2, width)), table.nudge
        )
        survey(flow, start, table, (0, count), found, make_newton_workspace(width), meshes)
    return found, meshes


def _parameters(problem: InitialValueProblem, table: Survey) -> Floats:
    """Those of each row of a table: shape (points, parameters)."""
    found, first = np.tile(np.array(problem.parameters), (table.periods.size, 1)), 2 * problem.degrees + 1
    found[:, [table.first - first, table.second - first]] = table.values
    return found


def _look_again(problem: InitialValueProblem, cancelled: Flag, table: Survey, place: int, found: Found) -> None:
    """Puts right what is found at one point, by steps that see all that is met there; without an outcome if none do."""
    period, n, method = float(table.periods[place]), problem.degrees, get_method(METHOD)
    row = part_of(table, np.array([place]))
    for _ in range(AGAIN):
        state = found.states[place] + table.nudge
        beside = replace(problem, values=tuple(state[:n].tolist()), rates=tuple(state[n:].tolist()), t_end=period)
        steps = Steps(float(row.steps[0]), TOLERANCE)
        run, blind = audited_run(
            beside, method, np.array([0.0, period]), steps, UNSEEN * table.nudge, cancelled, ROUNDS
        )
        needed = float(min(run.steps.pieces.largest)) if run.steps.pieces else np.inf
        if not blind and needed >= row.steps[0]:
            return
        if blind:
            break
        row = row._replace(steps=np.array([needed]))
        again, _ = _surveyed(beside, found.states[place].copy(), cancelled, row)
        found.states[place], found.matrices[place], found.outcomes[place] = (each[0] for each in again)
        if found.outcomes[place] != FINE:
            return
    found.outcomes[place] = STEP_UNDERFLOW


def warm() -> None:
    """Compiles the survey's kernel, or loads it from the cache on disk."""
    problem = problem_of(load_scene("kapitza"), 1.0)
    Plane(problem, Axis("omega", (60.0,)), Axis("y0", (0.07,)), np.full((1, 1), 0.1)).map()
