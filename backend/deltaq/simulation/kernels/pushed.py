"""A step of `rattle` by what `model.pushes` solves for in symbols; by numbers where that does not hold.

Source: Hairer, Lubich, Wanner, Geometric Numerical Integration, 2nd ed., VII.1.4.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .compiler import inline, subroutine
from .linear import Indices
from .motion import FINE, SMALLEST_PIVOT, SMALLEST_SCHUR_PIVOT, Floats, Motion
from .pointer import call, prevent_vectorization
from .projection import CLOSE, STALLED
from .rattle import ENOUGH, SLIGHT, Held, advance_held, compensate, guess, look_closely
from .split_step import SplitWorkspace, add_compensated
from .system import COUNT, DEGREES, IS_UNDER_WAY

ROUNDS = 4  # of two corrections each; what takes more is left to numbers, which take A anew where it ends
REST, ALWAYS = 50, 2**62  # steps that numbers make then, or if there is nothing else


class Pushed(NamedTuple):
    """What `model.pushes` compiled, by addresses, and the numbers they read and write; the addresses are 0 for none.

    `given` are the inputs of a model and what `Places` has behind them; of these `impulse`, shape (1,), `before`, shape
    (m n,), and `told` are parts. `told` begins with R, shape (m n,), and S⁻¹; `free`, shape (n,), `lost`,
    shape (n,), `rows`, shape (m n,), and `signs`, shape (3,), are its other parts. `moves`, shape (m + 2 n,), receives
    what is said of shifts. `resting`, shape (1,), is how many steps numbers have still to make; −1 behind the last.
    """

    shifts: int
    shifts_data: int
    ends: int
    ends_data: int
    given: Floats
    impulse: Floats
    before: Floats
    told: Floats
    free: Floats
    lost: Floats
    rows: Floats
    signs: Floats
    moves: Floats
    resting: Indices


def make_pushed(addresses: tuple[int, int, int, int], given: Floats, n: int, m: int, first: int) -> Pushed:
    """The same for addresses of functions and of their data, and numbers of which those behind inputs begin at `first`.

    `given` has shape (inputs + `Places.size`,).
    """
    told = first + 1 + m * n
    free = told + m * n + m * (m + 1) // 2
    rows = free + 2 * n
    return Pushed(
        *addresses,
        given,
        given[first : first + 1],
        given[first + 1 : told],
        given[told:],
        given[free : free + n],
        given[free + n : rows],
        given[rows : rows + m * n],
        given[rows + m * n :],
        np.zeros(m + 2 * n),
        np.full(1, 0 if all(addresses) else ALWAYS),
    )


@inline
def look_ahead(pushed: Pushed, conditioning: Floats) -> bool:
    """What is to be known at the state in `given`; whether there is a solution.

    `conditioning` has shape (1,): the smallest pivot met.
    """
    call(pushed.ends, pushed.ends_data, pushed.told, pushed.given)
    signs = pushed.signs
    if not (signs[1] > SMALLEST_PIVOT and signs[2] > SMALLEST_SCHUR_PIVOT):
        return False
    conditioning[0] = min(conditioning[0], signs[1], signs[2])
    return True


@inline
def keep_before(pushed: Pushed) -> None:
    """A at the state in `given` becomes that `before` the next step."""
    for i in range(pushed.rows.size):
        pushed.before[i] = pushed.rows[i]


@inline
def begin_pushed(pushed: Pushed, n: int, t: float, conditioning: Floats, workspace: SplitWorkspace) -> bool:
    """What is to be known at the start of a step where it is not yet; whether there is a solution.

    `conditioning` has shape (1,): the smallest pivot met.
    """
    for d in range(2 * n):
        pushed.given[d] = workspace.ends.old[d]
    pushed.given[2 * n], pushed.impulse[0] = t, 0.0
    is_good = look_ahead(pushed, conditioning)
    keep_before(pushed)
    pushed.resting[0] = 0
    return is_good


@inline
def place_pushed(held: Held, pushed: Pushed, h: float, workspace: SplitWorkspace) -> None:
    """Rates behind the kick and positions behind the drift with the present pushes, also into `given`.

    `acceleration` is what the kick does to the rates, `spare` becomes what the pushes leave of it.
    """
    n, m, old, new = held.system.head[DEGREES], held.system.head[COUNT], workspace.ends.old, workspace.ends.new
    for d in range(n):
        change = workspace.acceleration[d]
        for k in range(m):
            change -= held.pushes[0, k] * pushed.told[k * n + d]
        workspace.spare[d] = change
        rate = old[n + d] + change
        value = old[d] + (h * rate + workspace.compensation[d])
        new[n + d] = pushed.given[n + d] = rate
        new[d] = pushed.given[d] = value


@inline
def is_met(pushed: Pushed, h: float, m: int, n: int) -> bool:
    """Whether two corrections were enough, as `rattle.meet` judges them, here all coordinates by the largest ones.

    What is left is the second one times the ratio of both, or it is rounding.
    """
    first, second, is_slight, is_small = 0.0, 0.0, True, True
    for d in range(n):
        first, second = max(first, abs(pushed.moves[m + d])), max(second, abs(pushed.moves[m + n + d]))
    for d in range(n):
        change, size = abs(pushed.moves[m + n + d]), abs(pushed.given[d])
        reach = max(size, abs(h * pushed.given[n + d]))
        is_slight = is_slight and (change * second <= SLIGHT * reach * first or change <= ENOUGH * reach)
        is_small = is_small and change <= CLOSE * max(1.0, size)
    return first + second < np.inf and (is_slight or (second >= STALLED * first and is_small))


@inline
def meet_pushed(held: Held, pushed: Pushed, h: float, workspace: SplitWorkspace) -> bool:
    """Pushes at the start of a step until its end is on g = 0; whether they were found."""
    n, m = held.system.head[DEGREES], held.system.head[COUNT]
    for _ in range(ROUNDS):
        place_pushed(held, pushed, h, workspace)
        call(pushed.shifts, pushed.shifts_data, pushed.moves, pushed.given)
        for k in range(m):
            held.pushes[0, k] += pushed.moves[k] / h
        if is_met(pushed, h, m, n):
            place_pushed(held, pushed, h, workspace)
            return True
    return False


@subroutine
def advance_by_numbers(
    motion: Motion, held: Held, pushed: Pushed, t: float, h: float, known: int, workspace: SplitWorkspace
) -> tuple[int, bool, int]:
    """`advance_held`, which knows nothing of where the first of several steps begins."""
    prevent_vectorization()
    resting = pushed.resting
    if resting[0] <= 0:
        known, resting[0] = 0, REST
        for d in range(workspace.ends.old.size):
            workspace.ends.new[d] = workspace.ends.old[d]
    resting[0] = resting[0] - 1 if resting[0] > 1 else -1
    return advance_held(motion, held, t, h, known, workspace)


@inline
def advance_pushed(
    motion: Motion, held: Held, pushed: Pushed, t: float, h: float, known: int, workspace: SplitWorkspace
) -> tuple[int, bool, int]:
    """A step: the kicks and the drift between them; `known` says whether what its start needs has been computed there.

    Returns the outcome, whether it is known at the end, and how often the motion was looked at.
    """
    n, is_good = motion.degrees, pushed.resting[0] <= 0
    if is_good and (known == 0 or pushed.resting[0] < 0):
        is_good = begin_pushed(pushed, n, t, motion.conditioning, workspace)
        if known == 0:
            held.remembered[0] = 0
    if is_good:
        for d in range(n):
            workspace.acceleration[d] = held.before * h * pushed.free[d] + workspace.compensation[n + d]
        guess(held)
        pushed.given[2 * n], pushed.impulse[0] = t + h, held.behind * h
        is_good = meet_pushed(held, pushed, h, workspace) and look_ahead(pushed, motion.conditioning)
    if not is_good:
        return advance_by_numbers(motion, held, pushed, t, h, known, workspace)
    compensate(h, n, workspace)
    for d in range(n):
        add_compensated(n + d, pushed.lost[d], workspace)
    outcome, is_known = FINE, True
    if not pushed.signs[0] > 0.0:
        for i in range(pushed.before.size):
            held.system.before[i] = pushed.before[i]
        held.system.head[IS_UNDER_WAY] = 1
        outcome, is_known = look_closely(motion.finish, held.block, t, h, outcome, workspace.ends), False
    keep_before(pushed)
    return outcome, is_known, 1 if known != 0 else 2
