"""What impacts do to the rates: of one contact, of several one after the other, or at once where nothing rebounds.

At an impact the momenta jump along the gradient of the gap, p⁺ − p⁻ = Λ ∂g/∂q, such that the gap opens e times as fast
as it closed: Λ = −(1 + e) ġ/(∂g/∂q M⁻¹ ∂g/∂qᵀ). Several contacts that close at once push one after the other; what
comes out must be the same in whichever order, for otherwise e alone does not determine it. Those without rebound push
at once: Λ ≥ 0, ġ⁺ ≥ 0, and Λ = 0 where ġ⁺ > 0. Constraints answer with impulses of their own, A q̇⁺ = A q̇⁻: M⁻¹ is
then that part of the inverse of [M Aᵀ; A 0].
Source: Pfeiffer, Glocker, Multibody Dynamics with Unilateral Contacts, ch. 8; Moreau (1988), Unilateral contact and dry
friction in finite freedom dynamics.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import permutations
from typing import NamedTuple

import numpy as np

from .mode_state import ModeState
from .problem import Floats

STILL = 1e-12  # a rate, relative to the largest
HEIGHT = 1e-15  # by which rounding lifts a rebound, relative to the coordinates
LOWEST = 1e-12  # the highest rebound that is taken for rest, relative to the coordinates; of what loses nothing, too
ROUNDING = 1e-15
TICKS = 4.0  # of the time: units in the last place by which an event may be off
NOTHING = 1e-12  # of what an impulse would do without constraints: they take all of it
MOST_IMPACTS = 1000  # one after the other at one time
MANY_IMPACTS = 30  # behind so many those without rebound are taken at once
AGREE = 1e-9  # of the rates: behind impacts in another order they are the same
FEW = 3  # contacts whose orders are all tried


class UnsettledError(Exception):
    """Contacts at once whose impacts one after the other do not end."""


class NoDirectionError(Exception):
    """A contact whose gap changes with no coordinate where it is closed: no impulse along ∂g/∂q can part it."""

    def __init__(self, contact: int) -> None:
        super().__init__(contact)
        self.contact = contact


class UndeterminedError(Exception):
    """Contacts that close at once, behind which the motion depends on which one pushes first."""


class Impacts(NamedTuple):
    """The state behind impacts, which contacts pushed, in this order, and whether several of them closed at once."""

    state: ModeState
    pushed: tuple[int, ...]
    is_forked: bool = False


def after_impacts(current: ModeState, first: int) -> Impacts:
    """The state behind the impact of a contact, and of others that it closes or that touch, one after the other.

    Raises UnsettledError where they do not end, NoDirectionError, or UndeterminedError where their order matters.
    """
    first_row = current.modes.bounded
    free = current.with_flags((0.0,) * current.modes.rows)
    resting = {j for j in range(len(current.modes.contacts)) if current.mode.flags[first_row + j]}
    touching = sorted({first} | resting | set(free.touching))
    for j in touching:
        _require_direction(free, j)
    found = _in_turn(free, touching, ())
    if found.is_forked:
        _require_agreement(free, touching, found.state.v)
    settled = _without_lifts(found.state, touching) if len(touching) > 1 else found.state
    return found._replace(state=settled.within(current.mode))


def _in_turn(free: ModeState, touching: Sequence[int], order: Sequence[int]) -> Impacts:
    """The state behind impacts one after the other: of those that close the first in this order, else the fastest."""
    pushed: dict[int, None] = {}
    is_forked, first_row = False, free.modes.bounded
    for count in range(MOST_IMPACTS):
        closing = _closing(free, touching)
        if not closing:
            return Impacts(free, tuple(pushed), is_forked)
        dead = [j for j in touching if free.facts.restitutions[j] == 0.0]
        if set(closing) <= set(dead) and (len(closing) > 1 or (count >= MANY_IMPACTS and len(dead) == len(touching))):
            caught = _caught(free, dead)
            if caught is not None:
                free = caught.state
                pushed |= dict.fromkeys(caught.pushed)
                if set(_closing(free, touching)) <= set(dead):
                    return Impacts(free, tuple(pushed), is_forked)
                continue
        is_forked |= len(closing) > 1
        j = next((each for each in order if each in closing), closing[0])
        e = 0.0 if _rests(free, first_row + j, j) else free.facts.restitutions[j]
        free = free.pushed(first_row + j, -(1.0 + e) * free.facts.w[first_row + j])
        pushed[j] = None
    raise UnsettledError


def _closing(free: ModeState, touching: Sequence[int]) -> list[int]:
    """Those of the contacts that close, the fastest first."""
    first = free.modes.bounded
    rates = {j: free.facts.w[first + j] / free.rate_along(first + j) for j in touching}
    return sorted((j for j in touching if rates[j] < -STILL), key=rates.__getitem__)


def _require_agreement(free: ModeState, touching: Sequence[int], v: Floats) -> None:
    """Raises UndeterminedError unless impacts in other orders lead to the same rates, shape (n,)."""
    for order in _orders(touching):
        try:
            other = _in_turn(free, touching, order).state.v
        except UnsettledError:
            raise UndeterminedError from None
        if (np.abs(other - v) > AGREE * free.sizes_of_rates).any():
            raise UndeterminedError


def _orders(touching: Sequence[int]) -> Iterator[Sequence[int]]:
    """All orders of a few contacts; of more those that begin with each of them, to and fro."""
    if len(touching) <= FEW:
        yield from permutations(touching)
        return
    for k in range(len(touching)):
        turned = [*touching[k:], *touching[:k]]
        yield from (turned, turned[::-1])


def _caught(current: ModeState, contacts: Sequence[int]) -> Impacts | None:
    """The state behind impacts at once that lose all of their rates; None if not found, of contacts that are dependent.

    It is what impacts one after the other come to, which may take very many.
    """
    rows = [current.modes.bounded + j for j in contacts]
    moved: Floats = np.array([current.moved_by(current.facts.a[row]) for row in rows])
    flexibility, rates = current.facts.a[rows] @ moved.T, np.array([current.facts.w[row] for row in rows])
    least = np.array([STILL * current.rate_along(row) for row in rows])
    closing = np.zeros(len(rows), dtype=bool)
    for _ in range(MOST_IMPACTS):
        impulses = np.zeros(len(rows))
        part = flexibility[np.ix_(closing, closing)]  # singular where contacts depend on each other
        impulses[closing] = np.linalg.lstsq(part, -rates[closing], rcond=ROUNDING * len(rows))[0]
        wrong = np.flatnonzero(np.where(closing, impulses < 0.0, rates + flexibility @ impulses < -least))
        if not wrong.size:
            pushed = tuple(j for j, impulse in zip(contacts, impulses.tolist(), strict=True) if impulse > 0.0)
            return Impacts(current.with_rates(current.v + impulses @ moved), pushed)
        closing[wrong[0]] = not closing[wrong[0]]
    return None


def _require_direction(current: ModeState, contact: int) -> None:
    """Raises NoDirectionError for a contact without a gradient."""
    row = current.facts.a[current.modes.bounded + contact]
    if not float(row @ current.moved_by(row)) > NOTHING * float(row @ np.linalg.solve(current.mass, row)):
        raise NoDirectionError(contact)


def _without_lifts(free: ModeState, touching: Sequence[int]) -> ModeState:
    """The state with contacts at rest that would lift, and fall back, by less than can be told.

    What rocks to and fro between contacts would do so ever faster, without coming to rest.
    """
    still = [j for j in touching if _is_low(free, j, free.facts.w[free.modes.bounded + j], 1.0)]
    rows = [free.modes.bounded + j for j in still]
    if not any(free.facts.w[row] > 0.0 for row in rows):
        return free
    moved: Floats = np.array([free.moved_by(free.facts.a[row]) for row in rows])
    rates = np.array([free.facts.w[row] for row in rows])
    impulses = np.linalg.lstsq(free.facts.a[rows] @ moved.T, -rates, rcond=ROUNDING * len(rows))[0]
    return free.with_rates(free.v + impulses @ moved)


def _rests(current: ModeState, row: int, contact: int) -> bool:
    """Whether the rebound would be lower than can be told from rest: it loses 1 − e² of what rounding lifts it by."""
    e = current.facts.restitutions[contact]
    return _is_low(current, contact, e * current.facts.w[row], 1.0 - e * e)


def _is_low(current: ModeState, contact: int, rate: float, lost: float) -> bool:
    """Whether a contact that opens at a rate is pulled back before it can be told; a part of its energy is lost."""
    facts, row = current.facts, current.modes.bounded + contact
    pull = -float(facts.a[row] @ current.accelerations + facts.bias[row])
    if not pull > 0.0:
        return False
    height, size = rate * rate / (2.0 * pull), current.place_along(row)
    # where the contact is that moves with the time
    unknown = TICKS * math.ulp(current.time) * abs(float(facts.w[row] - facts.a[row] @ current.v))
    return height <= LOWEST * size + unknown and height * lost <= HEIGHT * size + unknown
