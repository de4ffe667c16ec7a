"""Physical stability over two parameters: the Floquet multipliers of a scene that something drives periodically.

Kapitza's upright pendulum stands where the map is stable, Mathieu's tongues are where it is not. The map comes in
rough at first and is refined.
Source: see `lab.monodromy`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from time import perf_counter

import numpy as np

from ...contract.experiments.stability_map import MapAxis, StabilityMapRequest
from ...errors import Parameter, RequestError, SceneError
from ...errors import Problem as Mistake
from ...language.tree import Name, walk
from ...mechanics.requests import inside
from ...mechanics.scene import Scene
from ..charts.stability_map import charts
from ..experiment import Experiment
from ..minimal_subject import minimal_subject_of
from ..monodromy import Axis, Plane, StabilityMap
from ..period import clocks, period
from ..report import Document, Report, measured, rounded, significant
from ..sliding import require_no_sliding
from ..subject import Subject, parameter_of

COARSEST = 8


def run(request: StabilityMapRequest) -> Iterator[Report]:
    """The map, rough at first."""
    free, first, second = minimal_subject_of(request), _axis(request.x), _axis(request.y)
    subject = free.subject
    require_no_sliding(subject.problem)
    if first.parameter == second.parameter:
        told = {"name": first.parameter}
        raise RequestError(Mistake("request-same-parameter", "/y/parameter", parameters=told))
    for key, axis in (("x", first), ("y", second)):
        parameter_of(subject, axis.parameter, f"/{key}/parameter")
    plane = Plane(subject.problem, first, second, _periods(subject, first, second))
    strides, start, circumstances = _strides(), perf_counter(), measured(1)
    total = sum((1.0 / stride) ** 2 for stride in strides)
    for index, found in enumerate(plane.refined(coarsest=COARSEST)):
        done = sum((1.0 / stride) ** 2 for stride in strides[: index + 1])
        result = free.described | _told(found) | {"time": significant(perf_counter() - start)}
        result |= {"taken": circumstances}
        yield Report(round(1000 * done / total), 1000, result)


def _strides() -> list[int]:
    return [2**k for k in range(COARSEST.bit_length() - 1, -1, -1)]


def _axis(asked: MapAxis) -> Axis:
    return Axis(asked.parameter, tuple(map(float, np.linspace(asked.start, asked.to, asked.count))))


def _periods(subject: Subject, first: Axis, second: Axis) -> np.ndarray:
    """The period at each point, worked out once for all points that share it.

    Raises SceneError where the scene is not periodic, and RequestError where it is not at one value of an axis.
    """
    values = subject.scene.parameter_values
    with inside("/scene"):
        used = {node.name for clock in clocks(subject.scene) for node in walk(clock) if isinstance(node, Name)}
        columns = first.values if first.parameter in used else first.values[:1]
        rows = second.values if second.parameter in used else second.values[:1]
        found = np.array(
            [
                [_period(subject.scene, values | {first.parameter: a, second.parameter: b}) for a in columns]
                for b in rows
            ]
        )
        if np.isnan(found).all():
            period(subject.scene, values | {first.parameter: columns[0], second.parameter: rows[0]})
    for key, axis, lost in (("x", first, np.isnan(found).all(axis=0)), ("y", second, np.isnan(found).all(axis=1))):
        for index in np.flatnonzero(lost):
            told: dict[str, Parameter] = {"name": axis.parameter, "value": axis.values[index]}
            raise RequestError(Mistake("map-no-period", f"/{key}/from" if index == 0 else f"/{key}", parameters=told))
    return np.ascontiguousarray(np.broadcast_to(found, (len(second.values), len(first.values))))


def _period(scene: Scene, values: Mapping[str, float]) -> float:
    """The period at these values of parameters, NaN where nothing depends on the time then."""
    try:
        return period(scene, values)
    except SceneError as error:
        if [problem.code for problem in error.problems] != ["no-period"]:
            raise
        return np.nan


def _told(found: StabilityMap) -> Document:
    return {
        "x": {"parameter": found.first.parameter, "values": rounded(found.first.values, 8)},
        "y": {"parameter": found.second.parameter, "values": rounded(found.second.values, 8)},
        "growth": [[None if np.isnan(one) else significant(float(one), 5) for one in row] for row in found.growth],
        "stable": significant(float(found.is_stable.mean()), 4),
    }


EXPERIMENT = Experiment(StabilityMapRequest, run, charts)
