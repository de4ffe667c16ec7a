"""Basins of attraction: where motions from a grid of starts end, and how fine the boundary between the basins is.

Source: see `lab.attractors` and `lab.uncertain_boundary`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from ...contract.experiments.basins import BasinsRequest
from ...errors import InputError, RequestError
from ...errors import Problem as Mistake
from ...mechanics.requests import inside
from ...simulation.ensemble import Ensemble, needs_single_runs
from ...simulation.march import Integers
from ...simulation.problem import Floats, Problem
from ..attractors import ENDED, LOOKS, NONE, PERIODS, Attractor, Search, Stroboscope, staged
from ..charts.basins import charts
from ..experiment import Experiment
from ..period import period
from ..report import Document, Report, rounded, significant
from ..sliding import require_no_sliding
from ..subject import Subject, bounded, free_subject_of
from ..uncertain_boundary import CONFIDENCE, DISTANCES, boundary_of, neighbours, uncertain, wilson

MOST_STEPS = 100_000  # of one run
MOST_SINGLE = 15_000.0  # seconds of all motions, where each has to be run by itself
TOGETHER = 512  # runs, between two reports
UNSURE = 0.1  # of the way between attractors: an error that may decide
EVERY, ORBIT = 4, 5  # of the points of a closed orbit, which are told to so many digits
USUAL = 1.0  # half a side of the map, where the scene has no bounds


@dataclass(frozen=True)
class _Map:
    """The places of two components of (q, q̇), their names, and the corners of the map, shape (2,) each."""

    places: tuple[int, int]
    names: tuple[str, str]
    low: Floats
    high: Floats

    def starts(self, own: Floats, points: Floats) -> Floats:
        """States over places in the unit square, shape (points, 2): all else is the scene's own."""
        found = np.tile(own, (len(points), 1))
        found[:, list(self.places)] = self.low + points * (self.high - self.low)
        return found

    @property
    def size(self) -> float:
        """Its larger side."""
        return float((self.high - self.low).max())

    def side(self, axis: int, count: int) -> Floats:
        """The values along a side: the middles of so many cells."""
        return np.asarray(self.low[axis] + (np.arange(count) + 0.5) / count * (self.high[axis] - self.low[axis]))


@dataclass(frozen=True)
class _Found:
    """What is known: `basins` of the grid's starts with their `errors`, shape (starts,), and `near` of neighbours.

    UNKNOWN stands where nothing is known yet; `near` has shape (pairs, 1 + 2 distances).
    """

    basins: Integers
    errors: Floats
    near: Integers | None = None


UNKNOWN = -3


def run(request: BasinsRequest) -> Iterator[Report]:
    """The grid, rough first; then the neighbours of some starts."""
    subject = free_subject_of(request)
    require_no_sliding(subject.problem)
    chart, stroboscope = _map(request, subject), _stroboscope(request, subject)
    _require_time(request, stroboscope.problem)
    own, count = subject.problem.state[: 2 * subject.problem.degrees], request.count
    search = Search(stroboscope, _sizes(stroboscope.problem, chart))
    middles = (np.indices((count, count))[::-1].reshape(2, -1).T + 0.5) / count
    found = _Found(np.full(count * count, UNKNOWN, dtype=np.int64), np.zeros(count * count))
    done = 0
    for places in _blocks(count):
        landing = search.landed(chart.starts(own, middles[places]))
        found.basins[places], found.errors[places] = landing.basins, landing.errors
        done += len(places)
        if done == count * count and not search.attractors:
            raise RequestError(Mistake("basins-none", "/t_end", parameters={"t_end": stroboscope.problem.t_end}))
        yield Report(done, request.runs, _told(request, subject, chart, search, found))
    if request.pairs and len(search.attractors) > 1:
        near = neighbours(request.pairs, request.seed)
        basins = np.full(near.shape[:2], NONE, dtype=np.int64).ravel()
        points = near.reshape(-1, 2)
        for first in range(0, len(points), TOGETHER):
            part = slice(first, first + TOGETHER)
            basins[part] = search.landed(chart.starts(own, points[part])).basins
            yield Report(
                min(done + first, request.runs - 1), request.runs, _told(request, subject, chart, search, found)
            )
        found = replace(found, near=basins.reshape(near.shape[:2]))
    yield Report(request.runs, request.runs, _told(request, subject, chart, search, found))


def _blocks(count: int) -> Iterator[Integers]:
    """The places of the grid, some at a time."""
    for places in staged(count):
        for first in range(0, len(places), TOGETHER):
            yield places[first : first + TOGETHER]


def _stroboscope(request: BasinsRequest, subject: Subject) -> Stroboscope:
    """Looks in each period of what drives the scene, or in equal times; the span ends with a period."""
    problem = bounded(subject, MOST_STEPS)
    try:
        with inside("/scene"):
            every = period(subject.scene)
    except InputError as error:
        if error.problems[0].code != "no-period":
            raise
        return Stroboscope(problem, LOOKS, is_driven=False)
    looks = max(PERIODS, math.ceil(request.t_end / every - 1e-9))
    return Stroboscope(replace(problem, t_end=looks * every), looks, is_driven=True)


def _map(request: BasinsRequest, subject: Subject) -> _Map:
    """What stands on the axes. Raises RequestError for a quantity that there is not, and for sides without length."""
    free = subject.scene.free
    names = [*(one.name for one in free), *(f"dot({one.name})" for one in free)]
    across, up = request.horizontal or names[0], request.vertical or names[1]
    if not request.vertical and up == across:
        up = names[0]
    for field, name in (("horizontal", across), ("vertical", up)):
        if name not in names:
            told = {"name": name[:80], "known": ", ".join(names)}
            raise RequestError(Mistake("ensemble-quantity", f"/{field}", parameters=told))
    if across == up:
        raise RequestError(Mistake("basins-same-axes", "/vertical", parameters={"name": up}))
    places = names.index(across), names.index(up)
    sides = [
        _side(subject, place, low, high)
        for place, low, high in zip(places, (request.x_from, request.y_from), (request.x_to, request.y_to), strict=True)
    ]
    low, high = np.array(sides).T
    for axis, field in enumerate(("x_to", "y_to")):
        if not low[axis] < high[axis]:
            told_side: dict[str, str | int | float] = {"from": float(low[axis]), "to": float(high[axis])}
            raise RequestError(Mistake("basins-no-side", f"/{field}", parameters=told_side))
    return _Map(places, (across, up), low, high)


def _side(subject: Subject, place: int, low: float | None, high: float | None) -> tuple[float, float]:
    """From where to where: as asked, else a slider's bounds, a turn of an angle, or something around the start."""
    n, problem = subject.problem.degrees, subject.problem
    coordinate = subject.scene.free[place % n]
    half = max(USUAL, 2.0 * abs(float(problem.state[place])))
    usual = (-math.pi, math.pi) if place < n and problem.angular[place] else (-half, half)
    if place < n and not problem.angular[place]:
        usual = (
            usual[0] if coordinate.min is None else coordinate.min,
            usual[1] if coordinate.max is None else coordinate.max,
        )
    return usual[0] if low is None else low, usual[1] if high is None else high


def _sizes(problem: Problem, chart: _Map) -> Floats:
    """How large the components are at least: those of the map."""
    sizes = np.full(2 * problem.degrees, 1e-300)
    sizes[list(chart.places)] = np.maximum(np.abs(chart.low), np.abs(chart.high))
    return sizes


def _require_time(request: BasinsRequest, problem: Problem) -> None:
    """Raises RequestError where the runs would take too long."""
    seconds = request.runs * problem.t_end
    ensemble = Ensemble(problem, problem.state[None, : 2 * problem.degrees], np.array(problem.parameters)[None, :])
    if seconds > MOST_SINGLE and needs_single_runs(ensemble):
        told: dict[str, str | int | float] = {"runs": request.runs, "seconds": seconds, "most_seconds": MOST_SINGLE}
        raise RequestError(Mistake("basins-too-large-singly", "/count", parameters=told))


def _told(request: BasinsRequest, subject: Subject, chart: _Map, search: Search, found: _Found) -> Document:
    """What is known so far."""
    count, known = request.count, found.basins != UNKNOWN
    total = int(known.sum())
    rows = found.basins.reshape(count, count).tolist()
    away = (found.basins == NONE) | (found.basins == ENDED)
    unsure = known & ~away & (found.errors > UNSURE * search.separation())
    return subject.described | {
        "x": {"quantity": chart.names[0], "values": rounded(chart.side(0, count))},
        "y": {"quantity": chart.names[1], "values": rounded(chart.side(1, count))},
        "basins": [[None if one == UNKNOWN else max(one, NONE) for one in row] for row in rows],
        "attractors": [
            _attractor(subject, search.stroboscope, one, chart.size, (int((found.basins == number).sum()), total))
            for number, one in enumerate(search.attractors)
        ],
        "confidence": CONFIDENCE,
        "driven": search.stroboscope.is_driven,
        "unsettled": significant(int(away.sum()) / total, 3),
        "unsure": significant(int(unsure.sum()) / total, 3),
        **_boundary(request, found),
    }


def _attractor(
    subject: Subject, stroboscope: Stroboscope, found: Attractor, size: float, shares: tuple[int, int]
) -> Document:
    """Where it is, to the last digits of the map's `size`, and the number of starts that come to it, of all."""
    hits, total = shares
    n, free = subject.problem.degrees, [coordinate.name for coordinate in subject.scene.free]
    state, seconds = found.states[0], found.seconds
    state = stroboscope.apart(state, np.zeros_like(state))  # angles without whole turns
    state = np.where(np.abs(state) > 1e-12 * max(size, float(np.abs(state).max())), state, 0.0)
    return {
        "state": {
            name: {"value": significant(float(state[i]), 6), "rate": significant(float(state[n + i]), 6)}
            for i, name in enumerate(free)
        },
        "period": significant(seconds, 6) if stroboscope.is_driven or found.is_closed else None,
        "orbit": _orbit(free, stroboscope, found.states[::EVERY]) if found.is_closed else None,
        "contraction": significant(max(found.size, 1e-300) ** (1.0 / seconds)),
        "share": significant(hits / total, 4),
        "interval": rounded(wilson(hits, total), 4),
    }


def _orbit(names: list[str], stroboscope: Stroboscope, states: Floats) -> Document:
    """Points of a closed orbit by coordinate; angles without whole turns."""
    found, n = stroboscope.apart(states, np.zeros_like(states)), len(names)
    return {
        name: {"values": rounded(found[:, i], ORBIT), "rates": rounded(found[:, n + i], ORBIT)}
        for i, name in enumerate(names)
    }


def _boundary(request: BasinsRequest, found: _Found) -> Document:
    """The parts of uncertain starts, and the dimension 2 − α."""
    if found.near is None:
        return {"neighbourhoods": [], "boundary": None}
    hits, known = uncertain(found.near)
    parts = hits.sum(axis=0) / np.maximum(known.sum(axis=0), 1)
    told = [
        {"distance": significant(float(d)), "uncertain": significant(float(f), 3)}
        for d, f in zip(DISTANCES, parts, strict=True)
    ]
    boundary = boundary_of(hits, known, request.seed)
    if boundary is None:
        return {"neighbourhoods": told, "boundary": None}
    interval = [significant(2.0 - boundary.high), significant(2.0 - boundary.low)]
    dimension = {
        "dimension": significant(2.0 - boundary.exponent),
        "interval": interval,
        "exponent": significant(boundary.exponent),
    }
    return {"neighbourhoods": told, "boundary": dimension}


EXPERIMENT = Experiment(BasinsRequest, run, charts)
