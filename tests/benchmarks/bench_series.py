"""Taylor series here and in heyoka: the same scenes, spans, local tolerances and samples, side by side in one process.

Run it from the checkout: `python -m tests.benchmarks.bench_series [--rounds 7]`, with heyoka installed. Milliseconds of
the processor, medians over alternating rounds; `new` is what a scene that nobody has asked for before takes until its
motion is there (compilation included). heyoka gets δq's own equations, M q̈ = f eliminated in expressions. Prints;
judges nothing.
"""

from __future__ import annotations

import argparse
import os
import random
from collections.abc import Callable
from dataclasses import replace
from statistics import median
from time import process_time
from typing import Any

import numpy as np
from tests.simulation.scenes import document

from deltaq.lab import heyoka
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene
from deltaq.mechanics.scene import Scene
from deltaq.model.equations import equations
from deltaq.model.model import build
from deltaq.simulation.integration import Flag
from deltaq.simulation.library import get_method
from deltaq.simulation.problem import Problem
from deltaq.simulation.run import Steps, run
from deltaq.simulation.service import problem_of, warm

SPAN, SAMPLES, TOLERANCES = 100.0, 101, (1e-12, 1e-15)


def orbit() -> Scene:
    """Kepler's problem at eccentricity 0.9."""
    force = {"kind": "potential", "name": "sun", "energy": "-mu*m/sqrt(x^2 + y^2)"}
    start = {"x": (0.1, 0.0), "y": (0.0, 19.0**0.5)}
    return read_scene(document(start, {"m": 1.0, "mu": 1.0}, {"planet": ("m", ["x", "y"])}, [force]))


SCENES: dict[str, Callable[[], Scene]] = {
    "double pendulum": lambda: load_scene("double-pendulum"),
    "elastic pendulum": lambda: load_scene("elastic-pendulum"),
    "triple pendulum": lambda: load_scene("triple-pendulum"),
    "spherical pendulum": lambda: load_scene("spherical-pendulum"),
    "Kepler, e = 0.9": orbit,
    "chain of 6": lambda: load_scene("chain-pendulum", 6),
}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=7)
    rounds = parser.parse_args().rounds
    warm("taylor-series")
    print(f"{rounds} rounds, load {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores; {SPAN:g} s, {SAMPLES} samples")
    print(f"{'':22}{'ε':>7}{'δq':>9}{'heyoka':>9}{'ratio':>7}{'steps':>12}{'new: δq':>10}{'heyoka':>9}{'ratio':>7}")
    for name, make in SCENES.items():
        for tolerance in TOLERANCES:
            compare(name, make(), tolerance, rounds)


def compare(name: str, scene: Scene, tolerance: float, rounds: int) -> None:
    """One line of the table."""
    asked = problem_of(scene, SPAN, SAMPLES)
    start = process_time()
    problem = of_new(asked, scene)
    ours = motion(problem, tolerance)
    ours()
    new = process_time() - start
    start = process_time()
    solver = compiled(problem, tolerance)
    theirs = their_motion(solver, problem)
    their_steps = theirs()
    their_new = process_time() - start
    problem.model.usage.evaluations = 10**9  # long enough for thorough code
    steps = ours()
    times: tuple[list[float], list[float]] = ([], [])
    for _ in range(rounds):
        for one, kept in zip((ours, theirs), times, strict=True):
            start = process_time()
            one()
            kept.append(process_time() - start)
    mine, other = (1e3 * median(kept) for kept in times)
    print(
        f"{name:22}{tolerance:7.0e}{mine:9.2f}{other:9.2f}{mine / other:7.2f}{f'{steps}/{their_steps}':>12}"
        f"{1e3 * new:10.1f}{1e3 * their_new:9.0f}{their_new / new:7.0f}",
        flush=True,
    )


def of_new(problem: Problem, scene: Scene) -> Problem:
    """The problem with a model of its own, as for a scene that was never asked for."""
    return replace(problem, model=build(equations(scene), scene))


def motion(problem: Problem, tolerance: float) -> Callable[[], int]:
    """One run; returns its steps."""
    times, flag = np.linspace(0.0, SPAN, SAMPLES), _flag()
    return lambda: run(problem, get_method("taylor"), times, flag, Steps(SPAN, tolerance)).result.steps


def _flag() -> Flag:
    return np.zeros(1, dtype=np.int64)


def compiled(problem: Problem, tolerance: float) -> Any:
    """heyoka's integrator for the same equations, with numbers that are new to it: it keeps code on disk."""
    return heyoka.solver(problem, tolerance, [value * random.uniform(0.999, 1.001) for value in problem.parameters])


def their_motion(solver: Any, problem: Problem) -> Callable[[], int]:
    """One run of it; returns its steps."""
    state, times = problem.state[: 2 * problem.degrees].copy(), np.linspace(0.0, SPAN, SAMPLES)

    def once() -> int:
        solver.time, solver.state[:] = 0.0, state
        return int(solver.propagate_grid(times)[3])

    return once


if __name__ == "__main__":
    main()
