"""Steps of partitioned methods where M is constant and forces depend on q and t alone: kick and drift.

Positions and momenta are advanced in turn, each exactly, so nothing is to be solved for.
Source: Hairer, Lubich, Wanner, Geometric Numerical Integration, VI.3.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .compiler import inline
from .hermite import Ends, make_ends
from .motion import FINE, NOT_FINITE, TOO_LARGE, Floats, factor, solve
from .phase import Phase, momenta
from .step import LARGEST_VALUE


class SplitWeights(NamedTuple):
    """Kick by kicks[i] h, then drift by drifts[i] h, for every i: `kicks` and `drifts` have shape (stages,)."""

    kicks: Floats
    drifts: Floats


class SplitWorkspace(NamedTuple):
    """Both ends of a step, digits below their rounding, q̈ at the new positions, and the factors of M.

    `compensation` has shape (width,), `acceleration` and `spare` shape (n,), `factors` shape (n (n + 1)/2 + n,): the
    factors and a right side.
    """

    ends: Ends
    compensation: Floats
    acceleration: Floats
    spare: Floats
    factors: Floats


def make_split_workspace(state: Floats, n: int) -> SplitWorkspace:
    """The workspace for n coordinates, at an initial state of shape (width,)."""
    line = np.zeros(n)
    return SplitWorkspace(make_ends(state), np.zeros(state.size), line, line.copy(), np.zeros(n * (n + 1) // 2 + n))


@inline
def add_compensated(d: int, change: float, workspace: SplitWorkspace) -> None:
    """Adds to component d of the new state by Kahan's summation."""
    change += workspace.compensation[d]
    old = workspace.ends.new[d]
    workspace.ends.new[d] = old + change
    workspace.compensation[d] = change - (workspace.ends.new[d] - old)


@inline
def update_acceleration(phase: Phase, t: float, workspace: SplitWorkspace) -> None:
    """q̈ = M⁻¹ ṗ at the new positions, where the factors of M are known."""
    n = phase.degrees
    momenta(phase, t, workspace.ends.new[:n], workspace.ends.new[n : 2 * n], workspace.spare, workspace.acceleration)
    first = n * (n + 1) // 2
    for d in range(n):
        workspace.factors[first + d] = workspace.acceleration[d]
    solve(workspace.factors, n)
    for d in range(n):
        workspace.acceleration[d] = workspace.factors[first + d]


@inline
def factorize(phase: Phase, t: float, workspace: SplitWorkspace) -> None:
    """The factors of M, which is constant."""
    n = phase.degrees
    update_acceleration(phase, t, workspace)
    for i in range(n * (n + 1) // 2):
        workspace.factors[i] = phase.outputs[i]
    factor(workspace.factors, n)


@inline
def advance(
    phase: Phase, weights: SplitWeights, t: float, h: float, known: int, workspace: SplitWorkspace
) -> tuple[bool, int]:
    """All kicks and drifts of a step; `known` says whether the acceleration at its start is known.

    Returns whether it is known at the end, and how many were computed.
    """
    n, computed, place = phase.degrees, 0, 0.0
    is_known = known != 0
    for i in range(weights.kicks.size):
        if weights.kicks[i] != 0.0:
            if not is_known:
                update_acceleration(phase, t + place * h, workspace)
                computed += 1
                is_known = True
            for d in range(n):
                add_compensated(n + d, weights.kicks[i] * h * workspace.acceleration[d], workspace)
        if weights.drifts[i] != 0.0:
            for d in range(n):
                add_compensated(d, weights.drifts[i] * h * workspace.ends.new[n + d], workspace)
            place += weights.drifts[i]
            is_known = False
    return is_known, computed


@inline
def check(n: int, workspace: SplitWorkspace) -> int:
    """Whether the new state is within bounds."""
    for d in range(2 * n):
        size = abs(workspace.ends.new[d])
        if not size <= LARGEST_VALUE:
            return TOO_LARGE if size < np.inf else NOT_FINITE
    return FINE
