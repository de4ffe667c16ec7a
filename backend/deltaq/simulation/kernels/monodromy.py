"""Monodromy matrices over a table of parameter values: how a small deviation looks one period later.

Each column is the central difference of the motion through y ± d eⱼ after one period. Where the state is not periodic,
Newton's method first moves it onto the periodic motion nearby: (Φ − 1) Δy = y − y(T).
Source: Hairer, Lubich, Wanner, Geometric Numerical Integration, XI; Seydel, Practical Bifurcation Analysis, §7.3.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .compiler import inline, kernel, runtime_int, subroutine
from .explicit_runge_kutta import integrate
from .linear import decompose, substitute
from .motion import CANCELLED, FINE, Floats, Motion
from .plan import COUNT, STRIDE, start_record
from .sight import Meshes
from .step import Weights, Workspace
from .step_control import Control
from .watch import Watch

PASSES, CLOSE = 12, 1e-5  # how near a state is to where it was a period before, over the distance of neighbours
LONGEST_MOVE = 0.5  # in one pass
NOT_PERIODIC = 100


class Survey(NamedTuple):
    """What is varied: inputs number `first` and `second` of the motion, and the period of each point.

    Neighbours are a `nudge` away. `values` has shape (points, 2), `periods` and `steps`, which none is longer than,
    shape (points,), in seconds.
    """

    first: int
    second: int
    values: Floats
    periods: Floats
    steps: Floats
    nudge: float


class Found(NamedTuple):
    """Per point the periodic state, the monodromy matrix at it, and the outcome.

    `states` has shape (points, 2n), `matrices` shape (points, 2n, 2n), `outcomes` shape (points,).
    """

    states: Floats
    matrices: Floats
    outcomes: NDArray[np.int64]


class Flow(NamedTuple):
    """What it takes to follow the motion from `times[0]` to `times[1]`; out[1] becomes the state there.

    `times` has shape (2,), `out` shape (2, 2n). `watch` is for being cancelled only. Neighbours are a `nudge` away.
    """

    motion: Motion
    weights: Weights
    control: Control
    watch: Watch
    workspace: Workspace
    times: Floats
    out: Floats
    nudge: float


class NewtonWorkspace(NamedTuple):
    """The arrays to solve (Φ − 1) Δy = y − y(T) in.

    `system` has shape (2n, 2n), `gap` (the right side, then Δy) and `pivots` shape (2n,).
    """

    system: Floats
    gap: Floats
    pivots: NDArray[np.int64]


def make_newton_workspace(width: int) -> NewtonWorkspace:
    """The workspace for states with `width` components."""
    return NewtonWorkspace(np.zeros((width, width)), np.zeros(width), np.zeros(width, dtype=np.int64))


@kernel
def survey(
    flow: Flow,
    start: Floats,
    table: Survey,
    span: tuple[int, int],
    found: Found,
    newton: NewtonWorkspace,
    meshes: Meshes,
) -> int:
    """Fills the points span[0] … span[1] − 1 of `found`, and of `meshes`; FINE or CANCELLED.

    Each begins at the periodic state of the point before, if there is one, else at the state `start`, shape (2n,).
    """
    near = False
    for point in range(span[0], span[1]):
        if flow.watch.cancelled[0] != 0:
            return CANCELLED
        flow.motion.inputs[table.first] = table.values[point, 0]
        flow.motion.inputs[table.second] = table.values[point, 1]
        flow.times[1] = table.periods[point]
        flow.control.plan.sizes[0] = table.steps[point]
        state = found.states[point]
        for d in range(start.size):
            state[d] = found.states[point - 1, d] if near else start[d]
        found.outcomes[point] = periodic(flow, state, found.matrices[point], newton)
        near = found.outcomes[point] == FINE
        if near:
            trace(flow, state, point, newton, meshes)
    return FINE


@inline
def trace(flow: Flow, state: Floats, point: int, newton: NewtonWorkspace, meshes: Meshes) -> None:
    """Keeps where the steps end of a motion from beside a periodic state, shape (2n,), as a point's mesh.

    All components are a nudge away, as those are from which derivatives come: at rest many forces are nothing. Of more
    steps than there is room for none are kept.
    """
    plan = flow.control.plan
    for d in range(state.size):
        newton.gap[d] = state[d] + flow.nudge
    meshes.counts[point] = 0
    if follow(flow, newton.gap, runtime_int(0), 0.0) == FINE and plan.progress[STRIDE] == 1:
        meshes.counts[point] = plan.progress[COUNT]
        for k in range(plan.progress[COUNT]):
            meshes.rows[point, k, state.size] = plan.times[k]
            for d in range(state.size):
                meshes.rows[point, k, d] = plan.states[k, d]


@inline
def periodic(flow: Flow, state: Floats, matrix: Floats, newton: NewtonWorkspace) -> int:
    """Moves the state, shape (2n,), onto a periodic motion by Newton's method; returns the outcome.

    `matrix`, shape (2n, 2n), becomes the monodromy matrix there.
    """
    for _ in range(PASSES):
        outcome = follow(flow, state, runtime_int(0), 0.0)
        if outcome != FINE:
            return outcome
        distance = 0.0
        for d in range(state.size):
            newton.gap[d] = flow.out[1, d] - state[d]
            distance = max(distance, abs(newton.gap[d]))
        outcome = columns(flow, state, matrix)
        if outcome != FINE or distance < CLOSE * flow.nudge:
            return outcome
        for i in range(state.size):
            for j in range(state.size):
                newton.system[i, j] = (1.0 if i == j else 0.0) - matrix[i, j]
        if not decompose(newton.system, newton.pivots):
            return NOT_PERIODIC
        substitute(newton.system, newton.pivots, newton.gap)
        longest = LONGEST_MOVE
        for d in range(state.size):
            longest = max(longest, abs(newton.gap[d]))
        part = LONGEST_MOVE / longest  # to the motion nearby, not to one far off
        for d in range(state.size):
            state[d] += part * newton.gap[d]
    return NOT_PERIODIC


@inline
def columns(flow: Flow, state: Floats, matrix: Floats) -> int:
    """The monodromy matrix, shape (2n, 2n), at a state of shape (2n,), by central differences; returns the outcome."""
    for j in range(state.size):
        for sign in (1.0, -1.0):
            outcome = follow(flow, state, j, sign * flow.nudge)
            if outcome != FINE:
                return outcome
            for i in range(state.size):
                before = matrix[i, j] if sign < 0.0 else 0.0
                matrix[i, j] = before + sign * flow.out[1, i] / (2.0 * flow.nudge)
    return FINE


@subroutine
def follow(flow: Flow, state: Floats, moved: int, by: float) -> int:
    """Integrates over a period, from a state of shape (2n,) with one component moved; returns the outcome."""
    for d in range(state.size):
        flow.workspace.old[d] = state[d]
        flow.workspace.compensation[d] = 0.0
    flow.workspace.old[moved] += by
    flow.control.plan.ends[0] = flow.times[1]
    start_record(flow.control.plan.progress)
    result = integrate(flow.motion, flow.weights, flow.control, flow.watch, flow.workspace, flow.times, flow.out)
    return result.outcome
