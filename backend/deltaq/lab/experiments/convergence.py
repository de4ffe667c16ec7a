"""Convergence: the error of every method with a fixed step h, which falls like h^p where p is the method's order.

Methods with step control are held to the step, too. Below, rounding takes over; above, stability ends.
Source: Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, II.3.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from ...contract.experiments.convergence import ConvergenceRequest
from ...simulation.library import get_method
from ...simulation.reference import reference
from ..charts.convergence import charts
from ..experiment import Experiment
from ..measurement import Runs, floor_of, measure, order_of, warm
from ..report import Document, Report, measured
from ..subject import bounded, followed_subject_of, methods_of
from ..sweep import SAMPLES, Track, fixed_steps, sweep
from .work_precision import described

STEP_LIMIT = 400_000


def run(request: ConvergenceRequest) -> Iterator[Report]:
    """Every method from coarse to fine."""
    subject = followed_subject_of(request, SAMPLES)
    methods = methods_of(subject.problem, request.methods)
    problem = bounded(subject, STEP_LIMIT)
    trusted, settings = reference(problem), fixed_steps(problem)
    runs = Runs.of(problem)
    warm(runs, *methods)
    tracks = [Track(method.id, settings, partial(measure, runs, method, trusted, repeats=1)) for method in methods]
    head = subject.described | {"reference": described(trusted, problem), "events": runs.goes_on}
    head |= {"taken": measured(1)}
    for done, total in sweep(tracks, trusted):
        yield Report(done, total, head | _found(tracks, floor_of(trusted)))


def _found(tracks: list[Track], floor: float) -> Document:
    orders = {track.name: order_of(track.points, lambda point: 1.0 / point.setting.value, floor) for track in tracks}
    return {
        "points": [point.described for track in tracks for point in track.points],
        "orders": {
            name: {"measured": order, "theory": get_method(name).order}
            for name, order in orders.items()
            if order is not None
        },
    }


EXPERIMENT = Experiment(ConvergenceRequest, run, charts)
