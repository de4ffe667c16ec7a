"""The workspace of implicit methods: kernels allocate nothing."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .compiler import inline
from .hermite import Ends, make_ends
from .kicks import Kicks, make_kicks
from .linear import Indices
from .motion import Floats
from .stages import Stages, make_stages


class ImplicitWorkspace(NamedTuple):
    """The state at both ends of a step, digits below its rounding, and what stages and error estimate need.

    `p`, `new_p` (momenta) and `rate` (ṗ at the start) have shape (n,); `compensation` and `new_compensation` (of q,
    then p, then the work), `error`, `state` and `derivative` shape (width,); `error_matrix` shape (n, n), its
    `error_pivots` (n,); `powers`, those at the stages in W, shape (stages,). `kicks` keep positions on constraints.
    """

    p: Floats
    new_p: Floats
    compensation: Floats  # of q, then p, then the work
    new_compensation: Floats
    rate: Floats  # ṗ at the start
    ends: Ends
    stages: Stages
    error: Floats
    error_matrix: Floats
    error_pivots: Indices
    state: Floats
    derivative: Floats
    powers: Floats
    kicks: Kicks


def make_implicit_workspace(state: Floats, n: int, count: int, kicked: int = 0) -> ImplicitWorkspace:
    """The workspace of `count` stages for n coordinates, at an initial state of shape (width,).

    `kicked` is how many constraints are kept by kicks.
    """
    line, wide = np.zeros(n), np.zeros(state.size)
    return ImplicitWorkspace(
        line.copy(),
        line.copy(),
        wide.copy(),
        wide.copy(),
        line.copy(),
        make_ends(state),
        make_stages(count, n),
        wide.copy(),
        np.zeros((n, n)),
        np.zeros(n, dtype=np.int64),
        wide.copy(),
        wide.copy(),
        np.zeros(count),
        make_kicks(kicked, count, n),
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
