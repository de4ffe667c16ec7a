"""Energy drift: how far E + V − ∫P dt departs from its start over very many steps.

Symplectic methods keep it within a band whose width does not grow for very long times; others lose or win energy,
usually in proportion to the time. With step control the band is narrower, and drifts.
Source: Hairer, Lubich, Wanner, Geometric Numerical Integration, IX.8; Benettin, Giorgilli (1994).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace
from itertools import pairwise

import numpy as np

from ...simulation.method import Method
from ...simulation.outcome import outcome_of
from ...simulation.problem import Floats, Problem
from ...simulation.run import Run, Steps
from ...simulation.run import run as run_once
from ...simulation.stiffness import spectrum
from ..bounds import DRIFT_STEPS, LOCAL_TOLERANCES, USUAL_DRIFT
from ..charts.energy_drift import charts
from ..experiment import Experiment
from ..measurement import warm
from ..report import Document, Report, rounded, significant
from ..subject import methods_of, subject_of

METHODS = ("symplectic-euler", "stormer-verlet", "implicit-midpoint", "gauss-4", "explicit-euler", "heun", "rk4")
VARIABLE = ("dormand-prince-54", "dop853", "radau-5")
PER_PERIOD = 40  # steps in a period of the fastest motion, if no step is given
WINDOWS, IN_WINDOW = 240, 40
LOCAL_TOLERANCE = 1e-6
QUICK = 20_000  # steps of a first run, from which the time of the whole one is told
LONGEST_RUN = 12.0  # seconds


def run(document: Mapping[str, object]) -> Iterator[Report]:
    """Further fields: methods (ids), steps (1e3 to 1e6), step (seconds), tolerance (local, of variable steps)."""
    subject = subject_of(document)
    methods = methods_of(subject.request, (*METHODS, *VARIABLE))
    count = subject.request.whole("steps", *DRIFT_STEPS, USUAL_DRIFT)
    step = subject.request.number("step", 0.0, 1e3)
    tolerance = subject.request.number("tolerance", *LOCAL_TOLERANCES, closed=True) or LOCAL_TOLERANCE
    subject.finish("methods", "steps", "step", "tolerance")
    size = step or _usual_step(subject.problem)
    problem = replace(subject.problem, t_end=count * size, step_limit=4 * DRIFT_STEPS[1])
    head = subject.described | {"t_end": count * size, "steps": count, "step": size, "tolerance": tolerance}
    lines: list[Document] = []
    warm(problem, *methods)
    for method in methods:
        yield Report(len(lines), len(methods), head | {"lines": lines})
        lines = [*lines, _line(problem, method, _steps(method, size, tolerance))]
    yield Report(len(lines), len(methods), head | {"lines": lines})


def _usual_step(problem: Problem) -> float:
    fastest = spectrum(problem, 0.0, problem.state).size or 1.0
    return significant(math.tau / fastest / PER_PERIOD, 3)


def _steps(method: Method, size: float, tolerance: float) -> Steps:
    """Variable where the method can, and is one of those that are shown for it."""
    return Steps(100.0 * size, tolerance) if method.id in VARIABLE else Steps(size)


def _line(problem: Problem, method: Method, steps: Steps) -> Document:
    """The largest departure of the balance so far, in windows of time that are equally wide on a logarithmic axis."""
    quick = _quick(problem, method, steps)
    if quick.wall_time * problem.t_end > LONGEST_RUN * max(quick.result.reached, 1e-300):
        return _head(method, steps) | {"status": "too_slow"}
    times = sample_times(problem.t_end, steps.size if not steps.tolerance else 0.0)
    found = run_once(problem, method, times, np.zeros(1, dtype=np.int64), steps)
    departure = _departure(problem, found)
    edges = np.searchsorted(found.times, _edges(times))
    windows = [slice(a, b) for a, b in pairwise(edges) if b > a and a < len(found.times)]
    worst = [float(np.abs(departure[window]).max()) for window in windows]
    middle = [float(found.times[min(window.stop, len(found.times)) - 1]) for window in windows]
    return _head(method, steps) | {
        "status": outcome_of(int(found.result.outcome), {}).status,
        "t": rounded(middle),
        "error": rounded(worst, 3),
        "growth": growth(np.array(middle), np.array(worst)),
        "steps": int(found.result.steps),
        "evaluations": int(found.result.evaluations),
        "time": significant(found.wall_time),
    }


def _head(method: Method, steps: Steps) -> Document:
    return {"method": method.id, "symplectic": method.is_symplectic, "variable": steps.tolerance > 0.0}


def _quick(problem: Problem, method: Method, steps: Steps) -> Run:
    short = replace(problem, step_limit=QUICK)
    return run_once(short, method, np.linspace(0.0, problem.t_end, 1000), np.zeros(1, dtype=np.int64), steps)


def sample_times(t_end: float, step: float) -> Floats:
    """Times dense at the start and out of tune with any period; whole steps, so that nothing is interpolated."""
    edges = np.geomspace(1e-4, 1.0, WINDOWS) * t_end
    chance = np.random.default_rng(1).uniform(size=(WINDOWS - 1, IN_WINDOW))
    times = np.sort((edges[:-1, None] + chance * np.diff(edges)[:, None]).ravel())
    whole = np.round(times / step) * step if step else times
    return np.unique(np.concatenate([[0.0], whole[whole < t_end], [t_end]]))


def _edges(times: Floats) -> Floats:
    return np.concatenate([np.geomspace(1e-4, 1.0, WINDOWS // 2) * times[-1]])


def _departure(problem: Problem, found: Run) -> Floats:
    """Of E + V − ∫P dt from its start, in parts of the largest kinetic energy at the start."""
    states, n = found.states, problem.degrees
    seen = problem.model.observe(problem.inputs(found.times, states[:, : 2 * n]))
    work = states[:, 2 * n] if states.shape[1] > 2 * n else 0.0
    balance = seen.kinetic + seen.potential - work
    early = max(10, len(found.times) // 20)
    scale = float(max(seen.kinetic[:early].max(), np.ptp(seen.potential[:early]), 1e-300))
    return np.asarray((balance - balance[0]) / scale)


def growth(times: Floats, errors: Floats) -> float | None:
    """The exponent p of error ∝ t^p over the last decade of time: about 0 is bounded, 1 linear."""
    late = (times > 0.1 * times[-1]) & (errors > 1e-15) & np.isfinite(errors) if times.size else times > 0
    if late.sum() < 8:
        return None
    return significant(float(np.polyfit(np.log(times[late]), np.log(np.maximum.accumulate(errors[late])), 1)[0]), 2)


EXPERIMENT = Experiment("energy-drift", run, charts)
