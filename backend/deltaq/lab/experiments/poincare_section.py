"""Poincaré section: where many motions of one energy, or of one drive, cross a plane in phase space.

Regular motions leave curves, chaotic ones fill areas. Each point is a root of the plane's function on the polynomial of
a Taylor step, known to rounding until the motion's own sensitivity takes over; after its horizon it is marked. Motions
with impacts or dry friction are followed one by one, from event to event.
Source: see `lab.plane`, `lab.starts`, `lab.orbits` and `lab.hybrid_orbits`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...contract.experiments.poincare_section import PoincareSectionRequest
from ...errors import Problem as Mistake
from ...errors import RequestError
from ...mechanics.requests import inside
from ...model.modes import modes_of
from ...simulation.integration import Flag
from ...simulation.problem import Floats
from ...simulation.rounding import rounded as rounded_to
from ...simulation.section import STAYS, path_of
from ...simulation.service import require_no_event
from ..charts.poincare_section import charts
from ..experiment import Experiment
from ..hybrid_orbits import LEAST, HybridMotions, clear_of_contacts
from ..hybrid_orbits import followed as hybrid_orbits
from ..hybrid_orbits import path_of as path_of_run
from ..minimal_subject import FreeSubject, minimal_subject_of
from ..orbits import LOST, TOGETHER, Orbit, extent_of, followed, steps_of
from ..period import period
from ..plane import Section, observables_of, section_of
from ..report import Document, Report, rounded, significant
from ..sliding import require_no_sliding
from ..starts import Grid, Starts
from ..subject import Subject, bounded, hybrid_subject_of

TOTAL = 1000
MOST_STEPS = 20_000  # of one orbit: one that comes close to a pole would keep all others waiting
SHARP = 1e-10  # the error up to which a point is said to be known well
LONGEST_PATH = 600  # steps of the scene's own motion that are looked at before anything else


@dataclass(frozen=True)
class _Asked:
    """What is measured: the section, the starts with the scene's own first, where it belongs to them."""

    request: PoincareSectionRequest
    free: FreeSubject
    section: Section
    grid: Starts
    states: Floats
    has_own: bool
    energy: float | None
    scale: float
    behind: int = 0
    hybrid: HybridMotions | None = None


def run(request: PoincareSectionRequest) -> Iterator[Report]:
    """Orbits as they come, some dozens side by side; then what is known of them."""
    cancelled = np.zeros(1, dtype=np.int64)
    hybrid = hybrid_subject_of(request)
    asked = _asked(request, cancelled) if hybrid is None else _asked_of_hybrid(request, hybrid, cancelled)
    orbits = list[Orbit]()
    yield Report(0, TOTAL, _told(asked, []))
    for first in range(0, len(asked.states), TOGETHER):
        some = asked.states[first : first + TOGETHER]
        for share, found in _followed(asked, some, cancelled):
            done = (first + share * len(some)) / len(asked.states)
            yield Report(min(int(TOTAL * done), TOTAL - 1), TOTAL, _told(asked, [*orbits, *found]))
        orbits += found
    _require_points(asked, orbits)
    yield Report(TOTAL, TOTAL, _told(asked, orbits))


def _followed(asked: _Asked, starts: Floats, cancelled: Flag) -> Iterator[tuple[float, list[Orbit]]]:
    section, most = asked.section, asked.request.crossings + asked.request.skip
    if asked.hybrid is not None:
        return hybrid_orbits(section, asked.hybrid, starts, most)
    return followed(section, starts, steps_of(section.problem, is_driven=section.is_driven), most, cancelled)


def _asked(request: PoincareSectionRequest, cancelled: Flag) -> _Asked:
    free = minimal_subject_of(request)
    observables, problem = observables_of(request, free.subject), bounded(free.subject, MOST_STEPS)
    require_no_sliding(problem)
    path = path_of(problem, steps_of(problem, is_driven=False), LONGEST_PATH, cancelled)
    return _begun(request, free, section_of(request, problem, observables, path), path)


def _asked_of_hybrid(request: PoincareSectionRequest, subject: Subject, cancelled: Flag) -> _Asked:
    """The same of a scene with impacts or dry friction: starts behind a contact are left out."""
    scene, modes = subject.scene, modes_of(subject.scene)
    observables, problem = observables_of(request, subject), bounded(subject, MOST_STEPS)
    if modes is None:
        raise LookupError("the scene has neither impacts nor friction")
    with inside("/scene"):
        require_no_event(scene, problem)
    motions = HybridMotions(problem, modes, LEAST, cancelled)
    path = path_of_run(motions.run(problem.state))
    section = section_of(request, problem, observables, path)
    asked = _begun(request, FreeSubject(subject), section, path)
    seconds = period(scene) if section.is_driven else math.inf
    clear = clear_of_contacts(scene, observables, asked.states)
    clear[: int(asked.has_own)] = True  # that has been looked at
    if not section.function.places:  # the time alone tells how long it takes to cross so often
        wanted = (request.crossings + request.skip + 1) * seconds
        motions = replace(motions, problem=replace(problem, t_end=min(problem.t_end, wanted)))
    motions = motions.following(problem.state, seconds)
    return replace(asked, states=asked.states[clear], behind=int((~clear).sum()), hybrid=motions)


def _begun(request: PoincareSectionRequest, free: FreeSubject, section: Section, path: Floats) -> _Asked:
    grid = Grid(section, path)
    own = grid.own
    found = float(grid.energy_at(own[None, :])[0])
    energy = None if section.is_driven else found if request.energy is None else request.energy
    starts = grid.starts(request.count, energy)
    has_own = energy is None or abs(energy - found) <= 1e-12 * max(abs(energy), abs(found))
    states = np.vstack([own[None, :], starts.states]) if has_own else starts.states
    if not len(states):
        least = {"energy": significant(energy or 0.0), "least": significant(grid.lowest[1])}
        raise RequestError(Mistake("section-energy-unreachable", "/energy", parameters=least))
    values = section.function.jet.table(path)
    with np.errstate(invalid="ignore"):  # at a pole there is no size of h
        sizes = (np.abs(values[:, 1:-1]) * np.abs(path[:, :-1])).sum(axis=1)
    scale = sum(float(np.max(each, initial=0.0, where=np.isfinite(each))) for each in (sizes, np.abs(values[:, -1])))
    return _Asked(request, free, section, starts, states, has_own, energy, scale)


def _require_points(asked: _Asked, orbits: Sequence[Orbit]) -> None:
    """Raises RequestError where no orbit crosses the plane, or all stay in it."""
    if all(orbit.status != "ok" and not len(orbit.rows) for orbit in orbits):
        raise RequestError(Mistake("no-motion"))
    told: dict[str, str | float] = {"plane": asked.section.plane.text[:80], "t_end": asked.request.t_end}
    if all(orbit.reach <= STAYS * asked.scale for orbit in orbits):
        raise RequestError(Mistake("section-plane-contains", "/plane", parameters=told))
    start = asked.section.at(np.column_stack([asked.states[:1], np.zeros(1)]))[0, :2]
    for value, name, axis in zip(start, ("horizontal", "vertical"), asked.section.axes, strict=True):
        if not np.isfinite(value) and not any(len(orbit.rows) for orbit in orbits):
            raise RequestError(Mistake("never-defined", f"/{name}", parameters={"expression": axis.text[:80]}))
    if not any(len(orbit.rows) > asked.request.skip for orbit in orbits):
        raise RequestError(Mistake("section-never-met", "/plane", parameters=told))


def _told(asked: _Asked, orbits: Sequence[Orbit]) -> Document:
    """What was found so far."""
    section, skip = asked.section, asked.request.skip
    seen = [orbit.seen[skip:] for orbit in orbits]
    points = np.concatenate([np.zeros((0, 3)), *seen])
    extent = extent_of(points[:, :2])
    trusted = [orbit.seen[skip : orbit.horizon(extent)] for orbit in orbits]
    errors = [orbit.errors[skip : orbit.horizon(extent)] for orbit in orbits]
    verdicts = [orbit.is_chaotic(extent) for orbit in orbits[int(asked.has_own) :]]
    clear = [one for one in verdicts if one is not None]
    return asked.free.described | {
        "plane": section.plane.text,
        "direction": section.direction,
        "horizontal": section.axes[0].text,
        "vertical": section.axes[1].text,
        "driven": section.is_driven,
        "energy": None if asked.energy is None else significant(asked.energy, 8),
        "orbits": [_orbit(asked, orbit, extent, own=asked.has_own and i == 0) for i, orbit in enumerate(orbits)],
        "points": len(points),
        "forbidden": asked.grid.forbidden,
        "unsolved": asked.grid.unsolved,
        "behind": asked.behind,
        "missed": sum(not len(each) for each in seen),
        "sharp": int((np.concatenate([np.zeros(0), *errors]) <= SHARP).sum()),
        "kept": _kept(asked.energy, np.concatenate([np.zeros((0, 3)), *trusted])[:, 2]),
        "regular": significant(clear.count(False) / len(clear), 3) if clear and not section.is_driven else None,
        "extent": significant(extent),
    }


def _kept(energy: float | None, found: Floats) -> float | None:
    if energy is None or not len(found):
        return None
    return significant(float(np.abs(found - energy).max() / max(abs(energy), np.abs(found).max(), 1e-300)), 2)


def _orbit(asked: _Asked, orbit: Orbit, extent: float, *, own: bool) -> Document:
    skip = asked.request.skip
    known = orbit.horizon(extent)
    count = len(orbit.rows) if asked.request.beyond else known
    rows, seen, errors = orbit.rows[skip:count], orbit.seen[skip:count], orbit.errors[skip:count]
    is_lost = known < len(orbit.rows)
    shown = rounded_to(seen[:, :2], np.minimum(errors, 1e-3))
    return {
        "initial": asked.free.begin(orbit.start),
        "own": own,
        "status": "horizon_reached" if is_lost and orbit.status == "ok" else orbit.status,
        "chaotic": orbit.is_chaotic(extent),
        "horizon": significant(float(orbit.rows[known, -1])) if is_lost else None,
        "t": rounded(rows[:, -1], 12),
        "x": shown[:, 0].tolist(),
        "y": shown[:, 1].tolist(),
        "error": rounded(np.minimum(errors, max(LOST, 1.0) * extent), 2),
    }


EXPERIMENT = Experiment(PoincareSectionRequest, run, charts)
