"""The fidelity ladder, "no more than the scene needs": the same scene with less in it, each rung measured.

Rungs and methods are charted together: leaving something out and integrating more roughly are two ways to be faster,
and only one of them may be worth it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import asdict
from functools import partial
from typing import cast

import numpy as np

from ...contract.experiments.fidelity import FidelityRequest
from ...mechanics.document import read_scene
from ...simulation.library import get_method
from ...simulation.method import Method
from ...simulation.problem import Floats, Problem
from ...simulation.run import run as run_once
from ..charts.fidelity import charts
from ..experiment import Experiment
from ..ladder.climb import climb
from ..ladder.distance import Yardstick
from ..ladder.ending import known
from ..ladder.findings import Finding, Growth, Ladder, Least, Measured, Rung
from ..ladder.measurement import full_run
from ..ladder.multipliers import Comparison, beside, compared
from ..measurement import Point, Runs, Setting, too_slow, warm
from ..report import Document, Report, appended, machine, measured, rounded, significant
from ..subject import subject_of, symbols_of
from ..sweep import settings_of

METHODS = ("rk4", "dormand-prince-54", "dop853", "radau-5")
TOLERANCE, REPEATS = 0.01, 5
LEAST_STEPS = 20  # of a run whose time per step is told
COARSE = 8  # settings of each method, from coarse to fine


def run(request: FidelityRequest) -> Iterator[Report]:
    """The ladder from the full model on, then the full model by several methods."""
    subject, tolerance = subject_of(request), request.tolerance or TOLERANCE
    result = subject.described | {"tolerance": tolerance, "machine": machine(), "repeats": REPEATS}
    result |= {"taken": measured(REPEATS)}
    result |= {"rungs": [], "measured": [], "growth": [], "points": [], "least": ""}
    result |= {"minimal": [], "multipliers": None}
    total, done, further = 1, 0, len(METHODS) * (2 if subject.scene.constraints else 1)
    for finding in climb(subject.scene, subject.problem.t_end, tolerance=tolerance, repeats=REPEATS):
        if isinstance(finding, Ladder):
            total = 1 + finding.count + further
        done, result = done + 1, _with(result, finding)
        yield Report(min(done, total), total, result)
    flag = np.zeros(1, dtype=np.int64)
    full, _ = known(full_run(subject.scene, subject.problem.t_end, flag, tolerance), tolerance)
    for points in _methods(full, full.problem, _as_it_is(full.problem)):
        done, result = done + 1, appended(result, "points", *points)
        yield Report(min(done, total), total, result)
    pair = beside(subject.scene, subject.problem.t_end, tolerance, flag)
    for points in _methods(full, pair.problem, pair.values) if pair else ():
        done, result = done + 1, appended(result, "minimal", *points)
        yield Report(min(done, total), total, result)
    found = compared(pair, flag) if pair else None
    if found:
        yield Report(total, total, result | {"multipliers": _compared(found, result)})


def _compared(found: Comparison, result: Document) -> Document:
    columns = {"t": found.times, "apart": found.apart, "estimate": found.estimate, "gap": found.gaps}
    return {
        **{name: rounded(column, 4) for name, column in columns.items()},
        "errors": {name: rounded(column, 4) for name, column in found.errors.items()},
        "estimates": {name: rounded(column, 4) for name, column in found.estimates.items()},
        "steps": _steps(*(cast("list[Document]", result[key]) for key in ("points", "minimal"))),
    }


def _steps(with_multipliers: list[Document], without: list[Document]) -> list[Document]:
    """Seconds per step of each method, the least of its runs, with multipliers and without."""
    kept, free = (_per_step(points) for points in (with_multipliers, without))
    return [{"method": name, "kept": kept[name], "minimal": free[name]} for name in kept if name in free]


def _per_step(points: list[Document]) -> dict[str, float]:
    found: dict[str, float] = {}
    for point in points:
        name, steps, time = str(point["method"]), cast("int", point["steps"]), cast("float", point["time"])
        if point["status"] == "ok" and steps >= LEAST_STEPS:
            found[name] = significant(min(time / steps, found.get(name, np.inf)))
    return found


def _with(result: Document, finding: Finding) -> Document:
    """The result with one finding more."""
    match finding:
        case Ladder():
            told = {"rungs": [_rung(rung) for rung in finding.rungs], "amplitudes": list(finding.amplitudes)}
            return result | told | {"centre": dict(finding.centre), "names": _names(finding, result)}
        case Measured():
            return appended(result, "measured", _measured(finding))
        case Growth():
            return appended(result, "growth", _growth(finding))
        case Least():
            return result | {"least": finding.rung or "", "until": significant(finding.until), "ending": finding.ending}


def _names(ladder: Ladder, result: Document) -> Document:
    """How all quantities are written, those that rungs bring along too."""
    own = cast("Document", result["names"])
    brought = (symbols_of(read_scene(rung.scene)) for rung in ladder.rungs if rung.scene is not None)
    return {name: symbol for names in brought for name, symbol in names.items()} | own


def _rung(rung: Rung) -> Document:
    parts = [{"kind": part.kind, "parameters": dict(part.parameters)} for part in rung.parts]
    refused = [{"code": problem.code, "parameters": dict(problem.parameters)} for problem in rung.problems]
    return {"id": rung.id, "parts": parts, "degrees": rung.degrees, "scene": rung.scene, "refused": refused}


def _measured(found: Measured) -> Document:
    head: Document = {"rung": found.rung, "status": found.outcome.status}
    if found.deviation is not None:
        told = found.deviation
        head |= {"largest": significant(told.largest), "until": significant(told.until)}
        head |= {} if told.relative is None else {"error": significant(max(told.relative, told.floor))}
    if found.survives is not None:
        head |= {"survives": found.survives}
    if found.nudged is not None and math.isfinite(found.nudged):
        head |= {"nudged": significant(found.nudged)}
    if found.cost is not None:
        cost = found.cost
        head |= {
            "operations": asdict(cost.operations) | {"total": cost.operations.total},
            "method": cost.method,
            "evaluations": cost.evaluations,
            "time": rounded([cost.per_run.median, cost.per_run.low, cost.per_run.high], 4),
            "per_evaluation": rounded([cost.per_evaluation.median], 4)[0],
        }
    return head


def _growth(found: Growth) -> Document:
    relative = [None if each is None else significant(each) for each in found.relative]
    return {"rung": found.rung, "relative": relative, "slope": None if found.slope is None else round(found.slope, 2)}


Values = Callable[[Floats, Floats], Mapping[str, Floats]]


def _as_it_is(problem: Problem) -> Values:
    def values(_times: Floats, states: Floats) -> Mapping[str, Floats]:
        return dict(zip(problem.model.layout.free, states[:, : problem.degrees].T, strict=True))

    return values


def _methods(full: Yardstick, problem: Problem, values: Values) -> Iterator[list[Document]]:
    """A model by several methods, roughly and finely, in the same measure as the rungs, for as long.

    `values` are the full model's coordinates at the states of a run.
    """
    if not full.end > 0.0:
        yield from ([] for _ in METHODS)
        return
    methods = [get_method(name) for name in METHODS]
    warm(Runs.over_kinks(problem), *methods)
    for method in methods:
        points: list[Point] = []
        for setting in settings_of(problem, method)[:COARSE]:
            if points and points[-1].is_slow:
                points.append(too_slow(method.id, setting))
                break
            points.append(_point(full, problem, values, method, setting))
        yield [point.described for point in points]


def _point(full: Yardstick, problem: Problem, values: Values, method: Method, setting: Setting) -> Point:
    steps, flag = setting.steps(0.05 * problem.t_end), np.zeros(1, dtype=np.int64)
    again = partial(run_once, problem, method, full.times, flag, steps)
    runs = [again() for _ in range(REPEATS)]
    first, seconds = runs[0], tuple(one.wall_time for one in runs)
    evaluations, count = int(first.result.evaluations), int(first.result.steps)
    if not first.is_complete:
        return Point(method.id, setting, "diverged", None, evaluations, count, seconds)
    errors = full.errors(values(full.times, first.states))
    error = float(errors.max()) / full.extent if full.extent > 0.0 else None
    return Point(method.id, setting, "ok", error, evaluations, count, seconds)


EXPERIMENT = Experiment(FidelityRequest, run, charts)
