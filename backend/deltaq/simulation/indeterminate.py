"""Statically indeterminate forces: what holds at rest together, of which the equations of motion give no single value.

Constraints, friction that sticks and contacts that rest exert Aᵀλ, a row of A for each. With Aᵀc = 0 the forces λ + s c
move the system as λ does, so that none with cᵢ ≠ 0 is determined, as long as |λ| ≤ F₀ of frictions and λ ≥ 0 of
contacts leave it a way to go. Two blocks that a rod links and that both stick are an example: what they take of a load,
and the rod, depends on how they came to rest, and on how stiff they are.
Sources: Pfeiffer, Glocker, Multibody Dynamics with Unilateral Contacts, §5.1 (dependent constraints); Schrijver,
Theory of Linear and Integer Programming, §§7.1, 8.2 (Carathéodory's theorem, implicit equalities).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations, groupby

import numpy as np
from numpy.typing import NDArray

from ..model.modes import Modes, modes_of_model
from .least_sizes import least_sizes
from .mode_state import ModeState, in_mode_of
from .problem import Floats, Problem, Stretch, numbers_of_stretches
from .sliding import ALONG, later, rate_of, unclear_rate, unit_row
from .transitions import TINY

SHARE = 1e-6  # of a force in a combination without effect
UNCLEAR = 1e-9  # of the forces: so close to its bound a force is at it


@dataclass(frozen=True)
class IndeterminateSpan:
    """From `start` to `end`, in seconds, the forces of these names are not determined."""

    names: tuple[str, ...]
    start: float
    end: float


@dataclass(frozen=True)
class IndeterminateForces:
    """By stretch of a motion, the forces that are not determined: of friction, constraints, contacts, and of what is
    released.
    """

    stretches: tuple[Stretch, ...]
    names: tuple[tuple[str, ...], ...]

    def spans(self, end: float) -> list[IndeterminateSpan]:
        """When which forces are not determined, up to `end` in seconds; stretches of the same forces are one span."""
        starts = [each.start for each in self.stretches]
        parts = zip(self.names, starts, [*starts, end][1:], strict=True)
        spans = []
        for names, several in groupby(parts, key=lambda part: part[0]):
            first, *others = several
            last = others[-1] if others else first
            if names and first[1] < end:
                spans.append(IndeterminateSpan(names, first[1], last[2]))
        return spans

    def where(self, name: str, times: Floats) -> NDArray[np.bool_]:
        """The samples at which the force of this name is not determined; both have shape (samples,)."""
        if not any(name in names for names in self.names):
            return np.zeros(len(times), dtype=bool)
        is_open = np.array([name in names for names in self.names])
        return np.asarray(is_open[numbers_of_stretches(times, self.stretches)])


def indeterminate_forces(problem: Problem, stretches: tuple[Stretch, ...]) -> IndeterminateForces:
    """Which forces of a motion are not determined while parts of it stick or rest.

    Multipliers that are not unique in the whole motion, for constraints that depend on each other, are not told here.
    """
    modes, rivals = modes_of_model(problem.model), _rivals(problem)
    if modes is None or not stretches or not _may_be_dependent(modes, stretches[0].problem):
        whole = stretches or (Stretch(0.0, problem),)
        return IndeterminateForces(whole, (rivals,) * len(whole))
    least = least_sizes(in_mode_of(stretches[0].problem, modes, 0.0))
    names = ((*_names(in_mode_of(each.problem, modes, each.start, least)), *rivals) for each in stretches)
    return IndeterminateForces(stretches, tuple(tuple(dict.fromkeys(each)) for each in names))


def _rivals(problem: Problem) -> tuple[str, ...]:
    """What was released and is held by friction as well."""
    released = problem.released
    if released is None:
        return ()
    return tuple(name for name, has in zip(released.names, released.held_by.has_rival, strict=True) if has)


def _may_be_dependent(modes: Modes, problem: Problem) -> bool:
    """Whether there are several rows, not all of them constraints."""
    return modes.rows > 0 and modes.rows + len(problem.model.layout.multipliers) > 1


def _names(current: ModeState) -> tuple[str, ...]:
    """The forces that are not determined at a state, frictions first, then multipliers and contacts."""
    problem, modes = current.problem, current.modes
    multipliers = problem.model.layout.multipliers
    rows = [row for row in range(modes.rows) if current.mode.flags[row] or _rests(current, row)]
    if len(rows) + len(multipliers) < 2:
        return ()
    known = problem.moved.undetermined if problem.moved else ()
    along = [*current.kept[0], *(current.facts.along[row] for row in rows)]
    ways = [0.0] * len(multipliers) + [_way_left(current, row) for row in rows]
    free = _without_effect(np.array([unit_row(current, each) for each in along]), np.array(ways))
    own = (*multipliers, *(_name(modes, row) for row in rows))
    is_open = np.abs(free).max(axis=1, initial=0.0) > SHARE
    found = {name for name, each in zip(own, is_open, strict=True) if each and name and name not in known}
    ordered = (*modes.frictions, *multipliers, *(_name(modes, row) for row in range(modes.bounded, modes.rows)))
    return (*(name for name in ordered if name in found), *_of_released(current, rows, np.array(along), free))


def _of_released(current: ModeState, rows: list[int], along: Floats, free: Floats) -> Iterator[str]:
    """What was released and changes with forces that move nothing; see `_without_effect` for `free`."""
    released = current.problem.released
    if released is None:
        return
    flags = tuple(float(row in rows) for row in range(current.modes.rows))
    first, count = len(current.q), len(current.kept[0])
    acting = [first + k for k in (*range(count), *(count + row for row in rows))]
    shares = released.held_by.shares(current.with_flags(flags).row)[:, acting]
    changes = shares / np.array([float(np.linalg.norm(row)) or 1.0 for row in current.in_one_unit(along)])
    is_open = np.abs(changes @ free).max(axis=1, initial=0.0) > SHARE * np.abs(changes).max(axis=1, initial=0.0)
    known = current.problem.moved.undetermined if current.problem.moved else ()
    yield from (name for name, each in zip(released.names, is_open, strict=True) if each and name not in known)


def _name(modes: Modes, row: int) -> str:
    """Of a load with friction, or of a contact; none of a switch."""
    if row >= modes.bounded:
        return modes.scene.events[modes.contacts[row - modes.bounded]].name
    return modes.frictions[row] if row < len(modes.frictions) else ""


def _rests(current: ModeState, row: int) -> bool:
    """Whether what a row could hold stays at rest: a friction that does not slip, a contact that does not open.

    None of the row is needed for that, as constraints and other rows see to it, or nothing drives it away. What has
    just begun to slip is told from it a moment later.
    """
    facts, modes = current.facts, current.modes
    if row >= modes.bounded:
        is_there = row - modes.bounded in current.touching
    else:
        is_there = row < len(modes.frictions) and facts.limits[row] > 0.0
    if not is_there or abs(facts.w[row]) > TINY * current.rate_along(row):
        return False
    behind = later(current)
    return all(abs(rate_of(each, row)) <= unclear_rate(each, row) for each in (current, behind))


def _way_left(current: ModeState, row: int) -> float:
    """The only way, 1 or −1, in which a force at its bound may be another one; 0 if it may be more and less."""
    facts, modes, unclear = current.facts, current.modes, UNCLEAR * current.size_of_forces
    if row >= modes.bounded:
        return 1.0 if facts.reactions[row] <= unclear else 0.0
    if row >= len(modes.frictions):
        return 0.0
    force = float(modes.facts.at(current.row)[row - len(modes.frictions)])
    return -float(np.sign(force)) if abs(force) >= facts.limits[row] - unclear else 0.0


def _without_effect(forces: Floats, ways: Floats) -> Floats:
    """Combinations of forces that add up to zero and go the ways that are left: shape (forces, combinations).

    `forces` has shape (forces, n), `ways` (forces,). Some bounds may leave no way but to stay.
    """
    vectors, sizes, _ = np.linalg.svd(forces)
    without_effect = vectors[:, np.count_nonzero(sizes > ALONG) :]
    bound = (without_effect * ways[:, None])[np.abs(without_effect * ways[:, None]).max(axis=1, initial=0.0) > SHARE]
    stay = [row for row in range(len(bound)) if _is_opposed(bound, row)]
    if stay:
        _, sizes, directions = np.linalg.svd(bound[stay])
        without_effect = without_effect @ directions[np.count_nonzero(sizes > ALONG) :].T
    return np.asarray(without_effect)


def _is_opposed(rows: Floats, row: int) -> bool:
    """Whether others rule out that a · s > 0, if rows · s ≥ 0 is to hold for all: −a is then their sum with y ≥ 0.

    By Carathéodory independent rows are enough. `rows` has shape (rows, k).
    """
    others = [k for k in range(len(rows)) if k != row]
    for count in range(1, rows.shape[1] + 1):
        for chosen in combinations(others, count):
            part = rows[list(chosen)].T
            weights = np.linalg.lstsq(part, -rows[row], rcond=None)[0]
            left = np.abs(part @ weights + rows[row]).max()
            if (weights >= -SHARE).all() and left <= SHARE * np.abs(rows[row]).max():
                return True
    return False
