"""Statically indeterminate forces: what holds at rest together, of which the equations of motion give no single value.

Constraints, friction that sticks and contacts that rest exert Aᵀλ, a row of A for each. With Aᵀc = 0 the forces λ + s c
move the system as λ does, so that none with cᵢ ≠ 0 is determined, within |λ| ≤ F₀ of a friction and λ ≥ 0 of a contact.
Two blocks that a rod links and that both stick are an example: what they take of a load, and the rod, depends on how
they came to rest, and on how stiff they are.
Source: Pfeiffer, Glocker, Multibody Dynamics with Unilateral Contacts, §5.1 (dependent constraints).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby

import numpy as np
from numpy.typing import NDArray

from ..model.modes import Modes
from .mode_state import ModeState, in_mode_of
from .problem import Floats, Problem, Stretch, numbers_of_stretches
from .sliding import AGAINST, ALONG, jump_of, later, rate_of, unit_row
from .transitions import TINY, least_sizes

SHARE = 1e-6  # of a force in a combination without effect


@dataclass(frozen=True)
class IndeterminateSpan:
    """From `start` to `end`, in seconds, the forces of these names are not determined."""

    names: tuple[str, ...]
    start: float
    end: float


@dataclass(frozen=True)
class IndeterminateForces:
    """By stretch of a motion, the loads with friction, multipliers and contacts whose forces are not determined."""

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


def indeterminate_forces(modes: Modes | None, stretches: tuple[Stretch, ...]) -> IndeterminateForces:
    """Which forces of a motion are not determined while parts of it stick or rest.

    Multipliers that are not unique in the whole motion, for constraints that depend on each other, are not told here.
    """
    if modes is None or not stretches or not _may_be_dependent(modes, stretches[0].problem):
        return IndeterminateForces(stretches, ((),) * len(stretches))
    least = least_sizes(in_mode_of(stretches[0].problem, modes, 0.0))
    names = (_names(in_mode_of(each.problem, modes, each.start, least)) for each in stretches)
    return IndeterminateForces(stretches, tuple(names))


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
    forces = [*map(unit_row, current.kept[0]), *(unit_row(current.facts.along[row]) for row in rows)]
    loose = _without_effect(forces)
    own = (*multipliers, *(_name(modes, row) for row in rows))
    found = {name for name, is_open in zip(own, loose, strict=True) if is_open and name and name not in known}
    ordered = (*modes.frictions, *multipliers, *(_name(modes, row) for row in range(modes.bounded, modes.rows)))
    return tuple(name for name in ordered if name in found)


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
    still = TINY * float(np.abs(facts.a[row]).max()) * current.size_of_rates
    if not is_there or abs(facts.w[row]) > still:
        return False
    behind = later(current)
    return all(abs(rate_of(each, row)) <= AGAINST * jump_of(each, row) for each in (current, behind))


def _without_effect(forces: Sequence[Floats]) -> list[bool]:
    """Of each force, shape (n,), whether it is part of a combination that adds up to zero."""
    if not forces:
        return []
    vectors, sizes, _ = np.linalg.svd(np.array(forces))
    rank = int(np.count_nonzero(sizes > ALONG))
    return (np.abs(vectors[:, rank:]).max(axis=1, initial=0.0) > SHARE).tolist()  # type: ignore[no-any-return]
