"""A step on holonomic constraints where M is constant and forces depend on q and t alone: RATTLE, and what is like it.

With κ and κ′ the kicks before and behind the drift,

    v½ = v₀ + κh M⁻¹F(q₀) − M⁻¹A(q₀)ᵀν,   q₁ = q₀ + h v½,   g(q₁) = 0,
    v₁ = v½ + κ′h M⁻¹F(q₁) − M⁻¹A(q₁)ᵀμ,   w(q₁, v₁) = 0.

That is symplectic on the constraints. The pushes ν are guessed from those of the steps before and then corrected by
A M⁻¹Aᵀ as it was at q₀, which is factored already for μ of the step before; where that is slow, by A(q₁)M⁻¹A(q₀)ᵀ.
Sources: Hairer, Lubich, Wanner, Geometric Numerical Integration, 2nd ed., VII.1.4; H. C. Andersen, J. Comput. Phys. 52
(1983) 24–34.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .compiler import inline, runtime_int, subroutine
from .constraints import scale
from .hermite import Ends
from .linear import Indices
from .motion import FINE, LOCKED, NEWTON_FAILED, NOT_FINITE, Floats, Motion
from .pointer import call, call_finish, prevent_vectorization
from .projection import CLOSE, CORRECTIONS, STALLED, keep_rows, read_gaps, take_state, turning
from .ranked import factor_ranked, solve_ranked
from .split_step import SplitWorkspace, add_compensated
from .system import COUNT, DEGREES, IS_UNDER_WAY, MOTION, MOTION_DATA, RANK, System, block_at, place_of_rows

MEMORY = 3  # steps whose pushes are remembered
ENOUGH = 2.0**-49  # of a coordinate, or of how far it moves in a step: behind a correction this small comes rounding
SMALLEST = 1e-300  # a number to divide by
SLIGHT = 2.0**-53  # of it, too: what is left where corrections go on to fall as they did


class Held(NamedTuple):
    """What keeps a step on its constraints: `system` is their memory, whose address is `block`.

    `before` and `behind` are the kicks on both sides of the drift in units of h, `pushes`, shape (MEMORY, constraints),
    those of the last steps, the latest first, of which so many, shape (1,), are `remembered`.
    """

    block: int
    system: System
    before: float
    behind: float
    pushes: Floats
    remembered: Indices


def make_held(memory: Floats, kicks: Floats, drifts: Floats) -> Held:
    """The same for a memory as `System` has it, shape (size,), and kicks and drifts, shape (stages,).

    Nothing is held where its first numbers are zero.
    """
    place = memory.ctypes.data
    system, middle = block_at(place), int(np.argmax(drifts != 0.0)) + 1
    pushes, remembered = np.zeros((MEMORY, system.head[COUNT])), np.zeros(1, dtype=np.int64)
    return Held(place, system, float(kicks[:middle].sum()), float(kicks[middle:].sum()), pushes, remembered)


@inline
def solve_mass(factors: Floats, n: int, right: Floats, count: int) -> None:
    """M⁻¹ times so many columns of n numbers, in place; `factors` of M, shape (≥ n (n + 1)/2,).

    Those of particles in Cartesian coordinates have nothing beside their diagonal.
    """
    beside = 0.0
    for i in range(1, n):
        for k in range(i):
            beside += abs(factors[i * (i + 1) // 2 + k])
    for first in range(0, count * n, n):
        for i in range(1, n if beside > 0.0 else 0):
            total, row = right[first + i], i * (i + 1) // 2
            for k in range(i):
                total -= factors[row + k] * right[first + k]
            right[first + i] = total
        for i in range(n - 1, -1, -1):
            total = right[first + i] * factors[i * (i + 1) // 2 + i]
            for k in range(i + 1, n if beside > 0.0 else 0):
                total -= factors[k * (k + 1) // 2 + i] * right[first + k]
            right[first + i] = total


@inline
def decompose(system: System) -> int:
    """A M⁻¹Bᵀ scaled and factored, with A from the outputs and the rows of BM⁻¹ from the responses; the outcome."""
    n, m, rows, schur = system.head[DEGREES], system.head[COUNT], place_of_rows(system), system.schur
    for k in range(m):
        for j in range(m):
            total = 0.0
            for i in range(n):
                total += system.outputs[rows + k * n + i] * system.responses[j * n + i]
            schur[k * m + j] = total
        system.scales[k] = scale(schur[k * m + k])
    for k in range(m):
        for j in range(m):
            schur[k * m + j] *= system.scales[k] * system.scales[j]
    rank, smallest = factor_ranked(schur, system.order, m)
    if rank != system.head[RANK]:
        return NOT_FINITE if rank < 0 else LOCKED
    system.conditioning[0] = min(system.conditioning[0], smallest)
    return FINE


@subroutine
def look(system: System, factors: Floats, begins: int) -> int:
    """A at the state in the inputs, and A M⁻¹Bᵀ factored, B from where the step begins; returns the outcome.

    If a step `begins` there (1), B is that A, whose responses, and q̈ without reactions, are computed. `factors` of M
    have shape (≥ n (n + 1)/2,).
    """
    prevent_vectorization()
    n, m, rows = system.head[DEGREES], system.head[COUNT], place_of_rows(system)
    call(system.head[MOTION], system.head[MOTION_DATA], system.outputs, system.inputs)
    if begins != 0:
        for i in range(n):
            system.accelerations[i] = system.outputs[n * (n + 1) // 2 + i]
        for k in range(m * n):
            system.responses[k] = system.outputs[rows + k]
        solve_mass(factors, n, system.accelerations, 1)
        solve_mass(factors, n, system.responses, m)
    return decompose(system)


@inline
def place(held: Held, h: float, workspace: SplitWorkspace) -> tuple[float, bool]:
    """Rates behind the kick and positions behind the drift with the present pushes; positions also into `inputs`.

    `acceleration` is what the kick does to the rates, `spare` becomes what the pushes leave of it. Returns the largest
    part of a coordinate, or of how far it moves, by which it is different from before, and whether all are small beside
    coordinates or 1.
    """
    system = held.system
    n, part, is_small, old, new = system.head[DEGREES], 0.0, True, workspace.ends.old, workspace.ends.new
    for d in range(n):
        change = workspace.acceleration[d]
        for k in range(system.head[COUNT]):
            change -= held.pushes[0, k] * system.responses[k * n + d]
        workspace.spare[d] = change
        new[n + d] = old[n + d] + change
        path = h * new[n + d]
        new[d] = old[d] + (path + workspace.compensation[d])
        moved, size = abs(new[d] - system.inputs[d]), abs(new[d])
        system.inputs[d] = new[d]
        if moved != 0.0:
            reach = max(size, abs(path), SMALLEST)
            part = moved / reach if not moved <= part * reach else part
            is_small = is_small and moved <= CLOSE * max(1.0, size)
    return part, is_small


@inline
def meet(held: Held, t: float, h: float, workspace: SplitWorkspace) -> tuple[int, int]:
    """Pushes at the start of a step until its end is on g = 0: the outcome, and how often A was computed."""
    system = held.system
    m, before, computed = system.head[COUNT], np.inf, 0
    system.inputs[2 * system.head[DEGREES]] = t + h
    for tries in range(CORRECTIONS):
        part, is_small = place(held, h, workspace)
        if not part < np.inf:
            return NOT_FINITE, computed
        if tries > 0 and (part <= ENOUGH or (part >= STALLED * before and is_small)):
            return FINE, computed
        if tries > 1 and part * part <= SLIGHT * before:
            return FINE, computed
        if part * part * part > ENOUGH * before * before:
            outcome = look(system, workspace.factors, runtime_int(0))
            computed += 1
            if outcome != FINE:
                return outcome, computed
        read_gaps(system)
        for k in range(m):
            system.right[k] = system.gaps[k] / h
        solve_ranked(system.schur, system.order, m, system.head[RANK], system.scales, system.right)
        for k in range(m):
            held.pushes[0, k] += system.right[k]
        before = part if tries > 0 else np.inf
    return NEWTON_FAILED, computed


@inline
def guess(held: Held) -> None:
    """The first guess of the pushes, by the parabola through those of the steps before, which it stands before."""
    pushes, known = held.pushes, held.remembered[0]
    for k in range(pushes.shape[1]):
        last, second, third = pushes[0, k], pushes[1, k], pushes[2, k]
        pushes[2, k], pushes[1, k] = second, last
        if known == 0:
            pushes[0, k] = 0.0
        elif known == 2:
            pushes[0, k] = 2.0 * last - second
        elif known > 2:
            pushes[0, k] = 3.0 * (last - second) + third
    held.remembered[0] = min(known + 1, MEMORY)


@inline
def compensate(h: float, n: int, workspace: SplitWorkspace) -> None:
    """What the new rates and positions have lost to rounding, to be given back (Kahan's summation)."""
    old, new, lost = workspace.ends.old, workspace.ends.new, workspace.compensation
    for d in range(n):
        lost[n + d] = workspace.spare[d] - (new[n + d] - old[n + d])
        lost[d] = h * new[n + d] + lost[d] - (new[d] - old[d])


@inline
def settle_rates(system: System, impulse: float, workspace: SplitWorkspace) -> None:
    """The kick behind the drift, of so many seconds, and rates moved onto w = Aq̇ + b = 0, in the metric of M."""
    n, m, rows = system.head[DEGREES], system.head[COUNT], place_of_rows(system)
    for k in range(m):
        slip = system.outputs[rows + m * n + m + k]
        for i in range(n):
            slip += system.outputs[rows + k * n + i] * (workspace.ends.new[n + i] + impulse * system.accelerations[i])
        system.right[k] = slip
    solve_ranked(system.schur, system.order, m, system.head[RANK], system.scales, system.right)
    for i in range(n):
        change = impulse * system.accelerations[i]
        for k in range(m):
            change -= system.right[k] * system.responses[k * n + i]
        add_compensated(n + i, change, workspace)


@inline
def look_closely(finish: int, block: int, t: float, h: float, outcome: int, ends: Ends) -> int:
    """LOCKED if the constraints lost their independence in a step at whose ends they look turned round, or that failed.

    Else the outcome as it was.
    """
    told = call_finish(finish, block, t, h, ends.old, ends.new, ends.old_derivative, ends.new_derivative)
    return told if told == LOCKED or outcome == FINE else outcome


@inline
def advance_held(
    motion: Motion, held: Held, t: float, h: float, known: int, workspace: SplitWorkspace
) -> tuple[int, bool, int]:
    """A step: the kicks and the drift between them; `known` says whether what its start needs has been computed there.

    Returns the outcome, whether it is known at the end, and how often the motion was looked at.
    """
    system, n = held.system, motion.degrees
    outcome, computed, is_known = FINE, 0, True
    if known == 0:
        take_state(system, t, workspace.ends.new)
        outcome, computed = look(system, workspace.factors, runtime_int(1)), 1
        keep_rows(system)
        held.remembered[0], system.head[IS_UNDER_WAY] = 0, 1
    for d in range(n):
        workspace.acceleration[d] = held.before * h * system.accelerations[d] + workspace.compensation[n + d]
    guess(held)
    if outcome == FINE:
        outcome, more = meet(held, t, h, workspace)
        compensate(h, n, workspace)
        computed += more
    if outcome == FINE:
        outcome = look(system, workspace.factors, runtime_int(1))
        computed += 1
    if outcome == FINE:
        settle_rates(system, held.behind * h, workspace)
    if outcome != FINE or not turning(system, system.responses) > 0.0:
        outcome, is_known = look_closely(motion.finish, held.block, t, h, outcome, workspace.ends), False
    keep_rows(system)
    motion.conditioning[0] = min(motion.conditioning[0], system.conditioning[0])
    return outcome, is_known, computed
