"""Stability of methods: regions |R(z)| ≤ 1 with the scene's own hλ in them, and the step at which each method fails.

The scene is linearized at its present state, or at rest; with constraints, in coordinates that keep them. Where that
holds along the motion, the step of failure is predicted from it and measured by running the method; elsewhere the
method is held against the exact flow. A series over a stiffness shows what explicit and implicit methods pay as it
grows.
Source: Hairer, Wanner, Solving Ordinary Differential Equations II, IV.2–IV.3.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

from ...contract.experiments.stability import StabilityRequest
from ...errors import Problem as Mistake
from ...errors import RequestError
from ...language.tree import Name
from ...mechanics.loads.spring import Spring
from ...mechanics.scene import Scene
from ...simulation.driver import simulate
from ...simulation.library import get_method
from ...simulation.method import Method
from ...simulation.problem import Problem
from ...simulation.stability import Complexes
from ..charts.stability import charts
from ..experiment import Experiment
from ..failure import failure
from ..minimal_subject import minimal_subject_of
from ..neighbours import Neighbours
from ..region import region
from ..report import Document, Report, appended, measured, significant
from ..rest import at_rest
from ..subject import Subject, bounded, methods_of, parameter_of

STIFFENED = ("rk4", "dop853", "stormer-verlet", "newmark", "radau-5")
FACTORS = tuple(10.0 ** (k / 2) for k in range(11))  # of the stiffness: 1 to 10⁵
TOLERANCE, STEP_LIMIT = 1e-4, 300_000


def run(request: StabilityRequest) -> Iterator[Report]:
    """One method after the other, then the series over the stiffness."""
    found = minimal_subject_of(request)
    subject = found.subject
    methods = methods_of(subject.problem, request.methods)
    stiffness = request.stiffness or stiffness_of(subject.scene)
    place = parameter_of(subject, stiffness, "/stiffness") if stiffness else -1
    problem = bounded(subject, STEP_LIMIT)
    neighbours, is_rest = _place(problem, request.at)
    if not math.isfinite(neighbours.varies):
        raise RequestError(Mistake("no-motion"))
    total = len(methods) + (len(FACTORS) * len(STIFFENED) if stiffness else 0)
    head = _spectrum(neighbours.eigenvalues) | {"at": request.at, "rest": is_rest}
    head |= {"varies": significant(neighbours.varies, 2), "taken": measured(1)}
    result = found.described | head | {"methods": [], "stiffness": stiffness, "series": []}
    for done, method in enumerate(methods, 1):
        result = appended(result, "methods", _row(neighbours, method))
        yield Report(done, total, result)
    for done, one in enumerate(_series(subject, place) if stiffness else (), len(methods) + 1):
        result = appended(result, "series", *one)
        yield Report(done, total, result)


def _place(problem: Problem, at: str) -> tuple[Neighbours, bool]:
    """Where the scene is linearized, and whether it rests there.

    A scene without any rest whose linearization is the same everywhere, such as one that falls or slides down, is
    linearized where it is. Raises RequestError where rest is wanted, and nothing is like it.
    """
    here = Neighbours(problem)
    if at != "rest":
        return here, False
    try:
        return Neighbours(at_rest(problem, "/at")), True
    except RequestError:
        if here.is_constant:
            return here, False
        raise


def _series(subject: Subject, place: int) -> Iterator[list[Document]]:
    """What a tolerance costs as the stiffness grows; where a method fails it is not asked for more."""
    failed: set[str] = set()
    for factor in FACTORS:
        for name in STIFFENED:
            if name in failed:
                yield []
                continue
            one = _stiffened(subject, place, factor, name)
            if one["status"] != "ok":
                failed.add(name)
            yield [one]


def _spectrum(found: Complexes) -> Document:
    return {"eigenvalues": [[significant(z.real, 6), significant(z.imag, 6)] for z in found]}


def stiffness_of(scene: Scene) -> str:
    """The parameter that is the stiffness of the first spring, else the first in N/m, "" if there is none."""
    for spring in (load for load in scene.loads if isinstance(load, Spring)):
        if isinstance(spring.stiffness.tree, Name):
            return spring.stiffness.tree.name
    return next((parameter.name for parameter in scene.parameters if parameter.unit == "N/m"), "")


def _row(neighbours: Neighbours, method: Method) -> Document:
    fails = failure(neighbours, method)
    return {
        "method": method.id,
        "implicit": not method.is_explicit,
        "region": region(method),
        "bound": _finite(fails.bound),
        "predicted": _finite(fails.predicted),
        "measured": _finite(fails.measured),
        "deviation": None if fails.deviation is None else significant(fails.deviation, 2),
        "cause": fails.cause,
        "basis": fails.basis,
        "reason": fails.reason,
        "limit": _finite(fails.limit),
    }


def _finite(step: float | None) -> float | None:
    """None for: every step, and for one that cannot be told; `basis` and `reason` say which."""
    return significant(step) if step is not None and math.isfinite(step) else None


def _stiffened(subject: Subject, place: int, factor: float, name: str) -> Document:
    """What a tolerance costs with so many times the stiffness."""
    values = list(subject.problem.parameters)
    values[place] *= factor
    problem = replace(subject.problem, parameters=tuple(values), step_limit=STEP_LIMIT, samples=101)
    found = simulate(problem, get_method(name), tolerance=TOLERANCE)
    return {
        "method": name,
        "factor": significant(factor),
        "status": found.outcome.status,
        "evaluations": found.cost.run_evaluations,
        "time": significant(found.cost.run_time),
        "error": None if found.estimate is None else significant(found.estimate.worst),
    }


EXPERIMENT = Experiment(StabilityRequest, run, charts)
