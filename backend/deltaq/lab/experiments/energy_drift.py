"""Energy drift: how far E + V − ∫P dt departs from its start over very many steps.

Symplectic methods keep it within a band whose width does not grow for very long times; others lose or win energy,
usually in proportion to the time. With step control the band is narrower, and drifts. Growth is told together with the
size: a method that has lost the energy does not count as one whose error grows little.
Source: Hairer, Lubich, Wanner, Geometric Numerical Integration, IX.8; Benettin, Giorgilli (1994).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ...contract.experiments.energy_drift import MOST_STEPS, EnergyDriftRequest
from ...simulation.method import Method
from ...simulation.outcome import outcome_of
from ...simulation.problem import Problem
from ...simulation.run import Run, Steps
from ...simulation.run import run as run_once
from ...simulation.stiffness import spectrum
from ..charts.energy_drift import charts
from ..drift import departure, energy_scale, sample_times
from ..experiment import Experiment
from ..measurement import Runs, warm
from ..report import Document, Report, appended, rounded, significant
from ..subject import methods_of, subject_of

METHODS = ("symplectic-euler", "stormer-verlet", "implicit-midpoint", "gauss-4", "explicit-euler", "heun", "rk4")
VARIABLE = ("dormand-prince-54", "dop853", "radau-5")
PER_PERIOD = 40  # steps in a period of the fastest motion, if no step is given
PERIODS = 8  # over which the kinetic energy is looked at
LOCAL_TOLERANCE = 1e-6
QUICK = 20_000  # steps of a first run, from which the time of the whole one is told
LONGEST_RUN = 12.0  # seconds


def run(request: EnergyDriftRequest) -> Iterator[Report]:
    """One method after the other."""
    subject = subject_of(request)
    methods = methods_of(subject.problem, request.methods, (*METHODS, *VARIABLE))
    size, tolerance = request.step or _usual_step(subject.problem), request.tolerance or LOCAL_TOLERANCE
    span = request.steps * size
    problem = replace(subject.problem, t_end=span, step_limit=4 * MOST_STEPS)
    head = subject.described | {"t_end": span, "steps": request.steps, "step": size, "tolerance": tolerance}
    warm(Runs.over_kinks(problem), *methods)
    scale, result = energy_scale(problem, PERIODS * PER_PERIOD * size), head | {"lines": []}
    yield Report(0, len(methods), result)
    for done, method in enumerate(methods, 1):
        result = appended(result, "lines", _line(problem, method, _steps(method, size, tolerance), scale))
        yield Report(done, len(methods), result)


def _usual_step(problem: Problem) -> float:
    fastest = spectrum(problem, 0.0, problem.state).size or 1.0
    return significant(math.tau / fastest / PER_PERIOD, 3)


def _steps(method: Method, size: float, tolerance: float) -> Steps:
    """Variable where the method can, and is one of those that are shown for it."""
    return Steps(100.0 * size, tolerance) if method.id in VARIABLE else Steps(size)


def _line(problem: Problem, method: Method, steps: Steps, scale: float) -> Document:
    """One method's departure, unless it would take too long."""
    head: Document = {"method": method.id, "symplectic": method.is_symplectic, "variable": steps.tolerance > 0.0}
    quick = _quick(problem, method, steps)
    if quick.wall_time * problem.t_end > LONGEST_RUN * max(quick.result.reached, 1e-300):
        return head | {"status": "too_slow"}
    times = sample_times(problem.t_end, steps.size if not steps.tolerance else 0.0)
    found = run_once(problem, method, times, np.zeros(1, dtype=np.int64), steps)
    off = departure(problem, found, scale)
    growth = off.growth
    return head | {
        "status": outcome_of(int(found.result.outcome), {}).status,
        "t": rounded(off.times),
        "error": rounded(off.errors, 3),
        "verdict": off.kind.value,
        "largest": significant(off.largest, 3) if math.isfinite(off.largest) else None,
        "lost_at": None if off.lost_at is None else significant(off.lost_at),
        "growth": None if growth is None else significant(growth.power, 2),
        "growth_interval": None if growth is None else rounded((growth.lower, growth.upper), 2),
        "steps": int(found.result.steps),
        "evaluations": int(found.result.evaluations),
        "time": significant(found.wall_time),
    }


def _quick(problem: Problem, method: Method, steps: Steps) -> Run:
    short = replace(problem, step_limit=QUICK)
    return run_once(short, method, np.linspace(0.0, problem.t_end, 1000), np.zeros(1, dtype=np.int64), steps)


EXPERIMENT = Experiment(EnergyDriftRequest, run, charts)
