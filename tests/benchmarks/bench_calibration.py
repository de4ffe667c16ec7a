"""How honest the error estimate is: library scenes × methods × accuracies against references of two unlike methods.

Run it from the checkout: `python -m tests.benchmarks.bench_calibration 4 seed` tries four starts of each scene, drawn
by that seed (without them one). The estimate's few constants were set by the scenes' own initial values over ten
seconds; here other spans and random initial values are tried, which had no say. Counts samples up to the horizon at
which the reference is known to a thousandth of the tolerance, or to a tenth of the true error. The four-bar's reference
is its motion in one freedom by SciPy: two methods with constraints agree less well. Prints; judges nothing.
(Multipliers: `python -m tests.simulation.multiplier_errors`.)
"""

from __future__ import annotations

import random
import sys
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from tests.simulation.four_bar import followed

from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.simulation.consistency import consistent
from deltaq.simulation.driver import is_suitable, simulate
from deltaq.simulation.library import get_method, method_ids
from deltaq.simulation.problem import Problem
from deltaq.simulation.reference import Reference, reference
from deltaq.simulation.service import problem_of
from deltaq.simulation.trajectory import Trajectory

SPANS, SAMPLES, LIMIT = (3.0, 20.0), 201, 200_000
ACCURACIES = ({"tolerance": 1e-3}, {"tolerance": 1e-6}, {"tolerance": 1e-9}, {"step": 0.02}, {"step": 0.005})
SHIFT = 0.3  # of initial values, at most, either way
KNOWN = 1e-3  # of the tolerance: a truth that is itself better counts at every sample


@dataclass(frozen=True)
class Score:
    """One run: whether its estimate covers the true error everywhere, and how far above it lies (median).

    The latter is nan where no true error is ten times that of the reference.
    """

    method: str
    scene: str
    label: str
    is_covered: bool
    excess: float
    shortfall: float


def main(starts: int = 1, seed: str = "") -> None:
    scores = all_scores(starts, seed)
    print(f"{'method':24}{'runs':>6}{'true ≤ estimate':>18}{'estimate ≤ 100 true':>22}{'median ratio':>14}")
    for identifier in (*method_ids(), "all"):
        _line(identifier, [s for s in scores if identifier in (s.method, "all")])
    print(f"\n{'scene':32}{'runs':>6}{'true ≤ estimate':>18}{'estimate ≤ 100 true':>22}{'median ratio':>14}")
    for scene in scene_ids():
        _line(scene, [s for s in scores if s.scene == scene], 32)
    for share in (1.0, 3.0, 10.0):
        beyond = sum(s.shortfall > share for s in scores)
        print(f"\nestimate more than {share:g} times too small: {beyond} of {len(scores)}", end="")
    print("\n\nnot covered:")
    for s in sorted((s for s in scores if not s.is_covered), key=lambda s: -s.shortfall)[:40]:
        print(f"  {s.scene:30}{s.method:24}{s.label:30}true/estimate {s.shortfall:.3g}")


def all_scores(starts: int = 1, seed: str = "") -> list[Score]:
    """Every run of which something can be said, from so many starts of each scene."""
    draws = [f"{seed}{k}" if k else seed for k in range(starts)]
    return [score for scene in scene_ids() for span in SPANS for draw in draws for score in _scores(scene, span, draw)]


def shares(scores: list[Score]) -> tuple[float, float]:
    """The share of runs whose estimate covers the true error, and of those in which it is at most 100 times it."""
    return float(np.mean([s.is_covered for s in scores])), float(
        np.mean([s.excess <= 100 for s in scores if not np.isnan(s.excess)])
    )


def _line(name: str, scores: list[Score], width: int = 24) -> None:
    if scores:
        covered, near = shares(scores)
        middle = np.nanmedian([s.excess for s in scores])
        print(f"{name:{width}}{len(scores):6}{covered:18.1%}{near:22.1%}{middle:14.1f}")


def _scores(scene: str, span: float, draw: str) -> Iterator[Score]:
    source = f"{draw}{scene} {span}"
    problem = replace(_elsewhere(problem_of(load_scene(scene), span, SAMPLES), source), step_limit=LIMIT)
    trusted = _four_bar(problem) if scene == "four-bar" else reference(replace(problem, step_limit=2_000_000))
    for identifier in (each for each in method_ids() if is_suitable(problem, get_method(each))):
        for accuracy in ACCURACIES:
            found = simulate(problem, get_method(identifier), **accuracy)
            label = f"{span:g} s, " + ", ".join(f"{key} {value:g}" for key, value in accuracy.items())
            score = _score(found, trusted, scene, label, KNOWN * accuracy.get("tolerance", 0.0))
            if score is not None:
                yield score


def _elsewhere(problem: Problem, seed: str) -> Problem:
    """The problem from initial values nearby that keep its constraints, the same in every run."""
    source = random.Random(seed)
    values = tuple(value * (1.0 + source.uniform(-SHIFT, SHIFT)) for value in problem.values)
    rates = tuple(rate * (1.0 + source.uniform(-SHIFT, SHIFT)) for rate in problem.rates)
    moved = replace(problem, values=values, rates=rates)
    return consistent(moved) if problem.is_constrained else moved


def _four_bar(problem: Problem) -> Reference:
    """By steps of two lengths; what they differ by, ten times."""
    times = np.linspace(0.0, problem.t_end, SAMPLES)
    rough, fine = (followed(problem.values[0], problem.rates[0], times, longest)[:, :3] for longest in (0.02, 0.008))
    floor = np.finfo(np.float64).eps * np.maximum(1.0, np.abs(fine).max(axis=1))
    errors = 10.0 * np.maximum.accumulate(np.abs(rough - fine).max(axis=1)) + floor
    return Reference(times, fine, errors, ("DOP853 of SciPy", "the same"))


def _score(found: Trajectory, trusted: Reference, scene: str, label: str, enough: float) -> Score | None:
    """None where nothing can be said: no sample at which the reference is known well enough."""
    assert found.estimate is not None
    own, other = trusted.common(found.times)
    known = found.times[other] <= found.trusted_until
    true, doubt = trusted.errors_of(found)[known], trusted.errors[own][known]
    told = found.estimate.errors[other][known]
    is_above = true > 10 * doubt
    counts = is_above | ((doubt <= enough) & (told > 0.0))
    if not counts.any():
        return None
    shortfall = float(np.max((true[counts] - doubt[counts]) / told[counts]))
    excess = float(np.median(told[is_above] / true[is_above])) if is_above.any() else float("nan")
    return Score(found.method, scene, label, shortfall <= 1.0, excess, shortfall)


if __name__ == "__main__":
    main(*(int(each) for each in sys.argv[1:2]), *sys.argv[2:3])
