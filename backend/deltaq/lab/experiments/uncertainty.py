"""Uncertainty: a cloud of runs from starts within a tolerance, beside the linear propagation of that tolerance.

Linear propagation makes of a covariance P₀ of the start Φ P₀ Φᵀ. It holds as long as the deviations are small; then
only the cloud tells how far a prediction can be trusted, and when it is worth nothing.
Source: see `lab.cloud` and `lab.propagation`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NoReturn

import numpy as np

from ...contract.experiments.uncertainty import UncertaintyRequest
from ...errors import Problem as Mistake
from ...errors import RequestError, escaped
from ...simulation.ensemble import Ensemble, needs_single_runs
from ...simulation.march import Integers
from ...simulation.problem import Floats, Problem
from ..charts.uncertainty import charts
from ..cloud import (
    CONFIDENCE,
    COUNTS,
    LEVELS,
    LINEAR,
    Cloud,
    Spread,
    drawn,
    first_above,
    flown,
    shortened,
    spread,
    usable,
)
from ..experiment import Experiment
from ..minimal_subject import minimal_subject_of
from ..propagation import Propagation, propagated
from ..report import Document, Report, rounded, significant
from ..subject import Subject, bounded

SAMPLES = 201
TOGETHER = 64  # runs, at least, between two reports
REPORTS = 12
MOST_STEPS = 100_000  # of one run
MOST_SINGLE = 5_000.0  # seconds of all motions, where each has to be run by itself
FINE, FINEST, USUAL = 1e-3, 1e-13, 1e-9  # error of integration: over the smallest tolerance, and its bounds
STILL = 1e-9  # of the largest value: a range that is none
NO_PART = 1e-12  # of a variance: what difference quotients leave


@dataclass(frozen=True)
class _Asked:
    """What is uncertain: `sizes`, half widths or standard deviations of (q, q̇, p), 0 of what is exact.

    Both `sizes` and `sigmas` have shape (quantities,).
    """

    request: UncertaintyRequest
    subject: Subject
    problem: Problem
    names: tuple[str, ...]
    sizes: Floats
    flow: Propagation

    @property
    def sigmas(self) -> Floats:
        """A uniform distribution of half width a has the standard deviation a/√3."""
        return self.sizes if self.request.distribution == "normal" else self.sizes / math.sqrt(3.0)

    @property
    def places(self) -> Integers:
        """The columns of D among all quantities."""
        return _columns(self.problem, self.sizes)


def run(request: UncertaintyRequest) -> Iterator[Report]:
    """The linear propagation, then the cloud as it grows."""
    free = minimal_subject_of(request, SAMPLES)
    subject = free.subject
    problem = bounded(subject, MOST_STEPS)
    names = _names(subject)
    sizes = _sizes(request, problem, names)
    deviations = drawn(sizes, request.runs, request.seed, is_normal=request.distribution == "normal")
    _require_sense(request, subject, sizes, deviations)
    parameters = _columns(problem, sizes)[2 * problem.degrees :] - 2 * problem.degrees
    columns = _columns(problem, sizes)
    asked = _Asked(
        request, subject, problem, names, sizes, propagated(problem, SAMPLES, parameters.tolist(), sizes[columns])
    )
    tolerance = float(np.clip(FINE * asked.sigmas[asked.sigmas > 0.0].min(), FINEST, USUAL))
    for cloud in flown(problem, deviations, tolerance, max(TOGETHER, -(-request.runs // REPORTS))):
        yield Report(len(cloud.values), request.runs, _told(asked, cloud) | {"minimal": list(free.coordinates)})


def _names(subject: Subject) -> tuple[str, ...]:
    """Of all quantities, in the order values, rates, parameters."""
    free = [coordinate.name for coordinate in subject.scene.free]
    starts = [f"initial.{name}.{part}" for part in ("value", "rate") for name in free]
    return (*starts, *(f"parameters.{parameter.name}" for parameter in subject.scene.parameters))


def _sizes(request: UncertaintyRequest, problem: Problem, names: tuple[str, ...]) -> Floats:
    """Standard deviations or half widths, 0 of what is exact. Raises RequestError for a quantity that there is not."""
    if request.tolerances:
        return _given(request, names)
    n, found = problem.degrees, np.zeros(len(names))
    if request.uncertain != "parameters":
        found[: n if request.uncertain == "values" else 2 * n] = request.tolerance
    if request.uncertain in ("parameters", "all"):
        found[2 * n :] = request.tolerance * np.abs(problem.parameters)
    if not found.any():
        raise RequestError(Mistake("uncertainty-nothing", "/uncertain"))
    return found


def _given(request: UncertaintyRequest, names: tuple[str, ...]) -> Floats:
    """The tolerances that each have one of their own, whether by the whole name or by a short one."""
    places = {name: place for place, name in enumerate(names)}
    places |= {_short(name): place for place, name in enumerate(names)}
    told, found = {"known": ", ".join(map(_short, names))}, np.zeros(len(names))
    unknown = [
        Mistake("ensemble-quantity", f"/tolerances/{escaped(name)}", parameters=told | {"name": name[:80]})
        for name in request.tolerances
        if name not in places
    ]
    if unknown:
        raise RequestError(*unknown)
    for name, size in request.tolerances.items():
        found[places[name]] = size
    return found


def _short(quantity: str) -> str:
    """phi, dot(phi) or l."""
    _, name, *part = quantity.split(".")
    return f"dot({name})" if part == ["rate"] else name


def _columns(problem: Problem, sizes: Floats) -> Integers:
    """Values and rates, and of the parameters those that are uncertain."""
    first = 2 * problem.degrees
    return np.concatenate([np.arange(first), first + np.flatnonzero(sizes[first:])])


def _require_sense(request: UncertaintyRequest, subject: Subject, sizes: Floats, deviations: Floats) -> None:
    """Raises RequestError where a parameter would lose its sign, and where the runs would take too long."""
    problem, first = subject.problem, 2 * subject.problem.degrees
    for place, parameter in enumerate(subject.scene.parameters, first):
        least = parameter.value + float(deviations[:, place].min())
        if parameter.positive and least <= 0.0:
            _refuse_sign(request, parameter.name, least, float(sizes[place]))
    ensemble = Ensemble(problem, problem.state[None, :first], np.array(problem.parameters)[None, :])
    seconds = request.runs * request.t_end
    if seconds > MOST_SINGLE and needs_single_runs(ensemble):
        told: dict[str, str | int | float] = {"runs": request.runs, "seconds": seconds, "most_seconds": MOST_SINGLE}
        raise RequestError(Mistake("uncertainty-too-large-singly", "/runs", parameters=told))


def _refuse_sign(request: UncertaintyRequest, name: str, least: float, size: float) -> NoReturn:
    told: dict[str, str | int | float] = {"name": name, "value": significant(least), "size": significant(size)}
    given = next((one for one in request.tolerances if one in (name, f"parameters.{name}")), None)
    pointer = f"/tolerances/{escaped(given)}" if given else "/tolerance"
    raise RequestError(Mistake("uncertainty-sign", pointer, parameters=told))


def _told(asked: _Asked, cloud: Cloud) -> Document:
    """What is known so far. Raises RequestError where hardly anything moves."""
    count = usable(cloud, asked.flow)
    if count < 2:
        raise RequestError(Mistake("no-motion"))
    flow = shortened(asked.flow, count)
    free = [coordinate.name for coordinate in asked.subject.scene.free]
    given = {name: size for name, size in zip(asked.names, asked.sizes.tolist(), strict=True) if size}
    statuses = dict.fromkeys(cloud.statuses, 0) | {one: cloud.statuses.count(one) for one in set(cloud.statuses)}
    return asked.subject.described | {
        "distribution": asked.request.distribution,
        "tolerances": given,
        "share": asked.request.share,
        "confidence": CONFIDENCE,
        "levels": list(LEVELS),
        "t": rounded(flow.times, 6),
        "reached": cloud.reached[:count].tolist(),
        "runs": len(cloud.values),
        "statuses": statuses,
        "coordinates": [_coordinate(asked, cloud, flow, name, place) for place, name in enumerate(free)],
    }


def _coordinate(asked: _Asked, cloud: Cloud, flow: Propagation, name: str, place: int) -> Document:
    found = spread(cloud, flow, asked.places, asked.sigmas[asked.places], place)
    nominal, extent = flow.states[:, place], _extent(asked.problem, flow, place)
    until = first_above(flow.times, found.nonlinearity, LINEAR)
    error_from = first_above(flow.times, np.where(found.size > 0.0, found.error, 0.0), COUNTS * found.size)
    return {
        "coordinate": name,
        "reference": rounded(nominal),
        "mean": _column(found.mean),
        "deviation": _column(found.deviation),
        "low": _column(found.low),
        "high": _column(found.high),
        "linear": _column(found.linear),
        "nonlinearity": _column(found.nonlinearity, 3),
        "error": _column(found.error, 3),
        "quantiles": [_column(row) for row in found.quantiles],
        "range": significant(extent),
        "linear_until": _time(until),
        "error_from": 0.0 if error_from is not None and error_from <= flow.times[1] else _time(error_from),
        "horizon": _horizon(flow.times, found, asked.request.share * extent),
        "budget": _budget(asked, flow, place, until),
    }


def _extent(problem: Problem, flow: Propagation, place: int) -> float:
    """Over which the nominal motion goes; 0 where it stands still but for rounding."""
    seen = flow.states[:, place]
    extent = float(np.ptp(seen))
    if extent <= STILL * float(np.abs(seen).max()):
        return 0.0
    return min(extent, math.tau) if problem.angular[place] else extent


def _horizon(times: Floats, found: Spread, bound: float) -> Document | None:
    """When the spread comes to a bound, by the standard deviation and both ends of its interval."""
    t = first_above(times, found.deviation, bound) if bound > 0.0 else None
    if t is None:
        return None
    early, late = first_above(times, found.high, bound), first_above(times, found.low, bound)
    return {"t": _time(t), "early": _time(t if early is None else early), "late": _time(late)}


def _budget(asked: _Asked, flow: Propagation, place: int, until: float | None) -> dict[str, float]:
    """What each quantity adds to the linear variance at the last time at which that is known and means something."""
    places = asked.places
    parts = flow.variances(asked.sigmas[places], place)
    total = parts.sum(axis=1)
    means = np.isfinite(total) & (total > 0.0) & (flow.times <= (flow.times[-1] if until is None else until))
    if not means.any():
        return {}
    last = int(np.flatnonzero(means)[-1])
    shares = np.where(parts[last] > NO_PART * total[last], parts[last] / total[last], 0.0)
    return {asked.names[k]: significant(float(one), 3) for k, one in zip(places, shares, strict=True) if asked.sizes[k]}


def _column(numbers: Floats, digits: int = 6) -> list[float | None]:
    """Rounded; None for what is no number."""
    return [significant(one, digits) if math.isfinite(one) else None for one in numbers.tolist()]


def _time(time: float | None) -> float | None:
    return None if time is None else significant(time, 4)


EXPERIMENT = Experiment(UncertaintyRequest, run, charts)
