"""Impulses at impacts: what contacts, constraints and what holds a released length exert in no time.

The momenta jump by M (q̇⁺ − q̇⁻) = Σ Λ ∂g/∂q + Aᵀμ. With l let go its own momentum would jump as well, unless an impulse
held it: Ẑ = Mₗ (q̇⁺ − q̇⁻) − Σ Λ ∂g/∂l − (Aᵀμ)ₗ, which is to Z what impulses are to forces.
Source: Pfeiffer, Glocker, Multibody Dynamics with Unilateral Contacts, ch. 8.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..model.modes import Modes, modes_of_model
from .mode_state import ModeState, in_mode_of
from .problem import Floats, Problem
from .sliding import ALONG
from .transitions import Transition, with_signs

SHARE = 1e-6  # of an impulse in a combination without effect
KEPT = 1e-6  # of the jump of the momenta, which the impulses are to make up for


def impulses_along(problem: Problem, transitions: Sequence[Transition]) -> tuple[Mapping[str, float], ...]:
    """By event, the impulses by name: Λ of contacts that pushed, μ of constraints, Ẑ of what was released.

    In units of the force times s. Those that are not unique are left out, and events that are no impact have none.
    """
    modes = modes_of_model(problem.model)
    if modes is None or not modes.contacts:
        return ({},) * len(transitions)
    signed = with_signs(replace(problem, model=modes.model), modes)
    return tuple(_impulses(signed, modes, each) if each.kind in ("impact", "rest") else {} for each in transitions)


def _impulses(problem: Problem, modes: Modes, impact: Transition) -> Mapping[str, float]:
    n, rows = problem.degrees, {modes.scene.events[index].name: j for j, index in enumerate(modes.contacts)}
    contacts = dict.fromkeys((impact.name, *impact.together))
    q, v = impact.before[:n], impact.before[n : 2 * n]
    start = replace(in_mode_of(problem, modes, impact.time), q=q, v=v)
    pushed = [rows[name] for name in contacts]
    touching = [*pushed, *(j for j in start.touching if j not in pushed)]  # which might have pushed instead
    current = start.with_flags((0.0,) * modes.bounded + tuple(float(j in touching) for j in range(len(modes.contacts))))
    along = current.in_one_unit(np.array([*current.kept[0], *(current.facts.a[modes.bounded + j] for j in touching)]))
    count, jump = len(current.kept[0]) + len(pushed), impact.after[n : 2 * n] - v
    momenta, found = current.in_one_unit(current.mass @ jump), np.zeros(len(along))
    found[:count] = np.linalg.lstsq(along[:count].T, momenta, rcond=ALONG)[0]
    if np.abs(along.T @ found - momenta).max() > KEPT * np.abs(momenta).max():
        return {}
    released = _of_released(current, touching)
    of_forces = np.vstack([np.eye(count, len(along)), released[:, n:]])
    impulses = of_forces @ found
    impulses[count:] += released[:, :n] @ jump
    names = (*problem.model.layout.multipliers, *contacts, *(problem.released.names if problem.released else ()))
    return {
        name: float(impulse)
        for name, impulse, unique in zip(names, impulses, _are_unique(along, of_forces), strict=True)
        if unique
    }


def _of_released(current: ModeState, contacts: list[int]) -> Floats:
    """How Z changes with q̈, λ of constraints and of some contacts: shape (names, those)."""
    n, constraints, released = len(current.q), len(current.kept[0]), current.problem.released
    if released is None:
        return np.zeros((0, n + constraints + len(contacts)))
    first = n + constraints + current.modes.bounded
    return released.held_by.shares(current.row)[:, [*range(n + constraints), *(first + j for j in contacts)]]


def _are_unique(along: Floats, of_forces: Floats) -> NDArray[np.bool_]:
    """Whether each quantity, of which `of_forces` tells the change with forces `along` rows, is the same for all λ."""
    lengths = np.linalg.norm(along, axis=1)
    lengths[lengths == 0.0] = 1.0
    vectors, sizes, _ = np.linalg.svd(along / lengths[:, None])
    changes = of_forces / lengths
    without_effect = vectors[:, np.count_nonzero(sizes > ALONG) :]
    largest = np.abs(changes).max(axis=1, initial=0.0)
    return np.asarray(np.abs(changes @ without_effect).max(axis=1, initial=0.0) <= SHARE * largest)
