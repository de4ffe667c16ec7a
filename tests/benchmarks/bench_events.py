"""What events behind which a motion goes on cost: sticking and slipping, against SciPy's `solve_ivp` and its events.

Run it from the checkout: `python -m tests.benchmarks.bench_events [rounds]`. The peer is what one would write by hand
with SciPy for the scene: one right-hand side for each mode, terminal events, and a new start behind each. It is one run
that says nothing of its error; of ours there are the same single run, and the whole answer with its error estimate. The
least of alternating rounds counts. Errors are the largest at the samples, against SciPy with its finest tolerance. The
load stands above. Prints; judges nothing.
"""

from __future__ import annotations

import math
import os
import sys
from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from time import perf_counter

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from tests.simulation.test_hybrid import scene_here

from deltaq.mechanics.writing import write_scene
from deltaq.simulation import service
from deltaq.simulation.driver import simulate
from deltaq.simulation.kernels.compiler import MACHINE
from deltaq.simulation.library import get_method

Floats = NDArray[np.float64]
Pair = tuple[float, float]
SAMPLES, TOLERANCE, FINEST, ROUNDS = 501, 1e-9, 2.3e-14, 40
LOCAL = 0.01 * TOLERANCE  # the local tolerance of the peer: with more, its error is above ours
G, K = 9.81, 20.0


@dataclass(frozen=True)
class Mode:
    """A smooth right-hand side for (x, v), the event that ends it as it rises through zero, and what follows."""

    rates: Callable[[float, Pair], Pair]
    ends: Callable[[float, Pair], float]
    following: Callable[[Pair], Mode | None]


def braked(sign: float) -> Mode:
    """Of a block on a spring that slips on rough ground to that side; it ends at rest, and goes on or sticks."""
    friction = 0.15 * G

    def following(state: Pair) -> Mode | None:
        return braked(-math.copysign(1.0, state[0])) if K * abs(state[0]) > friction else None

    return Mode(lambda _, s: (s[1], -K * s[0] - sign * friction), lambda _, s: -sign * s[1], following)


def slipping() -> Mode:
    """Of a block on a belt that is faster than itself."""

    def rates(_: float, state: Pair) -> Pair:
        friction = G * (0.2 + 0.2 * math.exp(-abs(state[1] - 0.3) / 0.5))
        return state[1], friction - K * state[0]

    return Mode(rates, lambda _, s: s[1] - 0.3, lambda _: sticking())


def sticking() -> Mode:
    """Of the same block as the belt carries it along."""
    return Mode(lambda _, _s: (0.3, 0.0), lambda _, s: K * s[0] - 0.4 * G, lambda _: slipping())


def by_scipy(mode: Mode | None, start: Pair, t_end: float, tolerance: float) -> Floats:
    """x at the samples, shape (SAMPLES,)."""
    times, time, state = np.linspace(0.0, t_end, SAMPLES), 0.0, start
    found, filled = np.empty(SAMPLES), 0
    while mode is not None and filled < SAMPLES:
        ends = mode.ends
        ends.terminal, ends.direction = True, 1.0  # type: ignore[attr-defined]
        run = solve_ivp(
            mode.rates, (time, t_end), state, "DOP853", times[filled:], events=ends, rtol=tolerance, atol=tolerance
        )
        found[filled : filled + run.t.size] = run.y[0] if run.t.size else ()
        filled += run.t.size
        if run.status != 1:
            break
        time, state = float(run.t_events[0][0]), tuple(run.y_events[0][0].tolist())
        mode = mode.following(state)
    found[filled:] = state[0]
    return found


# The scene, how long, and where the peer begins.
CASES: tuple[tuple[str, float, Mode, Pair], ...] = (
    ("braked-oscillator", 6.0, braked(-1.0), (1.0, 0.0)),
    ("stick-slip", 5.0, slipping(), (0.0, 0.0)),
)


def seconds(work: Callable[[], object]) -> float:
    """Of wall time."""
    start = perf_counter()
    work()
    return perf_counter() - start


def least(rounds: int, *works: Callable[[], object]) -> list[float]:
    """The least time of each in ms, taken in turns so that all see the same machine."""
    return [1e3 * min(times) for times in zip(*([seconds(work) for work in works] for _ in range(rounds)), strict=True)]


def compared(name: str, t_end: float, mode: Mode, start: Pair, method: str, rounds: int) -> str:
    """A row of the table."""
    scene = scene_here(name)
    problem = service.problem_of(scene, t_end, SAMPLES)
    request = {"scene": write_scene(scene), "t_end": t_end, "tolerance": TOLERANCE, "method": method}
    chosen = get_method(str(service.run(request)["method"]))
    peer, one, whole = least(
        rounds,
        lambda: by_scipy(mode, start, t_end, LOCAL),
        lambda: simulate(problem, chosen, tolerance=TOLERANCE, with_error=False),
        lambda: service.run(request),
    )
    found, truth = simulate(problem, chosen, tolerance=TOLERANCE), by_scipy(mode, start, t_end, FINEST)
    theirs = np.abs(by_scipy(mode, start, t_end, LOCAL) - truth).max()
    ours = np.abs(found.values[np.isin(found.times, [each.time for each in found.transitions], invert=True), 0] - truth)
    events = len(found.transitions)
    return (
        f"{name + ', ' + method:28}{events:7d}{peer:8.2f}{one:9.2f}{peer / one:7.1f}{whole:9.2f}{peer / whole:7.1f}"
        f"{theirs:10.1e}{ours.max():9.1e}"
    )


def main() -> None:
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else ROUNDS
    import_module(MACHINE)  # so that no kernel is interpreted
    heads = f"{'events':>7}{'SciPy':>8}{'one run':>9}{'ratio':>7}{'answer':>9}{'ratio':>7}{'error':>10}{'ours':>9}"
    print(f"load {os.getloadavg()[0]:.1f}\n{'ms':28}{heads}")
    for case in CASES:
        for method in ("dop853", "auto"):
            print(compared(*case, method, rounds), flush=True)


if __name__ == "__main__":
    main()
