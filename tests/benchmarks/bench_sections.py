"""Points of Poincaré sections a second, and how exact they are: beside SciPy's events over the same equations.

Run it from the checkout: `python -m tests.benchmarks.bench_sections [--rounds 5]`. Seconds of the processor, medians
over alternating rounds. The true errors are those of the closed form of two oscillators; Hénon and Heiles have none, so
that there the energy tells. Prints; judges nothing.
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable
from statistics import median
from time import process_time

import numpy as np
from scipy.integrate import solve_ivp
from tests.simulation.scenes import scene

from deltaq.language.parser import parse
from deltaq.mechanics.scene import Scene
from deltaq.model.observables import Observables
from deltaq.simulation.problem import Floats
from deltaq.simulation.run import Steps
from deltaq.simulation.section import ORDER, TOLERANCE, Surface, follow
from deltaq.simulation.service import problem_of

SPAN, FEW = 300.0, 4  # seconds; motions that SciPy gets, for it takes long
HENON_HEILES = "m*(x^2 + y^2)/2 + x^2*y - y^3/3"
OSCILLATORS = "m*x^2/2 + m*y^2"


def plane(energy: str) -> Scene:
    """A particle in the plane, in a potential."""
    well = {"kind": "potential", "name": "well", "energy": energy}
    return scene({"x": (0.0, 0.0), "y": (0.0, 0.0)}, {"m": 1.0}, {"p": ("m", ["x", "y"])}, [well])


def starts(count: int) -> Floats:
    """Of one energy, 1/12 for Hénon and Heiles, where x = 0."""
    random = np.random.default_rng(1)
    y, v = random.uniform(-0.2, 0.2, (2, count))
    return np.column_stack([0.0 * y, y, np.sqrt(2.0 / 12.0 - y**2 + 2.0 * y**3 / 3.0 - v**2), v])


def points(of: Scene, begun: Floats, *, twins: bool) -> tuple[Floats, float]:
    """Rows (motion, t, q, q̇) of the points, and the seconds; with `twins` the error of each is found as well."""
    surface = Surface(Observables(of).observable(parse("x", of.names)).jet.table)
    problem, flag = problem_of(of, SPAN), np.zeros(1, dtype=np.int64)
    start = process_time()
    steps = Steps(0.05 * SPAN, TOLERANCE, order=ORDER)
    found = [part for part, _ in follow(problem, surface, begun, steps, 10**6, flag, twins=twins)]
    seconds = process_time() - start
    rows = np.concatenate([np.column_stack([part.motions, part.times, part.states]) for part in found])
    return rows[rows[:, 0] < len(begun)], seconds


def peer(flow: Callable[[float, Floats], list[float]], begun: Floats) -> tuple[int, float, float]:
    """SciPy's DOP853 with an event: points, seconds, and the largest |x| of one."""

    def rises(_t: float, state: Floats) -> float:
        return float(state[0])

    rises.direction = 1.0  # type: ignore[attr-defined]
    start, count, worst = process_time(), 0, 0.0
    for state in begun:
        found = solve_ivp(flow, (0.0, SPAN), state, method="DOP853", rtol=1e-12, atol=1e-13, events=rises)
        count += len(found.t_events[0])
        worst = max(worst, float(np.abs(found.y_events[0][:, 0]).max()))
    return count, process_time() - start, worst


def henon_heiles(_t: float, s: Floats) -> list[float]:
    """d/dt (q, q̇) by hand."""
    return [s[2], s[3], -s[0] - 2.0 * s[0] * s[1], -s[1] - s[0] ** 2 + s[1] ** 2]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=5)
    rounds = parser.parse_args().rounds
    of, few = plane(HENON_HEILES), starts(FEW)
    for count in (16, 64, 256):
        begun, rates = starts(count), {"ours": list[float](), "with errors": list[float](), "SciPy": list[float]()}
        for _ in range(rounds):
            for name, twins in (("ours", False), ("with errors", True)):
                rows, seconds = points(of, begun, twins=twins)
                rates[name].append(len(rows) / seconds)
            found, seconds, _ = peer(henon_heiles, few)
            rates["SciPy"].append(found / seconds)
        ours, judged, theirs = (median(each) for each in rates.values())
        print(
            f"Hénon–Heiles, {count:3d} orbits: {ours:7.0f} points/s, with errors {judged:7.0f}; SciPy {theirs:5.0f}",
            end="",
        )
        print(f" (ratio {ours / theirs:.0f})")
    _, _, x, y, u, v = rows.T
    energy = 0.5 * (u**2 + v**2 + x**2 + y**2) + x**2 * y - y**3 / 3.0
    print(f"largest |x| {np.abs(x).max():.1e}, energy right to {np.abs(12.0 * energy - 1.0).max():.1e}")
    rows, _ = points(plane(OSCILLATORS), starts(64), twins=False)
    begun, root = starts(64)[rows[:, 0].astype(int)], math.sqrt(2.0)
    true = begun[:, 1] * np.cos(root * rows[:, 1]) + begun[:, 3] / root * np.sin(root * rows[:, 1])
    number = np.round(rows[:, 1] / math.tau)
    print(f"two oscillators: y wrong by {np.abs(rows[:, 3] - true).max():.1e}", end="")
    print(f", t by {np.abs(rows[:, 1] - math.tau * number).max():.1e}")


if __name__ == "__main__":
    main()
