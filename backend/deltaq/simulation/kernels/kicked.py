"""Corrections of a stage and its kick as `model.kicks` solves for both in symbols; by numbers where that does not hold.

Source: Hairer, Lubich, Wanner, Geometric Numerical Integration, 2nd ed., VII.1.4.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .compiler import inline
from .kicks import rows_before
from .linear import substitute
from .motion import SMALLEST_SCHUR_PIVOT, Floats, Motion
from .pointer import call
from .stages import ImplicitWeights, Stages, Start
from .system import System


class Kicked(NamedTuple):
    """What `model.kicks` compiled, by its address and that of its data, 0 for none, and the numbers of `KickPlaces`.

    `given` are its inputs; of these `values`, shape (n,), `rates`, shape (n,), `reach`, shape (4,), `momenta`, shape
    (n,), `before`, shape (m n,), and `inverse`, shape (n²,), are parts. `told` receives what it says: `change`, shape
    (n,), `kicked`, shape (n,), `places`, shape (n,), `forces`, shape (n,), and `signs`, shape (2,), are its parts.
    """

    address: int
    data: int
    given: Floats
    values: Floats
    rates: Floats
    reach: Floats
    momenta: Floats
    before: Floats
    inverse: Floats
    told: Floats
    change: Floats
    kicked: Floats
    places: Floats
    forces: Floats
    signs: Floats


def make_kicked(addresses: tuple[int, int], parameters: Floats, n: int, m: int) -> Kicked:
    """The same for addresses and numbers of a model, whose `parameters` have shape (parameters,)."""
    first, told = 2 * n + 1 + parameters.size, np.zeros(4 * n + 2)
    before = first + 4 + n
    given = np.zeros(before + m * n + n * n)
    given[2 * n + 1 : first] = parameters
    return Kicked(
        *addresses,
        given,
        given[:n],
        given[n : 2 * n],
        given[first : first + 4],
        given[first + 4 : before],
        given[before : before + m * n],
        given[before + m * n :],
        told,
        told[:n],
        told[n : 2 * n],
        told[2 * n : 3 * n],
        told[3 * n : 4 * n],
        told[4 * n :],
    )


@inline
def invert(stages: Stages, kicked: Kicked) -> None:
    """W⁻¹ by rows: of the decomposed matrix, whose inverse takes part in corrections alone."""
    n = kicked.values.size
    for k in range(n):
        for d in range(n):
            stages.residual[d] = 1.0 if d == k else 0.0
        substitute(stages.matrix, stages.pivots, stages.residual)
        for d in range(n):
            kicked.inverse[d * n + k] = stages.residual[d]


@inline
def begin_kicked(
    motion: Motion, system: System, weights: ImplicitWeights, t: float, h: float, start: Start, kicked: Kicked
) -> None:
    """What all corrections of a step are given alike."""
    rows_before(system, t, start)
    for d in range(kicked.values.size):
        kicked.values[d] = start.q[d]
    kicked.given[2 * motion.degrees] = t + weights.c[0] * h
    kicked.reach[0], kicked.reach[1] = h, h * weights.a[0, 0]
    kicked.reach[2], kicked.reach[3] = h * weights.momentum_a[0, 0], t + h
    for i in range(kicked.before.size):
        kicked.before[i] = system.before[i]


@inline
def correct_kicked(kicked: Kicked) -> bool:
    """Newton's correction of V, Q and r, and the momenta at the start kicked; whether the kick has a value.

    They stand where the stages have their own: `make_kicked` says where.
    """
    call(kicked.address, kicked.data, kicked.told, kicked.given)
    signs = kicked.signs
    if not (signs[1] > 0.0 and signs[0] > SMALLEST_SCHUR_PIVOT * signs[1]):
        return False
    for d in range(kicked.momenta.size):
        kicked.momenta[d] = kicked.kicked[d]
    return True
