"""A thousand motions at once, here and in heyoka's batches: the same equations and starts, side by side in one process.

Run it from the checkout: `python -m tests.benchmarks.bench_ensembles [--rounds 7] [--motions 1000]`, with heyoka
installed for the comparison. Seconds of the processor for spans of 10 s, medians over alternating rounds. `alone` is
one run of each motion at a local tolerance, which is what heyoka does; `whole` has a tolerance of 1e-9 for the
coordinates, estimates and statuses with it: two runs of each, and more of those that missed it. Prints; judges nothing.
"""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable
from importlib.util import find_spec
from statistics import median
from time import process_time

import numpy as np

from deltaq.lab import heyoka
from deltaq.mechanics.library import load_scene
from deltaq.simulation.ensemble import Ensemble, in_lanes, run_ensemble
from deltaq.simulation.problem import Floats
from deltaq.simulation.run import Steps
from deltaq.simulation.service import problem_of

SPAN, TOLERANCE, LOCAL = 10.0, 1e-9, 1e-10
SCENES = ("double-pendulum", "elastic-pendulum", "spherical-pendulum", "triple-pendulum", "chain-pendulum")


def ensemble_of(name: str, motions: int) -> Ensemble:
    """Motions that begin some hundredths away from the scene's own."""
    problem = problem_of(load_scene(name), SPAN, 2)
    start = problem.state[: 2 * problem.degrees]
    states = start + 0.05 * np.random.default_rng(3).normal(size=(motions, len(start)))
    return Ensemble(problem, states, np.repeat([problem.parameters], motions, axis=0))


def peer(ensemble: Ensemble) -> Callable[[], Floats]:
    """heyoka's run of them, as many side by side as it recommends; returns where they end, shape (motions, 2n)."""
    batch = heyoka.batch_solver(ensemble.problem, LOCAL)
    size = batch.batch_size

    def once() -> Floats:
        ends = np.empty_like(ensemble.states)
        for start in range(0, len(ensemble) - size + 1, size):
            batch.set_time(0.0)
            batch.state[:] = ensemble.states[start : start + size].T
            batch.propagate_until(SPAN)
            ends[start : start + size] = batch.state.T
        return ends

    return once


def seconds(run: Callable[[], object]) -> float:
    """Of the processor."""
    start = process_time()
    run()
    return process_time() - start


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--motions", type=int, default=1000)
    asked = parser.parse_args()
    print(f"{asked.motions} motions, {asked.rounds} rounds, load {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")
    print(f"{'':20}{'alone':>9}{'heyoka':>9}{'ratio':>7}{'apart':>9}{'whole':>9}{'ok':>6}")
    for name in SCENES:
        compare(name, asked.motions, asked.rounds)


def compare(name: str, motions: int, rounds: int) -> None:
    """One line of the table; `apart` is the median difference of where both end."""
    ensemble = ensemble_of(name, motions)
    times, flag = np.array([0.0, SPAN]), np.zeros(1, dtype=np.int64)

    def alone() -> Floats:
        return in_lanes(ensemble, times, Steps(0.05 * SPAN, LOCAL), flag).samples[:, -1, : ensemble.states.shape[1]]

    runs: dict[str, Callable[[], object]] = {"alone": alone, "whole": lambda: run_ensemble(ensemble, TOLERANCE)}
    apart, ends = float("nan"), alone()
    if find_spec(heyoka.NAME) is not None:
        runs["heyoka"] = theirs = peer(ensemble)
        apart = float(np.median(np.abs(theirs() - ends)[: motions // 8 * 8]))
    kept = {which: [seconds(run)] for which, run in runs.items()}
    for _ in range(rounds):
        for which, run in runs.items():
            kept[which].append(seconds(run))
    found = {which: median(each[1:]) for which, each in kept.items()}
    other = found.get("heyoka", float("nan"))
    fine = sum(each.status == "ok" for each in run_ensemble(ensemble, TOLERANCE).outcomes)
    mine, whole = found["alone"], found["whole"]
    print(f"{name:20}{mine:9.3f}{other:9.3f}{mine / other:7.2f}{apart:9.0e}{whole:9.3f}{fine:6d}", flush=True)


if __name__ == "__main__":
    main()
