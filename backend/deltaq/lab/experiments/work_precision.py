"""Work–precision: error against time, and against right-hand sides, of every method on the user's own scene.

The reference is the motion on which two unlike methods of high order agree. Every run is charted, also one that
failed, diverged or would take too long.
Source: Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, II.10.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from ...contract.experiments.work_precision import WorkPrecisionRequest
from ...simulation.problem import Problem
from ...simulation.reference import Reference, reference
from ..charts.work_precision import charts
from ..experiment import Experiment
from ..measurement import REPEATS, Point, Runs, floor_of, measure, order_of, warm
from ..peers import can_follow, peer_tracks
from ..report import Document, Report, machine, measured, significant
from ..subject import bounded, followed_subject_of, methods_of
from ..sweep import SAMPLES, Track, settings_of, sweep

STEP_LIMIT = 1_000_000
WANTED = tuple(10.0 ** (-k / 4) for k in range(4, 49))  # tolerances that the cheapest method is told for


def run(request: WorkPrecisionRequest) -> Iterator[Report]:
    """Every method from coarse to fine."""
    subject = followed_subject_of(request, SAMPLES)
    methods = methods_of(subject.problem, request.methods)
    problem = bounded(subject, STEP_LIMIT)
    trusted = reference(problem)
    runs = Runs.of(problem)
    warm(runs, *methods)
    tracks = [
        Track(method.id, settings_of(problem, method), partial(measure, runs, method, trusted, repeats=REPEATS))
        for method in methods
    ]
    tracks += peer_tracks(problem, trusted) if request.peers else []
    head = subject.described | {"reference": described(trusted, problem), "events": runs.goes_on}
    head |= {"peers_left_out": request.peers and not can_follow(problem)}
    head |= {"machine": machine(), "repeats": REPEATS, "taken": measured(REPEATS)}
    for done, total in sweep(tracks, trusted):
        yield Report(done, total, head | found(tracks, floor_of(trusted)))


def described(trusted: Reference, problem: Problem) -> Document:
    """What the errors were measured against."""
    is_complete = len(trusted.times) == problem.samples
    return {
        "methods": list(trusted.methods),
        "error": significant(floor_of(trusted)),
        "t": float(trusted.times[-1]),
        "complete": is_complete,
    }


def found(tracks: list[Track], floor: float) -> Document:
    """Points so far, slopes, and the cheapest run for each tolerance."""
    points = [point for track in tracks for point in track.points]
    slopes = {track.name: order_of(track.points, lambda point: float(point.evaluations), floor) for track in tracks}
    return {
        "points": [point.described for point in points],
        "orders": {name: order for name, order in slopes.items() if order is not None},
        "cheapest": [one for tolerance in WANTED if (one := cheapest(points, tolerance))],
    }


def cheapest(points: list[Point], tolerance: float) -> Document | None:
    """The run that took least time of all whose error is within the tolerance."""
    good = [point for point in points if point.error is not None and point.error <= tolerance]
    best = min(good, key=lambda point: point.time, default=None)
    return None if best is None else {"wanted": significant(tolerance), **best.described}


EXPERIMENT = Experiment(WorkPrecisionRequest, run, charts)
