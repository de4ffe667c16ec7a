"""Chaos: twin runs that part, the Lyapunov exponent with a verdict, what an extra digit buys, and a map of flips.

Each further digit of accuracy lengthens the time that a chaotic motion can be predicted by the same ln(10)/λ.
Source: see `lab.divergence`, `lab.lyapunov` and `lab.flips`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ...contract.experiments.chaos import ChaosRequest
from ...simulation.problem import Floats, Problem
from ...simulation.reference import Reference, reference
from ..charts.chaos import charts
from ..divergence import Followed, followed, rhythm_of, solved, twins
from ..experiment import Experiment
from ..flips import Plane
from ..lyapunov import CONFIDENCE, Exponent, Judgement, exponent_of, is_enough, judge
from ..minimal_subject import FreeSubject, minimal_subject_of
from ..report import Document, Report, rounded, significant
from ..sliding import require_no_sliding

SAMPLES = 801
APART = 1e-8  # of the twins, if nobody says
DIGITS = range(2, 13)
WRONG = 0.1  # an error this large ends a prediction
MAP_SPAN = 15.0  # seconds; at most that of the motion
SHOWN, SCANTY = 200, 0.05  # points of a curve of the exponent; the part of it whose means are over too few to show
FIRST, LAST = 2, 39  # reports that the exponent is done at


def run(request: ChaosRequest) -> Iterator[Report]:
    """Twins, exponent and horizon, then the map where it is wanted."""
    found, apart = minimal_subject_of(request, SAMPLES), request.apart or APART
    subject = found.subject
    problem, total = subject.problem, 40 + 10 * request.map
    require_no_sliding(problem)
    result = found.described | {"apart": apart, "twins": _twins(problem, apart)}
    yield Report(1, total, result)
    for part, done in _measured(problem):
        result = result | {"exponent": part}
        yield Report(done, total, result)
    result = result | {"horizon": horizon(problem)}
    yield Report(40, total, result)
    if request.map:
        for part in _map(found, request.count):
            result = result | {"map": part}
            yield Report(total, total, result)


def _twins(problem: Problem, apart: float) -> Document:
    times, distances = twins(problem, apart, SAMPLES)
    return {"t": rounded(times), "distance": rounded(distances, 4)}


def _measured(problem: Problem) -> Iterator[tuple[Document, int]]:
    """The exponent while it is measured, and how many reports are done; the last one has the verdict."""
    for motion in followed(problem, rhythm_of(problem)):
        exponent = exponent_of(motion)
        if motion.is_whole or is_enough(motion, exponent):
            yield _exponent(motion, exponent) | _judged(judge(motion, exponent)), LAST
            return
        if exponent is not None:
            yield _exponent(motion, exponent), FIRST + int((LAST - FIRST) * motion.progress)


def _exponent(motion: Followed, found: Exponent | None) -> Document:
    head: Document = {"status": motion.status, "span": significant(motion.span), "confidence": CONFIDENCE}
    if found is None:
        return head | {"t": [], "values": [], "last": None, "spread": None, "interval": None, "transient": None}
    few = slice(int(SCANTY * len(found.times)), None, max(1, len(found.times) // SHOWN))
    return head | {
        "t": rounded(found.times[few], 5),
        "values": rounded(found.values[few], 4),
        "last": significant(found.last, 4),
        "spread": significant(found.spread, 2),
        "interval": [significant(found.lower), significant(found.upper)],
        "transient": significant(found.transient),
        "growth": {
            "exponential": {"rate": significant(found.last), "misfit": significant(found.misfits[0], 3)},
            "power": {"power": significant(found.power, 3), "misfit": significant(found.misfits[1], 3)},
        },
    }


def _judged(judgement: Judgement) -> Document:
    k = judgement.irregularity
    told = None if math.isnan(k) else significant(k, 3)
    second: Document = {"name": "0-1 test", "value": told}
    return {"verdict": judgement.verdict.value, "reason": judgement.reason.value, "second_indicator": second}


def horizon(problem: Problem) -> Document:
    """The time that each tolerance predicts, and how much one more digit buys (least squares)."""
    trusted = reference(problem)
    known = int((trusted.errors < 0.1 * WRONG).cumprod().sum())
    found = {10.0**-k: _lost(problem, 10.0**-k, trusted, known) for k in DIGITS}
    told = [{"tolerance": tolerance, "t": significant(t)} for tolerance, t in found.items() if t is not None]
    digits = np.array([-math.log10(tolerance) for tolerance, t in found.items() if t is not None])
    times = np.array([t for t in found.values() if t is not None])
    slope = significant(float(np.polyfit(digits, times, 1)[0]), 3) if len(times) >= 3 else None
    return {"points": told, "per_digit": slope, "known_until": significant(float(trusted.times[known - 1]))}


def _lost(problem: Problem, tolerance: float, trusted: Reference, known: int) -> float | None:
    """The first time at which a run of this local tolerance is wrong; None if it is right while anything is known."""
    found = solved(problem, trusted.times, tolerance)
    count = min(known, len(found.times))
    wrong = _differences(found.states[:count, : problem.degrees], trusted.values[:count]) > WRONG
    return float(trusted.times[int(np.argmax(wrong))]) if wrong.any() else None


def _differences(first: Floats, second: Floats) -> Floats:
    return np.asarray(np.abs(first - second).max(axis=1))


def _map(found: FreeSubject, count: int) -> Iterator[Document]:
    """Turning over, from rest at the values of the first two angles, which are to be the scene's own."""
    subject = found.subject
    if found.minimal is not None:
        yield {"missing": "constraints"}
        return
    problem = replace(subject.problem, t_end=min(MAP_SPAN, subject.problem.t_end))
    angles = [place for place, is_angle in enumerate(problem.angular) if is_angle]
    if len(angles) < 2:
        yield {"missing": "angles"}
        return
    at_rest = replace(problem, rates=(0.0,) * problem.degrees)
    side = (np.arange(count) + 0.5) / count * math.tau - math.pi
    names = [coordinate.name for coordinate in subject.scene.free]
    for times in Plane(at_rest, angles[0], angles[1], side, side).refined():
        yield {
            "x": {"coordinate": names[angles[0]], "values": rounded(side, 5)},
            "y": {"coordinate": names[angles[1]], "values": rounded(side, 5)},
            "t_end": problem.t_end,
            "times": [[_told(float(t)) for t in row] for row in times],
        }


def _told(time: float) -> float | None:
    """−1 where nothing turns over in time, None where it is not known."""
    if math.isnan(time):
        return None
    return significant(time, 3) if math.isfinite(time) else -1.0


EXPERIMENT = Experiment(ChaosRequest, run, charts)
