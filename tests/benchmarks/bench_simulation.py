"""Speed of simulations in one run: right-hand sides, error against time, a new scene from cold.

Run it from the checkout: `python -m tests.benchmarks.bench_simulation`. heyoka and diffrax take part if they are
installed (bench extra). Medians, all in the same run; ratios say more than times. Prints; judges nothing.
"""

from __future__ import annotations

import random
import statistics
from collections.abc import Callable
from dataclasses import replace
from importlib.util import find_spec
from time import perf_counter
from typing import Any

import numpy as np
import sympy as sp
from scipy.integrate import solve_ivp
from tests.benchmarks import bench_rhs
from tests.model.lagranges_method import lagranges_method
from tests.simulation.scenes import double_pendulum

from deltaq.mechanics.scene import Scene
from deltaq.model.equations import equations
from deltaq.model.model import build
from deltaq.simulation.driver import simulate
from deltaq.simulation.library import get_method
from deltaq.simulation.problem import Problem
from deltaq.simulation.service import problem_of

SPAN, SAMPLES, REPEATS = 100.0, 501, 5
PEERS = (("DOP853", (1e-6, 1e-9, 1e-11, 1e-12)), ("Radau", (1e-6, 1e-9, 1e-10)), ("LSODA", (1e-6, 1e-9, 1e-12, 1e-13)))
OWN = (("dop853", (1e-3, 1e-6, 1e-9, 1e-11)), ("gauss-6", (1e-3, 1e-6, 1e-9)), ("radau-5", (1e-3, 1e-6, 1e-9)))

Motion = Callable[[], np.ndarray]  # coordinates at the samples


def calm() -> Scene:
    """A double pendulum that swings without chaos, so that an error can be told after 100 s."""
    scene = double_pendulum()
    starts = zip(scene.coordinates, (0.6, 0.8), strict=True)
    return replace(scene, coordinates=tuple(replace(coordinate, value=value) for coordinate, value in starts))


def main() -> None:
    bench_rhs.main()
    problem = problem_of(calm(), SPAN, SAMPLES)
    reference = simulate(problem, get_method("dop853"), tolerance=1e-13).values
    print(f"\n100 s of a double pendulum, {SAMPLES} samples{'error':>14}{'ms':>10}")
    for name, motion in (*own(problem), *peers(problem), *_heyoka(problem), *_diffrax(problem)):
        error, seconds = measured(motion, reference)
        print(f"{name:44}{error:10.1e}{seconds * 1e3:10.2f}")
    _cold()


def measured(motion: Motion, reference: np.ndarray) -> tuple[float, float]:
    """The largest error, and the seconds of a run."""
    seconds = []
    for _ in range(REPEATS):
        start = perf_counter()
        values = motion()
        seconds.append(perf_counter() - start)
        if seconds[-1] > 1.0:
            break
    return float(np.abs(values - reference).max()), statistics.median(seconds)


def own(problem: Problem) -> list[tuple[str, Motion]]:
    def motion(identifier: str, tolerance: float, *, with_error: bool) -> Motion:
        return lambda: simulate(problem, get_method(identifier), tolerance=tolerance, with_error=with_error).values

    return [
        (
            f"δq {identifier} {tolerance:g}{'' if with_error else ', without estimate'}",
            motion(*each, with_error=with_error),
        )
        for identifier, tolerances in OWN
        for tolerance in tolerances
        for each in [(identifier, tolerance)]
        for with_error in (True, False)
    ]


def _lambdified(problem: Problem) -> Callable[[float, np.ndarray], np.ndarray]:
    symbols, mass, forcing = lagranges_method(double_pendulum())
    function = sp.lambdify(symbols, [mass, forcing], "numpy", cse=True)

    def rhs(t: float, y: np.ndarray) -> np.ndarray:
        matrix, right = function(*y, t, *problem.parameters)
        return np.concatenate([y[2:], np.linalg.solve(matrix, right)[:, 0]])

    return rhs


def peers(problem: Problem) -> list[tuple[str, Motion]]:
    rhs, times = _lambdified(problem), np.linspace(0.0, SPAN, SAMPLES)

    def motion(method: str, tolerance: float) -> Motion:
        options = {"rtol": tolerance, "atol": tolerance, "t_eval": times}
        return lambda: solve_ivp(rhs, (0.0, SPAN), problem.state, method=method, **options).y[:2].T

    return [
        (f"solve_ivp {method} {each:g}", motion(method, each)) for method, tolerances in PEERS for each in tolerances
    ]


def _heyoka(problem: Problem) -> list[tuple[str, Motion]]:
    if find_spec("heyoka") is None:
        return []
    times = np.linspace(0.0, SPAN, SAMPLES)

    def motion(tolerance: float) -> Motion:
        integrator = _taylor(problem, _rates(problem), tolerance)

        def run() -> np.ndarray:
            integrator.time = 0.0
            integrator.state[:] = problem.state
            return np.asarray(integrator.propagate_grid(times)[-1])[:, :2]

        return run

    return [(f"heyoka {tolerance:g}", motion(tolerance)) for tolerance in (1e-9, 1e-15)]


def _diffrax(problem: Problem) -> list[tuple[str, Motion]]:
    """Compiled by XLA for this scene and these numbers; the compilation is not counted."""
    if find_spec("diffrax") is None:
        return []
    import diffrax
    import jax
    import jax.numpy as jnp

    jax.config.update("jax_enable_x64", True)
    accelerations = sp.lambdify(sp.symbols("a b u v", real=True), _rates(problem), "jax")
    term = diffrax.ODETerm(lambda _t, y, _args: jnp.array([y[2], y[3], *accelerations(*y)]))
    saved = diffrax.SaveAt(ts=jnp.linspace(0.0, SPAN, SAMPLES))

    def motion(tolerance: float) -> Motion:
        control = diffrax.PIDController(rtol=tolerance, atol=tolerance)

        @jax.jit
        def solve(start: Any) -> Any:
            options: Any = {"saveat": saved, "stepsize_controller": control, "max_steps": 10**6}
            return diffrax.diffeqsolve(term, diffrax.Dopri8(), 0.0, SPAN, None, start, **options).ys

        solve(problem.state).block_until_ready()
        return lambda: np.asarray(solve(problem.state))[:, :2]

    return [(f"diffrax Dopri8 {tolerance:g}", motion(tolerance)) for tolerance in (1e-6, 1e-9, 1e-12)]


def _rates(problem: Problem) -> list[sp.Expr]:
    """The accelerations in a, b, u, v with the numbers of the problem."""
    symbols, mass, forcing = lagranges_method(double_pendulum())
    values = dict(zip(symbols[5:], problem.parameters, strict=True))
    named = dict(zip(symbols[:4], sp.symbols("a b u v", real=True), strict=True))
    m, f = (part.subs(values).subs(named) for part in (mass, forcing))
    det = m[0, 0] * m[1, 1] - m[0, 1] * m[1, 0]
    return [(m[1, 1] * f[0] - m[0, 1] * f[1]) / det, (m[0, 0] * f[1] - m[1, 0] * f[0]) / det]


def _taylor(problem: Problem, rates: list[sp.Expr], tolerance: float) -> Any:
    import heyoka as hy

    a, b, u, v = hy.make_vars("a", "b", "u", "v")
    system = [(a, u), (b, v), (u, hy.from_sympy(rates[0])), (v, hy.from_sympy(rates[1]))]
    return hy.taylor_adaptive(system, list(problem.state), tol=tolerance)


def _cold() -> None:
    """From a scene never seen before to 100 s at 1e-9, kernels at hand."""
    print("\nnew scene to 100 s at 1e-9")
    for name, work in (("δq", cold), ("LagrangesMethod + lambdify + solve_ivp", cold_peer), ("heyoka", cold_heyoka)):
        milliseconds = work()
        if milliseconds is not None:
            print(f"{name:44}{milliseconds:10.1f} ms")


def cold() -> float:
    """Milliseconds of δq."""
    start = perf_counter()
    scene = calm()
    build(equations(scene), scene)
    simulate(problem_of(scene, SPAN, SAMPLES), get_method("dop853"), tolerance=1e-9)
    return 1e3 * (perf_counter() - start)


def cold_peer() -> float:
    """Milliseconds of SymPy's LagrangesMethod with lambdify and DOP853 of SciPy."""
    problem = problem_of(calm(), SPAN, SAMPLES)
    start = perf_counter()
    solve_ivp(_lambdified(problem), (0.0, SPAN), problem.state, method="DOP853", rtol=1e-10, atol=1e-10)
    return 1e3 * (perf_counter() - start)


def cold_heyoka() -> float | None:
    """Milliseconds in which heyoka compiles and runs given expressions, their derivation not counted; if it is here."""
    if find_spec("heyoka") is None:
        return None
    problem = problem_of(calm(), SPAN, SAMPLES)
    # New numbers in every process, or heyoka would run what it has compiled and kept before.
    factor = random.SystemRandom().uniform(1.0, 1.02)
    rates = _rates(replace(problem, parameters=tuple(factor * each for each in problem.parameters)))
    start = perf_counter()
    _taylor(problem, rates, 1e-12).propagate_grid(np.linspace(0.0, SPAN, SAMPLES))
    return 1e3 * (perf_counter() - start)


if __name__ == "__main__":
    main()
