"""How honest the error estimate is: all library scenes × methods × accuracies against references of order 8.

Run it from the checkout: `python -m tests.benchmarks.bench_calibration`. Counts samples up to the horizon at which the
true error is above rounding. Prints; judges nothing.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.simulation.driver import simulate
from deltaq.simulation.library import get_method, method_ids
from deltaq.simulation.problem import Problem
from deltaq.simulation.service import problem_of
from deltaq.simulation.trajectory import Trajectory

SPANS, SAMPLES, LIMIT = (2.0, 20.0), 201, 400_000
ACCURACIES = ({"tolerance": 1e-3}, {"tolerance": 1e-6}, {"tolerance": 1e-9}, {"step": 0.02}, {"step": 0.005})
DOUBT = 3.0  # times the estimate of the reference is not counted against a method


@dataclass(frozen=True)
class Score:
    """One run: whether its estimate covers the true error everywhere, and how far above it lies (median)."""

    method: str
    scene: str
    label: str
    is_covered: bool
    excess: float
    shortfall: float


def main() -> None:
    scores = [score for scene in scene_ids() for span in SPANS for score in _scores(scene, span)]
    print(f"{'method':24}{'runs':>6}{'true ≤ estimate':>18}{'estimate ≤ 100 true':>22}{'median ratio':>14}")
    for identifier in (*method_ids(), "all"):
        _line(identifier, [s for s in scores if identifier in (s.method, "all")])
    print(f"\n{'scene':32}{'runs':>6}{'true ≤ estimate':>18}{'estimate ≤ 100 true':>22}{'median ratio':>14}")
    for scene in scene_ids():
        _line(scene, [s for s in scores if s.scene == scene], 32)
    print("\nnot covered:")
    for s in sorted((s for s in scores if not s.is_covered), key=lambda s: -s.shortfall)[:40]:
        print(f"  {s.scene:30}{s.method:24}{s.label:30}true/estimate {s.shortfall:.3g}")


def _line(name: str, scores: list[Score], width: int = 24) -> None:
    if scores:
        covered, near = (np.mean([f(s) for s in scores]) for f in (lambda s: s.is_covered, lambda s: s.excess <= 100))
        middle = np.median([s.excess for s in scores])
        print(f"{name:{width}}{len(scores):6}{covered:18.1%}{near:22.1%}{middle:14.1f}")


def _scores(scene: str, span: float) -> Iterator[Score]:
    problem = replace(problem_of(load_scene(scene), span, SAMPLES), step_limit=LIMIT)
    reference = simulate(replace(problem, step_limit=2_000_000), get_method("dop853"), tolerance=1e-13)
    for identifier in method_ids():
        for accuracy in ACCURACIES:
            found = simulate(problem, get_method(identifier), **accuracy)
            label = f"{span:g} s, " + ", ".join(f"{key} {value:g}" for key, value in accuracy.items())
            score = _score(problem, found, reference, scene, label)
            if score is not None:
                yield score


def _score(problem: Problem, found: Trajectory, reference: Trajectory, scene: str, label: str) -> Score | None:
    """None where nothing can be said: no sample with an error above that of the reference."""
    assert found.estimate is not None
    assert reference.estimate is not None
    count = min(len(found.times), len(reference.times))
    known = found.times[:count] <= min(found.trusted_until, reference.trusted_until)
    true = np.abs(found.values[:count] - reference.values[:count]).max(axis=1)[known]
    told, doubt = found.estimate.errors[:count][known], DOUBT * reference.estimate.errors[:count][known] + 1e-14
    counts = true > 10 * doubt
    if not counts.any():
        return None
    shortfall = float(np.max((true[counts] - doubt[counts]) / told[counts]))
    excess = float(np.median(told[counts] / true[counts]))
    return Score(found.method, scene, label, shortfall <= 1.0, excess, shortfall)


if __name__ == "__main__":
    main()
