"""How honest the errors of ensembles are: members of scattered starts against heyoka's series in 80-bit numbers.

Run it from the checkout: `python -m tests.benchmarks.bench_ensemble_errors [--motions 60] [--margin 3]`, with heyoka
installed. For families of scenes and tolerances it prints the share of members whose true error is no larger than told
at any sample, the largest ratio of true to told, and quantiles of told over true (of a member, the medians over its
samples). `--margin` tries another factor of what neighbours tell. Prints; judges nothing.
"""

from __future__ import annotations

import argparse
import os
from dataclasses import dataclass
from random import Random
from time import process_time

import numpy as np
from tests.benchmarks import outside_truth as truth
from tests.simulation.adversaries import Draw

from deltaq.mechanics.document import read_scene
from deltaq.simulation import ensemble as engine
from deltaq.simulation.ensemble import Ensemble, run_ensemble
from deltaq.simulation.problem import Floats
from deltaq.simulation.service import problem_of

SAMPLES, SCATTER, OWN = 41, 0.05, 4.0 * 2.0**-52
TOLERANCES = (1e-5, 1e-7, 1e-9, 1e-11)
FAMILIES: tuple[tuple[Draw, truth.Series], ...] = (
    (truth.double_pendulum, truth.DOUBLE_PENDULUM),
    (truth.elastic_pendulum, truth.ELASTIC),
    (truth.spherical_pendulum, truth.SPHERICAL),
    (truth.henon_heiles, truth.HENON_HEILES),
    (truth.kepler_in_polar_coordinates, truth.POLAR),
    (truth.pendulum, truth.PENDULUM),
    (truth.heavy_symmetric_top, truth.TOP),
)


@dataclass(frozen=True)
class Judged:
    """Of each member that kept its digits: the largest true error over that told, and told over true (median)."""

    short: Floats
    excess: Floats


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--motions", type=int, default=60)
    parser.add_argument("--margin", type=float, default=engine.MARGIN)
    parser.add_argument("--seed", default="errors")
    asked = parser.parse_args()
    engine.MARGIN = asked.margin
    print(f"margin {asked.margin:g}, load {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")
    print(f"{'family':24}{'tolerance':>10}{'members':>9}{'true ≤ told':>13}{'worst':>8}{'told/true 10/50/90 %':>26}")
    every: list[Judged] = []
    for draw, series in FAMILIES:
        every += family(draw, series, asked.motions, f"{asked.seed} {draw.__name__}")
    _line("all", "", Judged(*(np.concatenate([getattr(one, n) for one in every]) for n in ("short", "excess"))))


def family(draw: Draw, series: truth.Series, motions: int, seed: str) -> list[Judged]:
    """Members around one motion of a family, at each tolerance; their truths are the same."""
    one = draw(Random(seed))
    problem = problem_of(read_scene(one.scene), min(one.t_end, 10.0), SAMPLES)
    start, width = problem.state[: 2 * problem.degrees], 2 * problem.degrees
    states = start + SCATTER * np.random.default_rng(7).normal(size=(motions, width))
    ensemble = Ensemble(problem, states, np.repeat([problem.parameters], motions, axis=0))
    values = {each.name: each.value for each in problem.model.scene.parameters}
    names, n = [each.name for each in problem.model.scene.free], problem.degrees
    times = np.linspace(0.0, problem.t_end, SAMPLES)
    starts = [{q: (row[i], row[n + i]) for i, q in enumerate(names)} for row in states]
    truths = np.array([series.solve(begun, values, times) for begun in starts])
    order = [series.coordinates.index(name) for name in names]
    found = []
    for tolerance in TOLERANCES:
        found.append(judged(ensemble, truths[:, :, order], tolerance))
        _line(one.family, f"{tolerance:.0e}", found[-1])
    return found


def judged(ensemble: Ensemble, truths: np.ndarray, tolerance: float) -> Judged:
    """An ensemble against its truths, shape (motions, samples, n), up to where digits are lost."""
    begin = process_time()
    found = run_ensemble(ensemble, tolerance)
    print(f"{1e3 * (process_time() - begin):6.1f} ms ", end="")
    kept = np.array([outcome.status in ("ok", "tolerance_missed") for outcome in found.outcomes])
    true = np.abs(found.values - truths).astype(np.float64)[kept, 1:]
    own, told = OWN * np.abs(found.values[kept, 1:]), np.maximum(found.errors[kept, 1:], 1e-300)
    short = (np.maximum(true - own, 0.0) / told).max(axis=(1, 2), initial=0.0)
    excess = np.median((told / np.maximum(true, own + 1e-300)).reshape(len(true), -1), axis=1)
    return Judged(short, excess)


def _line(name: str, label: str, found: Judged) -> None:
    if not len(found.short):
        print(f"{name:24}{label:>10}{0:9}")
        return
    low, middle, high = np.quantile(found.excess, [0.1, 0.5, 0.9])
    covered = float(np.mean(found.short <= 1.0))
    print(f"{name:24}{label:>10}{len(found.short):9}{covered:13.1%}{found.short.max():8.2f}", end="")
    print(f"{low:10.1f} /{middle:5.1f} /{high:6.1f}", flush=True)


if __name__ == "__main__":
    main()
