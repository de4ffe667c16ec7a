"""Bifurcation diagram: what a scene settles to while a parameter is swept both ways, and where that changes.

Periodic motions that the sweeps come upon are followed as roots, unstable ones too; where a Floquet multiplier leaves
the unit circle the value of the parameter is located.
Source: see `lab.hysteresis`, `lab.closing` and `lab.continuation`.
"""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from itertools import pairwise
from time import monotonic

import numpy as np

from ...contract.experiments.bifurcation import BifurcationRequest
from ...errors import Problem as Mistake
from ...errors import RequestError
from ...simulation.problem import Floats
from ..branches import MOST_BRANCHES, Search, feigenbaum
from ..charts.bifurcation import charts
from ..continuation import Bifurcation, Branch, Point, Range
from ..experiment import Experiment
from ..hysteresis import Settled, differ, wrapped
from ..prepared import Prepared, prepared
from ..report import Document, Report, rounded, significant

TOTAL, SWEPT = 1000, 600  # of the work; what the sweeps are of it
PAUSE = 0.7  # seconds between two reports
DIGITS, STATE_DIGITS = 7, 13
FEWEST = 2  # values in a row: next to a bifurcation motions take so long to settle that one alone says nothing


@dataclass
class _Found:
    """What has come so far."""

    up: list[Settled] = field(default_factory=list)
    down: list[Settled] = field(default_factory=list)
    branches: list[Branch] = field(default_factory=list)
    written: list[tuple[Document, list[Document]]] = field(default_factory=list)


def run(request: BifurcationRequest) -> Iterator[Report]:
    """Both sweeps side by side, then the branches one by one."""
    made, found = prepared(request), _Found()
    yield Report(0, TOTAL, _told(made, found))
    values, told = made.values, monotonic()
    with ThreadPoolExecutor(2) as pool:
        ways = made.sweep.visited(values), made.sweep.visited(values[::-1])
        for index in range(len(values)):
            for kept, one in zip((found.up, found.down), pool.map(next, ways), strict=True):
                kept.append(one)
            if monotonic() - told > PAUSE:
                yield Report(SWEPT * (index + 1) // len(values), TOTAL, _told(made, found))
                told = monotonic()
    _require_motions(made, found)
    if request.orbits:
        yield Report(SWEPT, TOTAL, _told(made, found))
        made.sweep.view.flow.renew()
        for branch in _search(made).branches(_seeds(made, found)):
            found.written.append(_written(made, branch, len(found.branches)))
            found.branches.append(branch)
            made.sweep.view.flow.renew()
            share = len(found.branches) / MOST_BRANCHES
            yield Report(min(SWEPT + int((TOTAL - SWEPT) * share), TOTAL - 1), TOTAL, _told(made, found))
    yield Report(TOTAL, TOTAL, _told(made, found))


def _require_motions(made: Prepared, found: _Found) -> None:
    """Raises RequestError where no motion stays, or none is ever seen."""
    visits = [*found.up, *found.down]
    told = {"low": significant(float(made.values[0])), "high": significant(float(made.values[-1]))}
    if not any(one.is_ok for one in visits):
        raise RequestError(Mistake("bifurcation-no-motion", "/sweep", parameters=told))
    if not any(len(one.seen) for one in visits):
        raise RequestError(Mistake("bifurcation-never-met", "/plane", parameters={"plane": made.plane[:80]}))


def _search(made: Prepared) -> Search:
    low, high = float(made.values[0]), float(made.values[-1])
    return Search(made.sweep.closing, Range(low, high), made.request.folds)


def _seeds(made: Prepared, found: _Found) -> list[Settled]:
    """Motions that repeat, of few folds and few events first; where something drives the scene, its own start, too."""
    settled = sorted(
        (one for one in [*found.up, *found.down] if one.folds), key=lambda one: (one.folds, made.events(one))
    )
    if made.sweep.is_driven and not settled:
        value = float(made.values[0])
        settled.append(Settled(value, made.sweep.own, np.zeros(0), 1, made.sweep.unit(value), "ok"))
    return settled


def _told(made: Prepared, found: _Found) -> Document:
    seen = np.concatenate([np.zeros(0), *(one.seen for one in [*found.up, *found.down])])
    extent = float(np.ptp(seen)) if len(seen) else 1.0
    value = float(made.values[0])
    return made.subject.described | {
        "parameter": made.request.sweep.parameter,
        "driven": made.sweep.is_driven,
        "period": significant(made.sweep.unit(value), 8) if made.sweep.is_driven else None,
        "plane": made.plane,
        "direction": made.request.direction,
        "vertical": made.sweep.view.axis.text,
        "up": [_visit(made, one) for one in found.up],
        "down": [_visit(made, one) for one in found.down],
        "hysteresis": _hysteresis(found, extent),
        "branches": [branch for branch, _ in found.written],
        "bifurcations": [one for _, located in found.written for one in located],
        "feigenbaum": rounded(feigenbaum(found.branches), 5),
        "complete": len(found.branches) < MOST_BRANCHES and not made.sweep.view.flow.is_exhausted,
        "points": len(seen),
        "extent": significant(extent),
    }


def _hysteresis(found: _Found, extent: float) -> list[Document]:
    """The stretches of values at which both sweeps see unlike motions, once both are there."""
    if len(found.up) < 2 or len(found.up) != len(found.down) or found.up[-1].value != found.down[0].value:
        return []
    pairs = list(zip(found.up, reversed(found.down), strict=True))
    apart = [differ(up, down, extent) for up, down in pairs]
    edges = [i for i, (one, other) in enumerate(pairwise([False, *apart, False])) if one != other]
    spans = [(a, b) for a, b in zip(edges[::2], edges[1::2], strict=True) if b - a >= FEWEST]
    return [{"start": pairs[a][0].value, "end": pairs[b - 1][0].value} for a, b in spans]


def _begin(made: Prepared, state: Floats) -> Document:
    """A state as initial values by coordinate."""
    n, found = made.subject.problem.degrees, wrapped(state, made.sweep.closing.turns)
    names = [coordinate.name for coordinate in made.subject.scene.free]
    numbers = rounded(found, STATE_DIGITS)
    return {name: {"value": numbers[i], "rate": numbers[n + i]} for i, name in enumerate(names)}


def _visit(made: Prepared, one: Settled) -> Document:
    return {
        "value": one.value,
        "status": one.status,
        "folds": one.folds,
        "seen": rounded(one.seen, DIGITS),
        "initial": None if one.start is None else _begin(made, one.start),
    }


def _written(made: Prepared, branch: Branch, number: int) -> tuple[Document, list[Document]]:
    """A branch, and the bifurcations on it."""
    motions = [_motion(made, branch, point) for point in branch.points]
    located = [_bifurcation(made, branch, number, one) for one in branch.bifurcations]
    return {"folds": branch.folds, "motions": motions}, located


def _motion(made: Prepared, branch: Branch, point: Point) -> Document:
    growth = float(np.abs(point.closed.multipliers).max(initial=0.0))
    told = {"value": point.value, "stable": point.closed.is_stable, "growth": significant(growth, 6)}
    return told | _orbit(made, branch, point)


def _orbit(made: Prepared, branch: Branch, point: Point) -> Document:
    """What is seen of a periodic motion, and where it begins."""
    closing, state = branch.closing, branch.closing.state(point.unknown)
    span = closing.span(point.unknown)
    return {
        "period": significant(span, 12),
        "seen": rounded(_seen(made, branch, point, span), DIGITS),
        "initial": _begin(made, state),
    }


def _seen(made: Prepared, branch: Branch, point: Point, span: float) -> Floats:
    view, orbit = made.sweep.view, point.closed.image.orbit
    if view.plane is None:
        times = span * np.arange(len(orbit)) / len(orbit)
        return view.values(point.value, np.column_stack([orbit, times]))
    # a little of the motion comes before the plane, where a motion that begins in it would be half a passage
    start, part = orbit[0], span / branch.folds
    if branch.closing.period is None:
        moved = view.flow.traced(np.array([point.value]), start[None, :], np.array([0.0, 0.5 * part]))
        start = moved.states[0, -1]
    passed = view.passed(point.value, np.ascontiguousarray(start), part, branch.folds)
    return np.sort(view.values(point.value, passed.rows))


def _bifurcation(made: Prepared, branch: Branch, number: int, one: Bifurcation) -> Document:
    multipliers = one.point.closed.multipliers
    return {
        "kind": one.kind,
        "value": significant(one.point.value, 12),
        "error": significant(one.error, 2),
        "folds": branch.folds,
        "branch": number,
        "multipliers": [[significant(float(part), 9) for part in (m.real, m.imag)] for m in multipliers],
    } | _orbit(made, branch, one.point)


EXPERIMENT = Experiment(BifurcationRequest, run, charts)
