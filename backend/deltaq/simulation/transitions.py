"""What an event does to a motion that goes on: impacts (`impact`), sticking and slipping, contacts that rest and open,
kinks, switches along which it slides.

Which rows are held behind it follows from their reactions: what sticks needs no more than F₀, what rests is pushed.
Source: Pfeiffer, Glocker, Multibody Dynamics with Unilateral Contacts, ch. 4–8.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from ..model.modes import Modes
from .impact import ROUNDING, STILL, TICKS, after_impacts
from .least_sizes import least_sizes
from .mode_state import TOUCHING, Facts, Mode, ModeState
from .problem import Floats, Problem
from .sliding import ALONG, SLACK, draws, leaves, on_side, rate_of, settled, side_left_to, unkept

OFF_KINK = 1e-14  # how far a motion goes off a kink that is taken for rest in it, relative to the coordinates
LATE = 1e-7  # of the span; so much behind the zero of a gap its event is found at most
HARDLY = 1e-13  # of a rate of slipping
TINY = 1e-9  # of the rates: what rounding left at an event is no more
NUDGE = 1e-6  # of the coordinates: for slopes by differences, which are right to about as much


@dataclass(frozen=True)
class Transition:
    """An event behind which the motion went on: its name, time in seconds, kind, and the energy that was lost in J.

    `before` and `after` are the states on both sides of it, shape (width,). One that `ends_many` is the last that was
    followed of events that pile up: how far away the last of all is, is not known. `together` are further contacts that
    pushed at that time, in this order.
    """

    name: str
    time: float
    kind: str
    before: Floats
    after: Floats
    loss: float = 0.0
    error: float | None = None
    ends_many: bool = False
    together: tuple[str, ...] = ()


class ModeEvent(NamedTuple):
    """The state behind an event, what it happened to, its kind, and further contacts that pushed, in this order."""

    state: ModeState
    name: str
    kind: str
    together: tuple[str, ...] = ()


class BoundError(Exception):
    """A friction that would drive what slips, or would have to hold it with less than it slips against."""

    def __init__(self, friction: int, *, drives: bool) -> None:
        super().__init__(friction)
        self.friction, self.drives = friction, drives


def with_signs(problem: Problem, modes: Modes) -> Problem:
    """The problem with all signs positive and nothing held."""
    return replace(problem, parameters=(*problem.parameters, *_empty(modes).parameters))


def _empty(modes: Modes) -> Mode:
    return Mode((1.0,) * len(modes.kinks), (1.0,) * modes.bounded, (0.0,) * modes.rows, (0.0,) * modes.watched)


def begun(problem: Problem, modes: Modes, closed: float = TOUCHING) -> ModeState:
    """The initial state in its mode, without offsets, of a motion for which gaps as small as `closed` are closed.

    Raises UnsettledError, NoDirectionError, UndeterminedError or SlidingError where it has none.
    """
    n, state, empty = problem.degrees, problem.state, _empty(modes)
    own = with_signs(problem, modes)
    current = ModeState(own, modes, 0.0, state[:n].copy(), state[n : 2 * n].copy(), empty, closed=closed)
    current = replace(current, least=least_sizes(current))
    kinks, pins = (tuple(-1.0 if s < 0.0 else 1.0 for s in each) for each in (current.facts.kinks, current.facts.pins))
    current = current.within(empty._replace(kinks=kinks, slips=(*empty.slips[: modes.first_pin], *pins)))
    touching = current.touching
    return _resolved(after_impacts(current, touching[0]).state if touching else current, frozenset(touching), None)


def passed(current: ModeState, watched: int) -> ModeEvent:
    """The state behind an event of a watched value that goes on, the name of what it happened to, and its kind.

    Its offsets are still those from before (`with_offsets`). Raises BoundError where friction becomes negative.
    """
    modes, ending, mode = current.modes, len(current.modes.ending), current.mode
    if watched >= modes.first_bound:
        raise BoundError(modes.bounds[watched - modes.first_bound], drives=True)
    place = watched - ending
    if place < len(modes.kinks):
        contact = _contact_before(current, lambda facts: facts.kinks[place], mode.kinks[place])
        if contact is not None and not mode.flags[modes.bounded + contact]:
            return _met(current, contact)
        kinks = tuple(-sign if k == place else sign for k, sign in enumerate(mode.kinks))
        return _switched(current.within(mode._replace(kinks=kinks)))
    place -= len(modes.kinks)
    if place < 2 * modes.bounded:
        return _come_or_gone(current, place // 2)
    j = place - 2 * modes.bounded
    if mode.flags[modes.bounded + j]:
        row = modes.bounded + j  # a gap that was kept has no rate but what steps left of it
        found = _resolved(_without_rate(current, row), frozenset(), row)
        return ModeEvent(found, _name(modes, j), "release") if leaves(found, row) else ModeEvent(found, "", "switch")
    return _met(current, j)


def _come_or_gone(current: ModeState, row: int) -> ModeEvent:
    """The state behind a friction or a switch that comes to zero, or is held there no longer."""
    modes = current.modes
    is_switch, name = row >= len(modes.frictions), modes.name_of(row)
    if current.mode.flags[row]:
        found = _resolved(current, frozenset(), row)
        if is_switch:
            return ModeEvent(found, name, "leave")
        return ModeEvent(found, name, "slip") if leaves(found, row) else ModeEvent(found, "", "switch")
    if row >= modes.first_pin:
        return _pinned(current, row, name)
    sign = current.mode.slips[row]
    stopped = _at_zero(current, sign * current.facts.w[row], sign * rate_of(current, row), 0.0)
    found = _resolved(_without_rate(stopped, row), frozenset(), None, row)
    if found.mode.flags[row]:
        return ModeEvent(found, name, "slide" if is_switch else "stick")
    return ModeEvent(found, "", "switch") if is_switch else ModeEvent(found, name, "turn")


def _pinned(current: ModeState, row: int, name: str) -> ModeEvent:
    """The state behind a kink of places at which a force jumps: at rest in it, or behind it."""
    modes, sign = current.modes, current.mode.slips[row]
    pin = row - modes.first_pin
    contact = _contact_before(current, lambda facts: facts.pins[pin], sign)
    if contact is not None and not current.mode.flags[modes.bounded + contact]:
        return _met(current, contact)
    if _lies_in(current, row):
        still = current.pushed(row, -current.facts.w[row])
        found = _resolved(still, frozenset(), None, row)
        return ModeEvent(found, name, "slide") if found.mode.flags[row] else ModeEvent(found, "", "switch")
    return _switched(on_side(current, row, -sign))


def _switched(current: ModeState) -> ModeEvent:
    """The other side of a kink, of which nothing is told."""
    return ModeEvent(_resolved(current, frozenset(), None), "", "switch")


def _lies_in(current: ModeState, row: int) -> bool:
    """Whether forces on both sides drive a motion back to a kink, and it goes off it by less than can be told."""
    behind = on_side(current, row, -current.mode.slips[row])
    rate, pull = current.facts.w[row], -float(np.sign(current.facts.w[row])) * rate_of(behind, row)
    return bool(
        draws(current, row) and pull > 0.0 and rate * rate / (2.0 * pull) <= OFF_KINK * current.place_along(row)
    )


def _without_rate(current: ModeState, row: int) -> ModeState:
    """The state with what rounding left of a rate taken away; where that is not done by a tiny impulse, as it is."""
    along = current.facts.a[row]
    moved = current.moved_by(along)
    lift = float(along @ moved)
    if not lift > 0.0:
        return current
    v = current.v + moved * (-current.facts.w[row] / lift)
    is_tiny = bool((np.abs(v - current.v) <= TINY * current.sizes_of_rates).all())
    return current.with_rates(v) if is_tiny else current


def _met(current: ModeState, contact: int) -> ModeEvent:
    """What happens behind a contact that has closed, with others that touch."""
    impacts = after_impacts(_closed(current, contact), contact)
    found = _resolved(impacts.state, frozenset({contact}), None)
    first, *others = impacts.pushed or (contact,)
    rests = found.mode.flags[current.modes.bounded + first]
    names = tuple(_name(current.modes, each) for each in others)
    return ModeEvent(found, _name(current.modes, first), "rest" if rests else "impact", names)


def _name(modes: Modes, contact: int) -> str:
    return modes.scene.events[modes.contacts[contact]].name


def _contact_before(current: ModeState, value: Callable[[Facts], float], sign: float) -> int | None:
    """The contact behind which the other side of a kink lies, where it touches: by rounding the kink is met first.

    `value` is that of the kink, `sign` the side that the motion is on.
    """
    facts, steps = current.facts, NUDGE * current.sizes_of_places
    beside = [current.at(current.time, current.q + each, current.v) for each in np.diag(steps)]
    slope = np.array([value(each.facts) - value(facts) for each in beside])
    for j in current.touching:
        row = facts.a[current.modes.bounded + j] * steps
        if row.any():
            share = float(slope @ row) / float(row @ row)
            left = float(np.linalg.norm(slope - share * row))
            if share * sign > 0.0 and left <= NUDGE * float(np.linalg.norm(slope)):
                return j
    return None


def _closed(current: ModeState, contact: int) -> ModeState:
    """The state when a gap was zero; `current` is that when it was less by its offset.

    What rounding leaves of the gap is taken away: rebounds that are as low would sink behind the contact one by one.
    """
    facts, row = current.facts, current.modes.bounded + contact
    bend = float(facts.a[row] @ current.accelerations + facts.bias[row])
    found = _at_zero(current, facts.gaps[contact], facts.w[row], bend)
    gap, along = found.facts.gaps[contact], found.moved_by(found.facts.a[row])
    lift = float(found.facts.a[row] @ along)
    if not (-TOUCHING * found.place_along(row) <= gap < 0.0 and lift > 0.0):
        return found
    return found.at(found.time, found.q - gap / lift * along, found.v)


def _at_zero(current: ModeState, value: float, rate: float, bend: float) -> ModeState:
    """The state when a value that fell, with its first two time derivatives, was zero.

    What is left of its fall, v(t − s) = v − v̇ s + v̈ s²/2 = 0, is not fallen once more with each rebound: that would
    feed small ones for ever.
    """
    square = rate * rate - 2.0 * bend * value
    late = 2.0 * value / (rate - math.sqrt(square)) if rate < 0.0 and square >= 0.0 else 0.0
    if not 0.0 < late < LATE * current.problem.t_end:
        return current
    late = min(late, current.time)  # nothing is before the beginning
    a = current.accelerations
    q, v = current.q - late * (current.v - 0.5 * late * a), current.v - late * a
    return current.at(current.time - late, q, v)


def _resolved(current: ModeState, closed: frozenset[int], released: int | None, come: int | None = None) -> ModeState:
    """The mode that a state goes on in: rows at rest are held as long as their reactions can, the rest moves.

    `come` is the friction or switch that is at zero now. Raises SlidingError where switches do not tell.
    """
    modes, bounded = current.modes, current.modes.bounded
    held = _at_rest(current, closed, released, come)
    facts = current.facts
    slips = [
        s
        if held[row] or row >= modes.first_pin or abs(facts.w[row]) <= HARDLY * current.rate_along(row)
        else _sign(facts.w[row])
        for row, s in enumerate(current.mode.slips)
    ]
    if released is not None and released < bounded:
        slips[released] = -_sign(facts.reactions[released]) or 1.0
    at_zero = [row for row in range(bounded) if held[row] or row == released]
    resting = [row for row in range(bounded, modes.rows) if held[row] or row == released]
    for row in range(modes.rows):
        if held[row] and current.facts.w[row] != 0.0:
            current = _without_rate(current, row)
    sticking = list(held[:bounded])
    for _ in range(2 * modes.rows + 2):
        across = _held_by_others(current, held, sticking)
        held[:bounded] = [sticks and not across[k] for k, sticks in enumerate(sticking)]
        slips = [across[k] or slip for k, slip in enumerate(slips)]
        found = current.with_rows(slips, held)
        lost = _lost(found, held)
        if lost is None:
            break
        held[lost] = False
        if lost < bounded:
            sticking[lost] = False
            slips[lost] = _left(found, lost, has_come=lost == come)
    else:
        found = current.with_rows(slips, held)
    return settled(found, [row for row in at_zero if not across[row]], resting)


def _at_rest(current: ModeState, closed: frozenset[int], released: int | None, come: int | None) -> list[bool]:
    """By row, whether it may be held: what slips does not, and contacts that touch and do not open.

    At a dead centre what slips moves with no coordinate, so that no force along it could hold it.
    """
    modes, facts, touching = current.modes, current.facts, current.touching
    least = [TINY if flag else HARDLY for flag in current.mode.flags]  # what sticks may have been moved by an impact
    held = [
        bool(facts.a[row] @ facts.a[row] > 0.0)
        and (abs(facts.w[row]) <= least[row] * current.rate_along(row) or row == come)
        for row in range(modes.bounded)
    ]
    for row in range(modes.first_pin, modes.bounded):
        held[row] &= abs(facts.pins[row - modes.first_pin]) <= ROUNDING * current.place_along(row)
    for j in range(len(modes.contacts)):
        row = modes.bounded + j
        touches = j in closed or current.mode.flags[row] or j in touching
        held.append(bool(touches and abs(facts.w[row]) <= 10.0 * STILL * current.rate_along(row)))
    if released is not None:
        held[released] = False
    return held


def _left(current: ModeState, row: int, *, has_come: bool) -> float:
    """The side to which a friction or switch goes that is not held after all."""
    if unkept(current, [row == k for k in range(current.modes.rows)]) == row:
        return side_left_to(current, row, has_come=has_come)
    return -_sign(current.facts.reactions[row])


def _sign(value: float) -> float:
    """1 or −1; what is neither positive nor negative is its own."""
    return 1.0 if value > 0.0 else -1.0 if value < 0.0 else value


def _held_by_others(current: ModeState, held: list[bool], sticking: list[bool]) -> list[float]:
    """Of each friction or switch 0, or its side as what holds all that it would hold lets go.

    A slide at its stop is held by both, and what each takes is not determined. The contact takes it, with the friction
    that an opening would meet: it holds up to where that does no longer. So does a kink of places that it lies in.
    """
    modes = current.modes
    contacts = [row for row in range(modes.bounded, modes.rows) if held[row]]
    pins = [row for row in range(modes.first_pin, modes.bounded) if held[row]]
    if not (contacts or pins):
        return [0.0] * len(sticking)
    return [
        _share(current, k, contacts if k >= modes.first_pin else [*pins, *contacts]) if sticks else 0.0
        for k, sticks in enumerate(sticking)
    ]


def _share(current: ModeState, row: int, others: list[int]) -> float:
    """0 for a row that others do not hold as well, else which way it goes with them."""
    if not others:
        return 0.0
    rows, own = current.in_one_unit(current.facts.a[others]).T, current.in_one_unit(current.facts.a[row])
    shares = np.linalg.lstsq(rows, own, rcond=None)[0]
    left = float(np.linalg.norm(own - rows @ shares))
    if left > ALONG * float(np.linalg.norm(own)):
        return 0.0
    return 1.0 if shares.sum() >= 0.0 else -1.0


def _lost(current: ModeState, held: list[bool]) -> int | None:
    """The first row that is not held after all: no force between both sides, one too small, a contact that pulls."""
    if not any(held):
        return None
    facts, bounded = current.facts, current.modes.bounded
    lost = unkept(current, held)
    if lost is not None:
        return lost
    for k in range(bounded):
        if held[k] and abs(facts.reactions[k]) > facts.limits[k] * (1.0 + SLACK):
            return k
    return next((row for row in range(bounded, current.modes.rows) if held[row] and facts.reactions[row] <= 0.0), None)


def _moved_by_time(current: ModeState) -> list[float]:
    """By watched value, how far it moves while the time goes on by what rounding does to it."""
    if not current.modes.watches_time:
        return [0.0] * current.modes.watched
    later = current.at(current.time + TICKS * math.ulp(current.time), current.q, current.v)
    return [abs(there - here) for there, here in zip(later.watched.tolist(), current.watched.tolist(), strict=True)]


def _row_watched(modes: Modes, place: int) -> int:
    """The row whose value is watched at a place behind those of endings and kinks: each friction or switch has two."""
    place -= len(modes.ending) + len(modes.kinks)
    return place // 2 if place < 2 * modes.bounded else place - modes.bounded


def with_offsets(current: ModeState) -> ModeState:
    """Offsets that make all watched values positive: what has just happened does not happen again at once.

    What moves with the time alone, a table say, is somewhere else by what rounding does to the time.
    """
    modes, mode = current.modes, current.mode
    plain = current if not any(mode.offsets) else current.offset_by((0.0,) * modes.watched)
    values, moved = plain.watched.tolist(), _moved_by_time(plain)
    ending = len(modes.ending)
    first = ending + len(modes.kinks)
    pins = first + 2 * modes.first_pin
    offsets = []
    for place, value in enumerate(values):
        if place >= modes.first_bound or (place >= first and mode.flags[_row_watched(modes, place)]):
            room = HARDLY * current.size_of_forces
        elif place < first:
            room = ROUNDING * float(current.sizes_of_places.max())
        elif place < pins:
            room = HARDLY * current.rate_along(_row_watched(modes, place))
        else:
            room = ROUNDING * current.place_along(_row_watched(modes, place))
        room += moved[place]
        offsets.append(0.0 if place < ending or value > room else room - min(value, 0.0))
    return plain.offset_by(tuple(offsets)) if any(offsets) else plain
