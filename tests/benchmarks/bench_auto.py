"""What `auto` costs beside the best method: all library scenes, tolerances and spans.

Run it from the checkout: `python -m tests.benchmarks.bench_auto`. Seconds of all runs with error estimate, the least of
a few repeats; methods that miss the tolerance do not count. Prints; judges nothing.
"""

from __future__ import annotations

from dataclasses import replace
from time import perf_counter

import numpy as np
from tests.simulation.scenes import oscillator

from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.mechanics.scene import Scene
from deltaq.simulation.auto import choose
from deltaq.simulation.choice import AUTO
from deltaq.simulation.driver import simulate
from deltaq.simulation.library import get_method, method_ids
from deltaq.simulation.problem import Problem
from deltaq.simulation.service import problem_of

SPANS, TOLERANCES, REPEATS, LIMIT = (5.0, 100.0), (1e-3, 1e-6, 1e-9), 3, 100_000
STIFF = {
    "stiff spring, damped": "-1e6*x - 1e4*dot(x) + F0*cos(omega*t)",
    "stiff spring, undamped": "-1e4*x + F0*cos(omega*t)",
    "cubic spring": "-k*x - 20*x^3 - c*dot(x)",
    "quadratic drag": "-k*x - c*abs(dot(x))*dot(x)",
}


def main() -> None:
    scenes = {name: load_scene(name) for name in scene_ids()} | {name: oscillator(f) for name, f in STIFF.items()}
    print(f"{'scene':32}{'span':>6}{'tolerance':>10}  {'auto':20}{'ms':>8}  {'best':20}{'ms':>8}{'ratio':>7}")
    ratios = [
        _row(name, scene, span, tolerance)
        for name, scene in scenes.items()
        for span in SPANS
        for tolerance in TOLERANCES
    ]
    found = np.array([ratio for ratio in ratios if ratio is not None])
    print(f"within 2 × of the best: {np.mean(found <= 2):.1%} of {len(found)}; median ratio {np.median(found):.2f}")


def _row(name: str, scene: Scene, span: float, tolerance: float) -> float | None:
    problem = replace(problem_of(scene, span, 501), step_limit=LIMIT)
    chosen = choose(AUTO, scene, problem, None, tolerance).method.id
    seconds = {identifier: _seconds(problem, identifier, tolerance) for identifier in method_ids()}
    best = min(seconds, key=lambda identifier: seconds[identifier])
    if not np.isfinite(seconds[best]):
        print(f"{name:32}{span:6g}{tolerance:10.0e}  {chosen:20}{'-':>8}  no method reaches it")
        return None
    ratio = seconds[chosen] / seconds[best]
    costs = f"{seconds[chosen] * 1e3:8.2f}  {best:20}{seconds[best] * 1e3:8.2f}{ratio:7.2f}"
    print(f"{name:32}{span:6g}{tolerance:10.0e}  {chosen:20}{costs}")
    return ratio


def _seconds(problem: Problem, identifier: str, tolerance: float) -> float:
    """Infinite if the tolerance is missed."""
    least = np.inf
    for _ in range(REPEATS):
        start = perf_counter()
        found = simulate(problem, get_method(identifier), tolerance=tolerance)
        if not found.tolerance_reached:
            return np.inf
        least = min(least, perf_counter() - start)
        if least > 0.05:
            break
    return float(least)


if __name__ == "__main__":
    main()
