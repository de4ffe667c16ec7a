"""Nanoseconds per right-hand side of the double pendulum, beside hand-written C and solve_ivp over lambdify.

Run it from the checkout: `python -m tests.benchmarks.bench_rhs`. All are measured in the same run, in turns; medians.
Prints; judges nothing.
"""

from __future__ import annotations

import ctypes
import shutil
import statistics
import subprocess
import tempfile
from collections.abc import Callable
from pathlib import Path
from time import perf_counter

import numpy as np
import sympy as sp
from scipy.integrate import solve_ivp
from tests.model.lagranges_method import lagranges_method
from tests.simulation.scenes import double_pendulum

from deltaq.simulation.driver import simulate
from deltaq.simulation.library import get_method
from deltaq.simulation.problem import Problem
from deltaq.simulation.run import Steps, run
from deltaq.simulation.service import problem_of

REPEATS = 9
SPAN, STEP = 20.0, 1e-4  # of the fixed-step runs
QUICKEST = "-fno-tree-vectorize"  # vectors of numbers just stored one by one make a processor wait
Timing = Callable[[], float]  # nanoseconds per right-hand side

HAND_WRITTEN = r"""
#include <math.h>
static void rhs(const double *y, double *k, double m1, double m2, double l1, double l2, double g) {
    double s1 = sin(y[0]), c1 = cos(y[0]), s2 = sin(y[1]), c2 = cos(y[1]);
    double c = c1 * c2 + s1 * s2, s = s1 * c2 - c1 * s2;
    double m11 = (m1 + m2) * l1 * l1, m12 = m2 * l1 * l2 * c, m22 = m2 * l2 * l2;
    double f1 = -m2 * l1 * l2 * s * y[3] * y[3] - (m1 + m2) * g * l1 * s1;
    double f2 = m2 * l1 * l2 * s * y[2] * y[2] - m2 * g * l2 * s2;
    double det = m11 * m22 - m12 * m12;
    k[0] = y[2]; k[1] = y[3];
    k[2] = (m22 * f1 - m12 * f2) / det; k[3] = (m11 * f2 - m12 * f1) / det;
}
void rk4(double *y, const double *p, double h, long steps) {
    double a[4], b[4], c[4], d[4], z[4];
    for (long n = 0; n < steps; n++) {
        rhs(y, a, p[0], p[1], p[2], p[3], p[4]);
        for (int i = 0; i < 4; i++) z[i] = y[i] + h / 2 * a[i];
        rhs(z, b, p[0], p[1], p[2], p[3], p[4]);
        for (int i = 0; i < 4; i++) z[i] = y[i] + h / 2 * b[i];
        rhs(z, c, p[0], p[1], p[2], p[3], p[4]);
        for (int i = 0; i < 4; i++) z[i] = y[i] + h * c[i];
        rhs(z, d, p[0], p[1], p[2], p[3], p[4]);
        for (int i = 0; i < 4; i++) y[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
    }
}
"""


def kernel(problem: Problem, identifier: str, steps: Steps) -> Timing:
    """One run of the kernel, with a sample at each end."""
    times, flag = np.array([0.0, problem.t_end]), np.zeros(1, dtype=np.int64)

    def timing() -> float:
        done = run(problem, get_method(identifier), times, flag, steps)
        return done.wall_time / done.result.evaluations * 1e9

    return timing


def hand_written(problem: Problem, folder: Path, *flags: str) -> Timing | None:
    """The same RK4 in C, if there is a compiler."""
    compiler = next((path for name in ("cc", "gcc", "clang") if (path := shutil.which(name))), None)
    if compiler is None:
        return None
    source, library = folder / "pendulum.c", folder / f"pendulum{''.join(flags)}.so"
    source.write_text(HAND_WRITTEN)
    usual = ["-O3", "-march=native", "-shared", "-fPIC", "-o", str(library), str(source), "-lm"]
    subprocess.run([compiler, *usual, *flags], check=True)
    rk4 = ctypes.CDLL(str(library)).rk4
    pointer, steps = ctypes.POINTER(ctypes.c_double), round(SPAN / STEP)
    parameters = np.array(problem.parameters)

    def timing() -> float:
        state = problem.state
        start = perf_counter()
        rk4(
            state.ctypes.data_as(pointer),
            parameters.ctypes.data_as(pointer),
            ctypes.c_double(STEP),
            ctypes.c_long(steps),
        )
        return (perf_counter() - start) / (4 * steps) * 1e9

    return timing


def solve_ivp_over_lambdify(problem: Problem) -> Timing:
    """What one would write without δq: LagrangesMethod, lambdify with cse, DOP853 of SciPy."""
    symbols, mass, forcing = lagranges_method(double_pendulum())
    function = sp.lambdify(symbols, [mass, forcing], "numpy", cse=True)

    def rhs(t: float, y: np.ndarray) -> np.ndarray:
        matrix, right = function(*y, t, *problem.parameters)
        return np.concatenate([y[2:], np.linalg.solve(matrix, right)[:, 0]])

    def timing() -> float:
        start = perf_counter()
        done = solve_ivp(rhs, (0.0, 2.0), problem.state, method="DOP853", rtol=1e-9, atol=1e-9)
        return (perf_counter() - start) / done.nfev * 1e9

    return timing


def whole_answer(problem: Problem) -> tuple[float, int]:
    """Milliseconds for a trajectory to 1e-9 with its error estimate, and right-hand sides of all its runs."""
    start = perf_counter()
    found = simulate(problem, get_method("dop853"), tolerance=1e-9)
    return (perf_counter() - start) * 1e3, found.cost.rhs_evaluations


def main() -> None:
    problem = problem_of(double_pendulum(), SPAN)
    with tempfile.TemporaryDirectory() as folder:
        timings: dict[str, Timing | None] = {
            "rk4 kernel": kernel(problem, "rk4", Steps(STEP)),
            "dop853 kernel": kernel(problem, "dop853", Steps(1.0, 1e-13)),
            "hand-written C, rk4": hand_written(problem, Path(folder)),
            "the same C without vectors": hand_written(problem, Path(folder), QUICKEST),
            "solve_ivp DOP853 over lambdify": solve_ivp_over_lambdify(problem),
        }
        usable = {name: timing for name, timing in timings.items() if timing is not None}
        rounds = [{name: timing() for name, timing in usable.items()} for _ in range(REPEATS)][1:]
    medians = {name: statistics.median(each[name] for each in rounds) for name in usable}
    print(f"{'double pendulum':32}{'ns per right-hand side':>24}{'ratio to the rk4 kernel':>26}")
    for name, value in medians.items():
        print(f"{name:32}{value:24.1f}{value / medians['rk4 kernel']:26.2f}")
    milliseconds, evaluations = min(whole_answer(problem) for _ in range(REPEATS))
    print(f"20 s to 1e-9 with error estimate: {milliseconds:.1f} ms, {evaluations} right-hand sides")


if __name__ == "__main__":
    main()
