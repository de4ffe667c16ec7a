"""What an event does to a motion that goes on: impacts, sticking and slipping, contacts that rest and open, kinks.

At an impact the momenta jump along the gradient of the gap, p⁺ − p⁻ = Λ ∂g/∂q, such that the gap opens e times as fast
as it closed: Λ = −(1 + e) ġ/(∂g/∂q M⁻¹ ∂g/∂qᵀ). Which rows are held behind it follows from their reactions: what sticks
needs no more than F₀, what rests is pushed. Several contacts at once are taken one after the other. Constraints answer
with impulses of their own, A q̇⁺ = A q̇⁻: M⁻¹ is then that part of the inverse of [M Aᵀ; A 0].
Source: Pfeiffer, Glocker, Multibody Dynamics with Unilateral Contacts, ch. 4–8.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ..model.modes import Modes
from .problem import Floats, Problem

TOUCHING = 1e-11  # a gap, relative to the coordinates
STILL = 1e-12  # a rate, relative to the largest
HEIGHT = 1e-15  # by which rounding lifts a rebound, relative to the coordinates
LOWEST = 1e-12  # the highest rebound that is taken for rest, relative to the coordinates; of what loses nothing, too
LATE = 1e-6  # s; so much behind the zero of a gap its event is found at most
ROUNDING = 1e-15
HARDLY = 1e-13  # of a rate of slipping
SLACK = 1e-12  # relative, of a friction that holds
NOTHING = 1e-12  # of what an impulse would do without constraints: they take all of it
NUDGE = 1e-6  # of the coordinates: for slopes by differences, which are right to about as much
ALONG = 1e-9  # of a row: what is left of it besides the rows of contacts
MOST_IMPACTS = 1000  # one after the other at one time


@dataclass(frozen=True)
class Mode:
    """Signs of kinks and of slipping (−1 or 1), flags of rows (1: held), offsets of watched values."""

    kinks: tuple[float, ...]
    slips: tuple[float, ...]
    flags: tuple[float, ...]
    offsets: tuple[float, ...]

    @property
    def parameters(self) -> tuple[float, ...]:
        """As the model reads them, behind the scene's own."""
        return (*self.kinks, *self.slips, *self.flags, *self.offsets)


@dataclass(frozen=True)
class Transition:
    """An event behind which the motion went on: its name, time in seconds, kind, and the energy that was lost in J.

    `before` and `after` are the states on both sides of it, shape (width,).
    """

    name: str
    time: float
    kind: str
    before: Floats
    after: Floats
    loss: float = 0.0
    error: float | None = None


@dataclass(frozen=True)
class Facts:
    """What is known at a state.

    Of the rows `a`, shape (rows, n), the rates `w`, γ in `bias`, and λ in `reactions`, shape (rows,) each; F₀ in
    `limits`, shape (frictions,); `gaps` and e in `restitutions`, shape (contacts,); values of `kinks`, shape (kinks,).
    """

    a: Floats
    w: Floats
    bias: Floats
    limits: Floats
    gaps: Floats
    restitutions: Floats
    kinks: Floats
    reactions: Floats


@dataclass(frozen=True)
class ModeState:
    """A state (q, q̇) at a time, in a mode, of a problem in modes; `q` and `v` have shape (n,)."""

    problem: Problem
    modes: Modes
    time: float
    q: Floats
    v: Floats
    mode: Mode

    @property
    def row(self) -> Floats:
        """Inputs of the model's functions: shape (1, inputs)."""
        own = self.problem.parameters[: len(self.problem.parameters) - len(self.mode.parameters)]
        return np.array([[*self.q, *self.v, self.time, *own, *self.mode.parameters]])

    @cached_property
    def facts(self) -> Facts:
        """The rows with the flags of the mode."""
        n, rows, frictions = len(self.q), self.modes.rows, len(self.modes.frictions)
        found = self.modes.facts.table(self.row)[0]
        parts = found[: rows * (n + 2)].reshape(rows, n + 2)
        rest = found[rows * (n + 2) :]
        gaps = rest[frictions : frictions + 3 * len(self.modes.contacts)].reshape(-1, 3)
        end = frictions + gaps.size
        return Facts(
            parts[:, :n], parts[:, n], parts[:, n + 1], rest[:frictions], gaps[:, 0], gaps[:, 2],
            rest[end : end + self.modes.kinks], rest[end + self.modes.kinks : end + self.modes.kinks + rows],
        )  # fmt: skip

    @cached_property
    def mass(self) -> Floats:
        """M, shape (n, n)."""
        n = len(self.q)
        packed = self.problem.model.motion.table(self.row)[0]
        found, places = np.zeros((n, n)), np.tril_indices(n)
        found[places] = packed[: len(places[0])]
        return found + np.tril(found, -1).T

    @cached_property
    def kept(self) -> tuple[Floats, Floats]:
        """A, shape (m, n), and γ, shape (m,), of the scene's constraints."""
        n, layout = len(self.q), self.problem.model.layout
        m, first = len(layout.multipliers), n * (n + 1) // 2 + n + (n + 1 if layout.is_powered else 0)
        packed = self.problem.model.motion.table(self.row)[0]
        return packed[first : first + m * n].reshape(m, n), packed[first + m * n : first + m * n + m]

    def moved_by(self, forces: Floats, bends: Floats | None = None) -> Floats:
        """x of M x = forces + Aᵀλ, A x = bends (0 if not given): what forces, or impulses, do to q̈, or to q̇.

        `forces` and what is returned have shape (n,), `bends` shape (m,).
        """
        rows, count = self.kept[0], len(self.kept[0])
        if not count:
            return np.asarray(np.linalg.solve(self.mass, forces))
        matrix = np.block([[self.mass, rows.T], [rows, np.zeros((count, count))]])
        right = np.concatenate([forces, np.zeros(count) if bends is None else bends])
        return np.asarray(np.linalg.lstsq(matrix, right, rcond=None)[0][: len(self.q)])

    @cached_property
    def accelerations(self) -> Floats:
        """q̈ in this mode, shape (n,)."""
        n = len(self.q)
        packed = self.problem.model.motion.table(self.row)[0]
        return self.moved_by(packed[n * (n + 1) // 2 : n * (n + 1) // 2 + n], self.kept[1])

    @property
    def touching(self) -> list[int]:
        """The contacts that are closed, but for rounding."""
        return [j for j, gap in enumerate(self.facts.gaps) if gap <= TOUCHING * self.scale(j) * _size(self.q)]

    def scale(self, contact: int) -> float:
        """How far a gap changes with the coordinates, at most; 1 where it does not."""
        return float(np.abs(self.facts.a[len(self.modes.frictions) + contact]).max()) or 1.0

    @property
    def watched(self) -> Floats:
        """The values that are positive as long as the mode lasts, with its offsets: shape (watched,)."""
        return np.asarray(self.problem.model.events.table(self.row)[0])  # type: ignore[union-attr]

    @property
    def kinetic(self) -> float:
        """½ q̇ᵀ M q̇, up to what does not change at an impact."""
        return float(0.5 * self.v @ self.mass @ self.v)

    def with_flags(self, flags: tuple[float, ...]) -> ModeState:
        """The same state with other rows held."""
        return replace(self, mode=replace(self.mode, flags=flags))

    def pushed(self, row: int, change: float) -> ModeState:
        """The state behind an impulse along a row that changes its rate w by so much."""
        along = self.moved_by(self.facts.a[row])
        return replace(self, v=self.v + along * (change / (self.facts.a[row] @ along)))


class UnsettledError(Exception):
    """Contacts at once whose impacts one after the other do not end."""


class NoDirectionError(Exception):
    """A contact whose gap changes with no coordinate where it is closed: no impulse along ∂g/∂q can part it."""

    def __init__(self, contact: int) -> None:
        super().__init__(contact)
        self.contact = contact


def begun(problem: Problem, modes: Modes) -> ModeState:
    """The initial state in its mode."""
    n = problem.degrees
    state, empty = problem.state, Mode(
        (1.0,) * modes.kinks, (1.0,) * len(modes.frictions), (0.0,) * modes.rows, (0.0,) * modes.watched
    )  # fmt: skip
    own = replace(problem, parameters=(*problem.parameters, *empty.parameters))
    current = ModeState(own, modes, 0.0, state[:n].copy(), state[n : 2 * n].copy(), empty)
    kinks = tuple(-1.0 if kink < 0.0 else 1.0 for kink in current.facts.kinks)
    current = replace(current, mode=replace(empty, kinks=kinks))
    closed = current.touching
    return _resolved(_after_impacts(current, closed[0]) if closed else current, frozenset(closed), None)


def passed(current: ModeState, watched: int) -> tuple[ModeState, str, str]:
    """The state behind an event of a watched value that goes on, the name of what it happened to, and its kind."""
    modes, ending, mode = current.modes, len(current.modes.ending), current.mode
    place = watched - ending
    if place < modes.kinks:
        contact = _contact_before(current, place)
        if contact is not None and not mode.flags[len(modes.frictions) + contact]:
            return _met(current, contact)
        kinks = tuple(-sign if k == place else sign for k, sign in enumerate(mode.kinks))
        return _resolved(replace(current, mode=replace(mode, kinks=kinks)), frozenset(), None), "", "switch"
    place -= modes.kinks
    frictions = len(modes.frictions)
    if place < 2 * frictions:
        k = place // 2
        if mode.flags[k]:
            found = _resolved(current, frozenset(), k)
            return found, modes.frictions[k], "slip"
        facts = current.facts
        sign, rate = mode.slips[k], float(facts.a[k] @ current.accelerations + facts.bias[k])
        stopped = _at_zero(current, sign * float(facts.w[k]), sign * rate, 0.0)
        stopped = stopped.pushed(k, -float(stopped.facts.w[k]))
        found = _resolved(stopped, frozenset(), None)
        return found, modes.frictions[k], "stick" if found.mode.flags[k] else "turn"
    j = place - 2 * frictions
    if mode.flags[frictions + j]:
        return _resolved(current, frozenset(), frictions + j), _name(modes, j), "release"
    return _met(current, j)


def _met(current: ModeState, contact: int) -> tuple[ModeState, str, str]:
    """The state behind a contact that has closed, its name, and whether it rests."""
    closed = _closed(current, contact)
    found = _resolved(_after_impacts(closed, contact), frozenset({contact}), None)
    rests = found.mode.flags[len(current.modes.frictions) + contact]
    return found, _name(current.modes, contact), "rest" if rests else "impact"


def _name(modes: Modes, contact: int) -> str:
    return modes.scene.events[modes.contacts[contact]].name


def _contact_before(current: ModeState, kink: int) -> int | None:
    """The contact behind which the other side of a kink lies, where it touches: by rounding the kink is met first."""
    facts, step = current.facts, NUDGE * _size(current.q)
    beside = [replace(current, q=current.q + step * each) for each in np.eye(len(current.q))]
    slope = np.array([each.facts.kinks[kink] - facts.kinks[kink] for each in beside])
    for j in current.touching:
        row = facts.a[len(current.modes.frictions) + j]
        if row.any():
            share = float(slope @ row) / float(row @ row)
            left = float(np.linalg.norm(slope - share * row))
            if share * current.mode.kinks[kink] > 0.0 and left <= NUDGE * float(np.linalg.norm(slope)):
                return j
    return None


def _closed(current: ModeState, contact: int) -> ModeState:
    """The state when a gap was zero; `current` is that when it was less by its offset."""
    facts, row = current.facts, len(current.modes.frictions) + contact
    bend = float(facts.a[row] @ current.accelerations + facts.bias[row])
    return _at_zero(current, float(facts.gaps[contact]), float(facts.w[row]), bend)


def _at_zero(current: ModeState, value: float, rate: float, bend: float) -> ModeState:
    """The state when a value that fell, with its first two time derivatives, was zero.

    What is left of its fall, v(t − s) = v − v̇ s + v̈ s²/2 = 0, is not fallen once more with each rebound: that would
    feed small ones for ever.
    """
    square = rate**2 - 2.0 * bend * value
    late = 2.0 * value / (rate - math.sqrt(square)) if rate < 0.0 and square >= 0.0 else 0.0
    if not 0.0 < late < LATE:
        return current
    rates = current.accelerations
    q, v = current.q - late * (current.v - 0.5 * late * rates), current.v - late * rates
    return replace(current, time=current.time - late, q=q, v=v)


def _after_impacts(current: ModeState, first: int) -> ModeState:
    """The state behind the impact of a contact, and of others that it closes or that touch, one after the other."""
    frictions = len(current.modes.frictions)
    free = current.with_flags((0.0,) * current.modes.rows)
    resting = {j for j in range(len(current.modes.contacts)) if current.mode.flags[frictions + j]}
    touching = {first} | resting | set(free.touching)
    for j in touching:
        _require_direction(free, j)
    for _ in range(MOST_IMPACTS):
        rates = {j: float(free.facts.w[frictions + j]) for j in touching}
        j = min(rates, key=lambda each: rates[each] / free.scale(each))
        if rates[j] >= -STILL * free.scale(j) * _size(free.v):
            return replace(free, mode=current.mode)
        e = 0.0 if _rests(free, frictions + j, j) else float(free.facts.restitutions[j])
        free = free.pushed(frictions + j, -(1.0 + e) * rates[j])
    raise UnsettledError


def _require_direction(current: ModeState, contact: int) -> None:
    """Raises NoDirectionError for a contact without a gradient."""
    row = current.facts.a[len(current.modes.frictions) + contact]
    if not float(row @ current.moved_by(row)) > NOTHING * float(row @ np.linalg.solve(current.mass, row)):
        raise NoDirectionError(contact)


def _rests(current: ModeState, row: int, contact: int) -> bool:
    """Whether the rebound would be lower than can be told from rest: it loses 1 − e² of what rounding lifts it by."""
    facts = current.facts
    e = float(facts.restitutions[contact])
    rebound = e * float(facts.w[row])
    pull = -float(facts.a[row] @ current.accelerations + facts.bias[row])
    if not pull > 0.0:
        return False
    height, lost = rebound**2 / (2.0 * pull) / current.scale(contact), 1.0 - e**2
    return height <= LOWEST * _size(current.q) and height * lost <= HEIGHT * _size(current.q)


def _resolved(current: ModeState, closed: frozenset[int], released: int | None) -> ModeState:
    """The mode that a state goes on in: rows at rest are held as long as their reactions can, the rest moves."""
    modes, frictions = current.modes, len(current.modes.frictions)
    facts, size = current.facts, _size(current.v)
    slips = [
        s if abs(w) <= HARDLY * size else float(np.sign(w)) for s, w in zip(current.mode.slips, facts.w, strict=False)
    ]
    held = [abs(float(facts.w[k])) <= HARDLY * size for k in range(frictions)]
    touching = current.touching
    for j in range(len(modes.contacts)):
        row = frictions + j
        touches = j in closed or current.mode.flags[row] or j in touching
        held.append(bool(touches and abs(float(facts.w[row])) <= 10.0 * STILL * current.scale(j) * size))
    if released is not None:
        held[released] = False
        if released < frictions:
            slips[released] = -float(np.sign(facts.reactions[released])) or 1.0
    for row in range(modes.rows):
        if held[row] and facts.w[row] != 0.0:
            current = current.pushed(row, -float(facts.w[row]))
            facts = current.facts
    sticking = list(held[:frictions])
    for _ in range(2 * modes.rows + 2):
        across = _held_by_contacts(facts, held, sticking)
        held[:frictions] = [sticks and not across[k] for k, sticks in enumerate(sticking)]
        slips = [across[k] or slip for k, slip in enumerate(slips)]
        flags = tuple(float(h) for h in held)
        trial = replace(current, mode=replace(current.mode, flags=flags, slips=tuple(slips)))
        lost = _lost(trial, held)
        if lost is None:
            break
        held[lost] = False
        if lost < frictions:
            sticking[lost] = False
            slips[lost] = -float(np.sign(trial.facts.reactions[lost]))
    return _offset(replace(current, mode=replace(current.mode, flags=tuple(map(float, held)), slips=tuple(slips))))


def _held_by_contacts(facts: Facts, held: list[bool], sticking: list[bool]) -> list[float]:
    """Of each friction 0, or which way it slips as contacts open that hold all that it would hold.

    A slide at its stop is held by both, and what each takes is not determined. The contact takes it, with the friction
    that an opening would meet: it holds up to where that does no longer.
    """
    closed = [row for row in range(len(sticking), len(held)) if held[row]]
    found = [0.0] * len(sticking)
    for k, sticks in enumerate(sticking):
        if sticks and closed:
            rows = facts.a[closed].T
            shares = np.linalg.lstsq(rows, facts.a[k], rcond=None)[0]
            left = float(np.linalg.norm(facts.a[k] - rows @ shares))
            if left <= ALONG * float(np.linalg.norm(facts.a[k])):
                found[k] = 1.0 if shares.sum() >= 0.0 else -1.0
    return found


def _lost(current: ModeState, held: list[bool]) -> int | None:
    """The first row that is not held after all: friction that is too small, a contact that would pull."""
    facts, frictions = current.facts, len(current.modes.frictions)
    for k in range(frictions):
        if held[k] and abs(float(facts.reactions[k])) > float(facts.limits[k]) * (1.0 + SLACK):
            return k
    return next(
        (row for row in range(frictions, current.modes.rows) if held[row] and facts.reactions[row] <= 0.0), None
    )


def _offset(current: ModeState) -> ModeState:
    """Offsets that make all watched values positive: what has just happened does not happen again at once."""
    modes = current.modes
    plain = replace(current, mode=replace(current.mode, offsets=(0.0,) * modes.watched))
    ending, frictions = len(modes.ending), len(modes.frictions)
    first, last = ending + modes.kinks, ending + modes.kinks + 2 * frictions
    offsets = []
    for place, value in enumerate(plain.watched):
        room = HARDLY * _size(current.v) if first <= place < last else ROUNDING * _size(current.q)
        room *= current.scale(place - last) if place >= last else 1.0
        offsets.append(0.0 if place < ending or value > room else room - min(float(value), 0.0))
    return replace(current, mode=replace(current.mode, offsets=tuple(offsets)))


def _size(values: Floats) -> float:
    """The largest absolute value, 1 at least."""
    return max(1.0, float(np.max(np.abs(values), initial=0.0)))
