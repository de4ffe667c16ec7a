"""The workspace of implicit methods: kernels allocate nothing."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .compiler import inline
from .hermite import Ends, make_ends
from .kicked import Kicked, make_kicked
from .kicks import Kicks, make_kicks
from .linear import Indices
from .motion import Floats
from .stages import Stages, make_stages


class ImplicitWorkspace(NamedTuple):
    """The state at both ends of a step, digits below its rounding, and what stages and error estimate need.

    `p`, `new_p` (momenta) and `rate` (ṗ at the start) have shape (n,); `compensation` and `new_compensation` (of q,
    then p, then the work), `error`, `state` and `derivative` shape (width,); `error_matrix` shape (n, n), its
    `error_pivots` (n,); `powers`, those at the stages in W, shape (stages,). `kicks` keep positions on constraints,
    `kicked` the same in symbols.
    """

    p: Floats
    new_p: Floats
    compensation: Floats
    new_compensation: Floats
    rate: Floats
    ends: Ends
    stages: Stages
    error: Floats
    error_matrix: Floats
    error_pivots: Indices
    state: Floats
    derivative: Floats
    powers: Floats
    kicks: Kicks
    kicked: Kicked


def make_implicit_workspace(
    state: Floats, n: int, count: int, constraints: int = 0, kicked: Kicked | None = None
) -> ImplicitWorkspace:
    """The workspace of `count` stages for n coordinates, at an initial state of shape (width,).

    `constraints` is how many of them are kept by kicks, `kicked` what solves for these in symbols: the momenta and the
    stage then stand in its numbers.
    """
    line, wide = np.zeros(n), np.zeros(state.size)
    stages = make_stages(count, n)
    if kicked is not None:
        v, q, r = (each.reshape(1, n) for each in (kicked.rates, kicked.places, kicked.forces))
        stages = stages._replace(v=v, q=q, r=r, residual=kicked.change)
    return ImplicitWorkspace(
        line.copy() if kicked is None else kicked.momenta,
        line.copy(),
        wide.copy(),
        wide.copy(),
        line.copy(),
        make_ends(state),
        stages,
        wide.copy(),
        np.zeros((n, n)),
        np.zeros(n, dtype=np.int64),
        wide.copy(),
        wide.copy(),
        np.zeros(count),
        make_kicks(constraints, count, n),
        kicked or make_kicked((0, 0), np.zeros(0), 0, 0),
    )


@inline
def compensated_sum(old: float, change: float, d: int, workspace: ImplicitWorkspace) -> float:
    """old + change, with what rounding took from component d before; notes what it takes now (Kahan's summation)."""
    change += workspace.compensation[d]
    new = old + change
    workspace.new_compensation[d] = change - (new - old)
    return new


@inline
def accept_step(workspace: ImplicitWorkspace) -> None:
    """The new state becomes the old one."""
    for d in range(workspace.p.size):
        workspace.p[d] = workspace.new_p[d]
    for d in range(workspace.ends.old.size):
        workspace.ends.old[d] = workspace.ends.new[d]
        workspace.compensation[d] = workspace.new_compensation[d]
