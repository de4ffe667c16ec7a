"""Rows of the table of targets: derivation, model, right-hand side, accuracy for time, honesty of the estimate."""

from __future__ import annotations

import asyncio
import statistics
import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from tests.benchmarks import bench_calibration, bench_chain, bench_derivation, bench_rhs, bench_simulation
from tests.benchmarks.targets import REPEATS, Target, medians
from tests.simulation.scenes import double_pendulum

from deltaq.mechanics.library import scene_ids
from deltaq.simulation.driver import simulate
from deltaq.simulation.library import get_method
from deltaq.simulation.run import Steps
from deltaq.simulation.service import problem_of


def models() -> Iterator[Target]:
    """From a scene to a compiled model."""
    command = "deltaq bench chain"
    bench_chain.seconds(bench_chain.model(2))
    own, peer = bench_chain.seconds(bench_chain.model(4)), bench_chain.seconds(lambda: bench_chain.lagranges_method(4))
    told = f"{peer / own:.0f} × ({own * 1e3:.1f} ms, {peer * 1e3:.0f} ms)"
    yield Target("model of 4 links against LagrangesMethod", "≥ 100 ×", told, peer >= 100 * own, command)
    ten = bench_chain.seconds(bench_chain.model(10))
    yield Target("model of 10 links", "< 300 ms", f"{ten * 1e3:.0f} ms", ten < 0.3, command)


def derivations() -> Iterator[Target]:
    """From a scene to verified steps with their sentences."""
    command = "deltaq bench derivation"
    bench_derivation.cold({"scene": "pendulum"})
    cold = {
        name: statistics.median(bench_derivation.cold({"scene": name, "lang": "en"}) for _ in range(REPEATS))
        for name in scene_ids()
    }
    for what, found, limit in (("cold", cold, 300.0), ("cached", asyncio.run(bench_derivation.cached()), 10.0)):
        worst = max(found, key=lambda name, found=found: found[name])  # type: ignore[misc]
        above = sum(each >= limit for each in found.values())
        told = (
            f"{found['elastic-pendulum']:.1f} ms; worst of {len(found)} {found[worst]:.1f} ms ({worst}), {above} above"
        )
        yield Target(f"derivation of elastic-pendulum, {what}", f"< {limit:g} ms", told, above == 0, command)


def right_hand_side() -> Iterator[Target]:
    """The compiled model beside C."""
    problem = problem_of(double_pendulum(), bench_rhs.SPAN)
    own = bench_rhs.kernel(problem, "rk4", Steps(bench_rhs.STEP))
    with tempfile.TemporaryDirectory() as folder:
        peer = bench_rhs.hand_written(problem, Path(folder), bench_rhs.QUICKEST)
        if peer is None:
            print("no C compiler: the right-hand side is not compared")
            return
        own(), peer()
        mine, theirs = medians(own, peer)
    told = f"{mine / theirs:.2f} × ({mine:.0f} ns, {theirs:.0f} ns)"
    yield Target("right-hand side against C", "≤ 1.5 ×", told, mine <= 1.5 * theirs, "deltaq bench rhs")


def accuracy() -> Iterator[Target]:
    """100 s of a double pendulum: the seconds of solve_ivp's methods at the very error that δq has."""
    problem = problem_of(bench_simulation.calm(), bench_simulation.SPAN, bench_simulation.SAMPLES)
    reference = simulate(problem, get_method("dop853"), tolerance=1e-13).values
    lines: dict[str, list[tuple[float, float]]] = {}
    for name, motion in bench_simulation.peers(problem):
        lines.setdefault(name.split()[1], []).append(bench_simulation.measured(motion, reference))
    for name, motion in bench_simulation.own(problem):
        if name.startswith("δq dop853 1e-09"):
            error, seconds = bench_simulation.measured(motion, reference)
            what = f"100 s to 1e-9, {'without' if 'without' in name else 'with'} estimate, against solve_ivp"
            yield _faster(what, error, seconds, {method: at_error(line, error) for method, line in lines.items()})


def _faster(what: str, error: float, seconds: float, peers: dict[str, float]) -> Target:
    times = {method: peer / seconds for method, peer in peers.items()}
    told = ", ".join(f"{method} {ratio:.0f} ×" for method, ratio in times.items() if np.isfinite(ratio))
    figure = f"{told} (error {error:.0e} in {seconds * 1e3:.1f} ms)"
    return Target(what, "≥ 200 ×", figure, min(times.values()) >= 200, "deltaq bench simulation")


def at_error(line: list[tuple[float, float]], error: float) -> float:
    """Seconds on the line through (error, seconds), straight in logarithms; infinite for what is never so accurate."""
    errors, seconds = np.log(sorted(line)).T
    return float(np.exp(np.interp(np.log(error), errors, seconds, left=np.inf)))


def cold_start() -> Iterator[Target]:
    """From a scene never seen to its motion."""
    bench_simulation.cold()
    own, peer = medians(bench_simulation.cold, bench_simulation.cold_peer)
    heyoka = bench_simulation.cold_heyoka()
    told = f"{own:.1f} ms; solve_ivp {peer:.0f} ms; heyoka {'is not here' if heyoka is None else f'{heyoka:.0f} ms'}"
    met = own < min(peer, heyoka or peer)
    yield Target("new scene to 100 s at 1e-9", "fastest", told, met, "deltaq bench simulation")


def estimates() -> Iterator[Target]:
    """Library scenes, all methods, other spans and initial values than the estimate was tuned on."""
    scores = bench_calibration.all_scores()
    covered, near = bench_calibration.shares(scores)
    command, runs = "deltaq bench calibration", f"of {len(scores)} runs"
    yield Target("true error ≤ estimate", "≥ 99 %", f"{covered:.1%} {runs}", covered >= 0.99, command)
    yield Target("estimate ≤ 100 × true error", "≥ 90 %", f"{near:.1%} {runs}", near >= 0.9, command)
