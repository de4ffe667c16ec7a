"""What constraints cost: a step of two particles on rods against one of the same particles on springs.

Run it from the checkout: `python -m tests.benchmarks.bench_constraints [method …]`, all that keep constraints if
none is named. Both have four coordinates and steps of the same size; the least of alternating rounds counts, in machine
code for long runs. The load stands above, for it is in the times, if hardly in the ratios. Prints; judges nothing.
"""

from __future__ import annotations

import os
import sys

import numpy as np
from tests.simulation.constrained import Document, particle, scene

from deltaq.mechanics.library import load_scene
from deltaq.mechanics.scene import Scene
from deltaq.simulation.library import get_method, method_ids
from deltaq.simulation.method import Method
from deltaq.simulation.problem import Problem
from deltaq.simulation.run import Steps, run
from deltaq.simulation.service import problem_of

STEP, ROUNDS = 1e-3, 300
EVALUATIONS = 5_000  # of a run, as many as its stages ask for: short, so that some runs are not interrupted


def on_rods() -> Scene:
    """Two particles in x₁, y₁, x₂, y₂ and two constraints."""
    return load_scene("double-pendulum-by-rods")


def on_springs() -> Scene:
    """The same particles and places, with springs instead of the rods."""
    rods = on_rods()
    ends: tuple[Document, ...] = (
        {"from": "pivot", "to": "upper", "rest_length": "l1"},
        {"from": "upper", "to": "lower", "rest_length": "l2"},
    )
    loads = [{"name": f"spring{k}", "kind": "spring", "stiffness": "k", **end} for k, end in enumerate(ends)]
    loads += [{"name": "weight", "kind": "gravity", "acceleration": ["0", "g"]}]
    at = {coordinate.name: (coordinate.value, coordinate.rate) for coordinate in rods.coordinates}
    values = {parameter.name: parameter.value for parameter in rods.parameters} | {"k": 50.0}
    bodies = [particle("upper", "x1", "y1", mass="m1"), particle("lower", "x2", "y2", mass="m2")]
    return scene(at, values, bodies, [], points={"pivot": ["0", "0"]}, loads=loads, weight=False)


def seconds(problem: Problem, method: Method) -> float:
    """The time of one step of a run."""
    count = EVALUATIONS // method.scheme.stages
    found = run(problem, method, np.array([0.0, count * STEP]), np.zeros(1, dtype=np.int64), Steps(STEP))
    if not found.is_complete:
        raise RuntimeError(f"{method.id} ended at {found.result.reached:.1f} s: outcome {found.result.outcome}")
    return found.wall_time / found.result.steps


def main() -> None:
    named = sys.argv[1:] or [name for name in method_ids() if name != "taylor"]
    held, free = problem_of(on_rods(), 1.0), problem_of(on_springs(), 1.0)
    for problem in (held, free):
        problem.model.settle()
    print(f"load {os.getloadavg()[0]:.1f}\n{'µs a step':24}{'springs':>10}{'rods':>10}{'ratio':>8}")
    for name in named:
        method = get_method(name)
        both = [(seconds(free, method), seconds(held, method)) for _ in range(ROUNDS)]
        without, with_them = (1e6 * min(each) for each in zip(*both, strict=True))
        print(f"{name:24}{without:10.3f}{with_them:10.3f}{with_them / without:8.2f}", flush=True)


if __name__ == "__main__":
    main()
