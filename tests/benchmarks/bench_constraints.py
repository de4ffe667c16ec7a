"""What constraints cost: a step of bodies on rods, in joints and on blades against one of the same bodies without.

Run it from the checkout: `python -m tests.benchmarks.bench_constraints [method …]`, all that keep constraints if none
is named. Both have the same coordinates and steps of the same size; the two particles hang on springs instead of rods,
of the others the constraints are left out. Runs of thousands of steps count, in machine code for short runs and for
long ones: the least and the median of alternating rounds. The load stands above, for it is in the times, if hardly in
the ratios of the least. Prints; judges nothing.
"""

from __future__ import annotations

import os
import sys
from dataclasses import replace
from typing import Any

import numpy as np
from tests.simulation.constrained import Document, particle
from tests.simulation.constrained import scene as scene_of

from deltaq.mechanics.drawing import Drawing
from deltaq.mechanics.library import load_scene
from deltaq.mechanics.scene import Scene
from deltaq.simulation.library import get_method, method_ids
from deltaq.simulation.method import Method
from deltaq.simulation.problem import Problem
from deltaq.simulation.run import Steps, run
from deltaq.simulation.service import problem_of

STEP, ROUNDS = 1e-3, 60
EVALUATIONS = 5_000  # of a run, as many as its stages ask for: short, so that some runs are not interrupted
SCENES = ("double-pendulum-by-rods", "cartesian-pendulum", "four-bar", "slider-crank", "chaplygin-sleigh")
NOTHING: Any = {"constraints": (), "labels": {}, "drawing": Drawing()}  # labels and drawings name constraints


def on_rods() -> Scene:
    """Two particles in x₁, y₁, x₂, y₂ and two constraints."""
    return load_scene(SCENES[0])


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
    return scene_of(at, values, bodies, [], points={"pivot": ["0", "0"]}, loads=loads, weight=False)


def without(name: str) -> Scene:
    """The scene without its constraints."""
    return on_springs() if name == SCENES[0] else replace(load_scene(name), **NOTHING)


def seconds(problem: Problem, method: Method) -> float:
    """The time of one step of a run, in the code that the model has; runs before do not count towards another one."""
    count = EVALUATIONS // method.scheme.stages
    found = run(problem, method, np.array([0.0, count * STEP]), np.zeros(1, dtype=np.int64), Steps(STEP))
    problem.model.usage.evaluations = 0
    if not found.is_complete:
        raise RuntimeError(f"{method.id} ended at {found.result.reached:.1f} s: outcome {found.result.outcome}")
    return found.wall_time / found.result.steps


def report(code: str, scene: str, pair: tuple[Problem, Problem], methods: list[str]) -> None:
    """A line for each method."""
    for name in methods:
        method = get_method(name)
        rounds = [[seconds(problem, method) for problem in pair] for _ in range(ROUNDS)][1:]  # the first compiles
        (free, held), (usual, usual_held) = 1e6 * np.min(rounds, axis=0), np.median(rounds, axis=0)
        ratios = f"{held / free:8.2f}{usual_held / usual:8.2f}"
        print(f"{scene:26}{code:7}{name:24}{free:10.3f}{held:10.3f}{ratios}", flush=True)


def main() -> None:
    methods = sys.argv[1:] or [name for name in method_ids() if name != "taylor"]
    print(f"load {os.getloadavg()[0]:.1f}\n{'µs a step':57}{'without':>10}{'with':>10}{'ratio':>8}{'medians':>8}")
    for scene in SCENES:
        pair = problem_of(without(scene), 1.0), problem_of(load_scene(scene), 1.0)
        report("short", scene, pair, methods)
        for problem in pair:
            problem.model.settle()
        report("long", scene, pair, methods)


if __name__ == "__main__":
    main()
