"""Physical stability over two parameters: the Floquet multipliers of a scene that something drives periodically.

Kapitza's upright pendulum stands where the map is stable, Mathieu's tongues are where it is not. The map comes in
rough at first and is refined.
Source: see `lab.monodromy`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from time import perf_counter

import numpy as np

from ...language.tree import Name, walk
from ...mechanics.requests import inside
from ...simulation.fields import Fields
from ...contract.bounds import MAP_POINTS, USUAL_MAP
from ..charts.stability_map import charts
from ..experiment import Experiment
from ..monodromy import Axis, Plane, StabilityMap
from ..period import clocks, period
from ..report import Document, Report, measured, rounded, significant
from ..subject import Subject, parameter_of, subject_of

COARSEST = 8


def run(document: Mapping[str, object]) -> Iterator[Report]:
    """Further fields: x and y, each {parameter, from, to, count?}."""
    subject = subject_of(document)
    first, second = (_axis(subject, key) for key in ("x", "y"))
    if first.parameter == second.parameter and first.parameter:
        subject.request.complain("request-same-parameter", "/y/parameter", name=first.parameter)
    subject.finish("x", "y")
    for key, axis in (("x", first), ("y", second)):
        parameter_of(subject, axis.parameter, f"/{key}/parameter")
    plane = Plane(subject.problem, first, second, _periods(subject, first, second))
    strides, start, circumstances = _strides(), perf_counter(), measured(1)
    total = sum((1.0 / stride) ** 2 for stride in strides)
    for index, found in enumerate(plane.refined(coarsest=COARSEST)):
        done = sum((1.0 / stride) ** 2 for stride in strides[: index + 1])
        result = subject.described | _told(found) | {"time": significant(perf_counter() - start)}
        result |= {"taken": circumstances}
        yield Report(round(1000 * done / total), 1000, result)


def _strides() -> list[int]:
    return [2**k for k in range(COARSEST.bit_length() - 1, -1, -1)]


def _axis(subject: Subject, key: str) -> Axis:
    """An axis as asked for; problems are collected below its key."""
    given = subject.request.document.get(key)
    fields = Fields(given if isinstance(given, Mapping) else {})
    if not isinstance(given, Mapping):
        subject.request.complain("missing-field", f"/{key}", field=key)
        return Axis("", (0.0, 1.0))
    name, count = fields.text("parameter", ""), fields.whole("count", *MAP_POINTS, USUAL_MAP)
    low = fields.number("from", -1e9, 1e9, closed=True, required=True)
    high = fields.number("to", -1e9, 1e9, closed=True, required=True)
    if low is not None and high is not None and not low < high:
        fields.complain("request-outside", "/to", value=high, min=low, max=1e9)
    fields.reject_all_but(("parameter", "from", "to", "count"))
    subject.request.problems += [problem.below(f"/{key}") for problem in fields.problems]
    return Axis(name, tuple(map(float, np.linspace(low or 0.0, high or 1.0, count))))


def _periods(subject: Subject, first: Axis, second: Axis) -> np.ndarray:
    """The period at each point, worked out once for all points that share it.

    Raises SceneError where the scene is not periodic.
    """
    values = {p.name: p.value for p in subject.scene.parameters}
    with inside("/scene"):
        used = {node.name for clock in clocks(subject.scene) for node in walk(clock) if isinstance(node, Name)}
        columns = first.values if first.parameter in used else first.values[:1]
        rows = second.values if second.parameter in used else second.values[:1]
        found = [
            [period(subject.scene, values | {first.parameter: a, second.parameter: b}) for a in columns] for b in rows
        ]
    return np.ascontiguousarray(np.broadcast_to(np.array(found), (len(second.values), len(first.values))))


def _told(found: StabilityMap) -> Document:
    return {
        "x": {"parameter": found.first.parameter, "values": rounded(found.first.values, 8)},
        "y": {"parameter": found.second.parameter, "values": rounded(found.second.values, 8)},
        "growth": [[None if np.isnan(one) else significant(float(one), 5) for one in row] for row in found.growth],
        "stable": significant(float(found.is_stable.mean()), 4),
    }


EXPERIMENT = Experiment("stability-map", run, charts)
