"""Which switches hold a motion: where a force jumps with the sign of w(q, q̇, t), w = 0 may be crossed, left or kept.

With σ = sign w the rate of w is ẇ = n − B σ, B = A M⁻¹ C of the rows at zero. A single one with B > 0 is driven back
from both sides as long as |n| ≤ B: it is kept, with σ = n/B. Otherwise the motion goes through, or leaves to where it
is driven. Several go on in one way alone if all principal minors of B are positive: σ then is the only solution of
ẇ = 0 where |σ| < 1, ẇ ≥ 0 where σ = 1, ẇ ≤ 0 where σ = −1.
Frictions, |λ| ≤ F₀, and contacts, λ ≥ 0 and g̈ ≥ 0, have C = Aᵀ: a linear complementarity problem with bounds, which
has one solution where their rows are independent.
Sources: Filippov, Differential Equations with Discontinuous Righthand Sides, §4; Cottle, Pang, Stone, The Linear
Complementarity Problem, §3.3 (matrices whose principal minors are positive) and §4.2 (Murty's pivots).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import combinations, product

import numpy as np

from .mode_state import ModeState
from .problem import Floats

SLACK = 1e-12  # relative, of a friction that holds
AGAINST = 1e-9  # of the jump of ẇ: so much against its side a row at zero may be driven by rounding
LEFT_OVER = 1e-14  # of accelerations that constraints take, by rounding
MOST_TOGETHER = 5  # rows at zero of which all ways to go on are tried
MOST_PIVOTS = 500
MOMENT = 1e-7  # of the span
ALONG = 1e-9  # of a row: what is left of it besides others that hold as much


class SlidingError(Exception):
    """Switches at zero together that do not tell how the motion goes on; `row` is one of them."""

    def __init__(self, row: int) -> None:
        super().__init__(row)
        self.row = row


def draws(current: ModeState, row: int) -> bool:
    """Whether the jump at a row drives it back to zero from both sides: B > 0."""
    facts = current.facts
    return bool(facts.a[row] @ current.moved_by(facts.along[row]) > 0.0)


def rate_of(current: ModeState, row: int) -> float:
    """ẇ of a row in the mode of a state."""
    return float(current.facts.a[row] @ current.accelerations + current.facts.bias[row])


def on_side(current: ModeState, row: int, side: float) -> ModeState:
    """The same state with a row that is not held on one side of zero, or (0) held; a contact has one side only."""
    mode = current.mode
    slips = [*mode.slips]
    if row < current.modes.bounded:
        slips[row] = side or slips[row]
    flags = [*mode.flags]
    flags[row] = float(side == 0.0)
    return current.within(mode._replace(slips=tuple(slips), flags=tuple(flags)))


def side_left_to(current: ModeState, row: int, *, has_come: bool) -> float:
    """The side to which a row leaves zero that is not kept there.

    One that has come to zero goes through if the other side takes it. From rest at zero, where both would, it is the
    side that the mean of both drives to.
    """
    old = current.mode.slips[row]
    rates = {side: rate_of(on_side(current, row, side), row) for side in (-old, old)}
    leaving = [side for side, rate in rates.items() if side * rate > 0.0]
    if len(leaving) == 1 or (leaving and has_come):
        return leaving[0]
    return float(np.sign(sum(rates.values()))) or old


def unkept(current: ModeState, held: Sequence[bool]) -> int | None:
    """The first switch held by none of the forces between both sides, though it should be."""
    first, facts = len(current.modes.frictions), current.facts
    for row in range(first, current.modes.bounded):
        if held[row] and not (
            math.isfinite(facts.reactions[row]) and (draws(current, row) or facts.reactions[row] == 0.0)
        ):
            return row
    return None


def settled(current: ModeState, at_zero: Sequence[int], resting: Sequence[int] = ()) -> ModeState:
    """The state in the only mode in which frictions and switches at zero, and contacts that may rest, go on.

    Raises SlidingError if switches have none, or more than can be told apart.
    """
    if current.modes.switches and at_zero:
        return _switched(current, at_zero)
    rows = [*at_zero, *resting]
    is_alone = len(rows) < 2 and not len(current.kept[0])
    return current if is_alone or not rows else _pivoted(current, rows)


def _switched(current: ModeState, at_zero: Sequence[int]) -> ModeState:
    if not _is_consistent(current, at_zero):
        current = _tried(current, at_zero)
    held = [row for row in at_zero if current.mode.flags[row]]
    switch = next((row for row in held if row >= len(current.modes.frictions)), None)
    if switch is not None and len(held) > 1:
        is_coupled = any(pair in current.modes.coupled for pair in combinations(held, 2))
        if is_coupled or not _is_unique(current, held):
            raise SlidingError(switch)
    return current


def _pivoted(current: ModeState, rows: Sequence[int]) -> ModeState:
    """The state with the first row that does not go on as it should held or let go, until all do.

    Comes to an end where rows are independent. Of rows that are not, what each takes is not determined: one that the
    others hold is let go, and the last state stands if there is no end.
    """
    trial = current
    for _ in range(MOST_PIVOTS):
        wrong = _dependent(trial, rows)
        if wrong is None:
            wrong = next((row for row in rows if not _goes_on(trial, row)), None)
        if wrong is None:
            return trial
        trial = on_side(trial, wrong, _side_let_go(trial, wrong) if trial.mode.flags[wrong] else 0.0)
    return current if all(map(math.isfinite, current.facts.reactions)) else trial


def _dependent(current: ModeState, rows: Sequence[int]) -> int | None:
    """The first row held that constraints, or others before it, hold as well, if there is one."""
    held = [unit_row(current, each) for each in current.kept[0]]
    known = _rank(held)
    for row in rows:
        if current.mode.flags[row]:
            held.append(unit_row(current, current.facts.a[row]))
            if _rank(held) == known:
                return row
            known += 1
    return None


def unit_row(current: ModeState, row: Floats) -> Floats:
    """A row in one unit and of length 1, shape (n,); one of zeros as it is."""
    found = current.in_one_unit(row)
    return np.asarray(found / (float(np.linalg.norm(found)) or 1.0))


def _rank(rows: Sequence[Floats]) -> int:
    return int(np.linalg.matrix_rank(np.array(rows), tol=ALONG)) if rows else 0


def _side_let_go(current: ModeState, row: int) -> float:
    """The side to which a friction goes that is not held, and 1 for a contact."""
    if row >= current.modes.bounded:
        return 1.0
    reaction = current.facts.reactions[row]
    return -math.copysign(1.0, reaction) if math.isfinite(reaction) else current.mode.slips[row]


def _tried(current: ModeState, at_zero: Sequence[int]) -> ModeState:
    if len(at_zero) > MOST_TOGETHER:
        raise SlidingError(at_zero[-1])
    for sides in product((0.0, 1.0, -1.0), repeat=len(at_zero)):
        trial = current
        for row, side in zip(at_zero, sides, strict=True):
            trial = on_side(trial, row, side)
        if _is_consistent(trial, at_zero):
            return trial
    raise SlidingError(at_zero[-1])


def _is_consistent(current: ModeState, at_zero: Sequence[int]) -> bool:
    return all(_goes_on(current, row) for row in at_zero)


def _goes_on(current: ModeState, row: int) -> bool:
    """Whether a row that is held is so within its bounds, and one that is not leaves to its side, or stays.

    What is at its bound but for rounding goes on if it is not beyond it a moment later.
    """
    left, unclear = _left_of_bound(current, row)
    if abs(left) > unclear:
        return left > 0.0
    left, unclear = _left_of_bound(later(current), row)
    return left >= -unclear


def leaves(current: ModeState, row: int) -> bool:
    """Whether a row that should be let go moves, or is held after all, or by others."""
    if not any(current.mode.flags):
        return True
    if current.mode.flags[row]:
        return False
    speed, unclear = _left_of_bound(later(current), row)
    return speed > unclear


def _left_of_bound(current: ModeState, row: int) -> tuple[float, float]:
    """How far a held row is from letting go, or how fast another one leaves zero; and what rounding makes of it."""
    facts, is_contact = current.facts, row >= current.modes.bounded
    if current.mode.flags[row]:
        reaction, limit = facts.reactions[row], current.size_of_forces if is_contact else facts.limits[row]
        left = reaction if is_contact else limit - abs(reaction)
        return left if math.isfinite(left) else -math.inf, SLACK * limit
    side = 1.0 if is_contact else current.mode.slips[row]
    return side * rate_of(current, row), unclear_rate(current, row)


def later(current: ModeState) -> ModeState:
    """The state a moment later."""
    h, rates = MOMENT * current.problem.t_end, current.accelerations
    return current.at(current.time + h, current.q + h * (current.v + 0.5 * h * rates), current.v + h * rates)


def unclear_rate(current: ModeState, row: int) -> float:
    """What rounding makes of ẇ: of what the force between both sides does to it, or for contacts any force.

    Constraints may take all of that; what rounding leaves is then a part of what they take.
    """
    facts, is_contact = current.facts, row >= current.modes.bounded
    a, along = facts.a[row], facts.along[row]
    force = current.size_of_forces if is_contact else facts.limits[row]
    jump = abs(force * float(a @ current.moved_by(along))) + abs(facts.bias[row])
    if is_contact:
        jump += float(np.abs(a) @ np.abs(current.accelerations))
    if not len(current.kept[0]):
        return AGAINST * jump
    taken = force * float(np.abs(a) @ np.abs(current.moved_freely_by(along)))
    return AGAINST * jump + LEFT_OVER * (taken + float(np.abs(a) @ np.abs(current.free_accelerations)))


def _is_unique(current: ModeState, held: Sequence[int]) -> bool:
    """Whether all principal minors of B are positive."""
    facts = current.facts
    moved: Floats = np.array([current.moved_by(facts.along[row]) for row in held])
    matrix = facts.a[list(held)] @ moved.T
    sizes = (combinations(range(len(held)), count) for count in range(1, len(held) + 1))
    return all(np.linalg.det(matrix[np.ix_(rows, rows)]) > 0.0 for several in sizes for rows in several)
