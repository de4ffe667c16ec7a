"""The fidelity ladder, "no more than the scene needs": the same scene with less in it, each rung measured.

Rungs and methods are charted together: leaving something out and integrating more roughly are two ways to be faster,
and only one of them may be worth it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import asdict
from functools import partial

import numpy as np

from ...contract.experiments.fidelity import FidelityRequest
from ...simulation.integration import Flag
from ...simulation.library import get_method
from ...simulation.method import Method
from ...simulation.run import run as run_once
from ..charts.fidelity import charts
from ..experiment import Experiment
from ..ladder.climb import climb
from ..ladder.distance import Yardstick
from ..ladder.ending import known
from ..ladder.findings import Finding, Growth, Ladder, Least, Measured, Rung
from ..ladder.measurement import full_run
from ..measurement import Point, Setting, too_slow, warm
from ..report import Document, Report, appended, machine, measured, rounded, significant
from ..subject import Subject, free_subject_of
from ..sweep import settings_of

METHODS = ("rk4", "dormand-prince-54", "dop853", "radau-5")
TOLERANCE, REPEATS = 0.01, 5
COARSE = 8  # settings of each method, from coarse to fine


def run(request: FidelityRequest) -> Iterator[Report]:
    """The ladder from the full model on, then the full model by several methods."""
    subject, tolerance = free_subject_of(request), request.tolerance or TOLERANCE
    result = subject.described | {"tolerance": tolerance, "machine": machine(), "repeats": REPEATS}
    result |= {"taken": measured(REPEATS)}
    result |= {"rungs": [], "measured": [], "growth": [], "points": [], "least": ""}
    total, done = 1, 0
    for finding in climb(subject.scene, subject.problem.t_end, tolerance=tolerance, repeats=REPEATS):
        if isinstance(finding, Ladder):
            total = 1 + finding.count + len(METHODS)
        done, result = done + 1, _with(result, finding)
        yield Report(min(done, total), total, result)
    for points in _methods(subject, tolerance):
        done, result = done + 1, appended(result, "points", *points)
        yield Report(min(done, total), total, result)


def _with(result: Document, finding: Finding) -> Document:
    """The result with one finding more."""
    match finding:
        case Ladder():
            told = {"rungs": [_rung(rung) for rung in finding.rungs], "amplitudes": list(finding.amplitudes)}
            return result | told | {"centre": dict(finding.centre)}
        case Measured():
            return appended(result, "measured", _measured(finding))
        case Growth():
            return appended(result, "growth", _growth(finding))
        case Least():
            return result | {"least": finding.rung or "", "until": significant(finding.until), "ending": finding.ending}


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


def _methods(subject: Subject, tolerance: float) -> Iterator[list[Document]]:
    """The full model by several methods, roughly and finely, in the same measure as the rungs, for as long."""
    flag = np.zeros(1, dtype=np.int64)
    full, _ = known(full_run(subject.scene, subject.problem.t_end, flag, tolerance), tolerance)
    if not full.end > 0.0:
        yield from ([] for _ in METHODS)
        return
    methods = [get_method(name) for name in METHODS]
    warm(full.problem, *methods)
    for method in methods:
        points: list[Point] = []
        for setting in settings_of(full.problem, method)[:COARSE]:
            if points and points[-1].is_slow:
                points.append(too_slow(method.id, setting))
                break
            points.append(_point(full, method, flag, setting))
        yield [point.described for point in points]


def _point(full: Yardstick, method: Method, flag: Flag, setting: Setting) -> Point:
    steps = setting.steps(0.05 * full.problem.t_end)
    again = partial(run_once, full.problem, method, full.times, flag, steps)
    runs = [again() for _ in range(REPEATS)]
    first, seconds = runs[0], tuple(one.wall_time for one in runs)
    evaluations, count = int(first.result.evaluations), int(first.result.steps)
    if not first.is_complete:
        return Point(method.id, setting, "diverged", None, evaluations, count, seconds)
    columns = first.states[:, : full.problem.degrees].T
    errors = full.errors(dict(zip(full.problem.model.layout.free, columns, strict=True)))
    error = float(errors.max()) / full.extent if full.extent > 0.0 else None
    return Point(method.id, setting, "ok", error, evaluations, count, seconds)


EXPERIMENT = Experiment(FidelityRequest, run, charts)
