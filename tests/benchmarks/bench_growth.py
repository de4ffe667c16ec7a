"""The numeric model of a pendulum of n links as n grows: deriving it, compiling it, running it, each by itself.

Run it from the checkout: `python -m tests.benchmarks.bench_growth`; half a minute. SymEngine derives, LLVM compiles:
quickly what is needed at once (motion and observation), thoroughly for long runs, momenta for implicit methods. A run
is told by its right-hand sides, the linear system of n unknowns included, in quick and thorough code, and by a whole
answer: two seconds to 1e-6 with error estimate. Medians; prints; judges nothing.
"""

from __future__ import annotations

import statistics
from collections.abc import Callable
from dataclasses import replace
from time import perf_counter

import numpy as np
from tests.derivation.scenes import chain

from deltaq.model.compiled import THOROUGH, compile_expressions
from deltaq.model.equations import Equations, equations
from deltaq.model.model import build, of_motion
from deltaq.model.phase import phase_space
from deltaq.simulation.driver import simulate
from deltaq.simulation.library import get_method
from deltaq.simulation.problem import Problem
from deltaq.simulation.run import Steps, run
from deltaq.simulation.service import problem_of

LARGEST, SHORT, SPAN = 20, 0.3, 2.0
COLUMNS = ("derive", "compile", "thoroughly", "momenta", "rhs, ns", "thorough, ns", "answer")


def milliseconds(work: Callable[[], object]) -> float:
    """The median of five runs, or of fewer if they take long."""
    times: list[float] = []
    while len(times) < 5 and sum(times) < SHORT:
        start = perf_counter()
        work()
        times.append((perf_counter() - start) * 1e3)
    return statistics.median(times)


def right_hand_side(problem: Problem, *, is_long: bool) -> float:
    """Nanoseconds per right-hand side in a run of fixed steps."""
    model = replace(problem.model)  # without what was compiled for it before
    if is_long:
        assert model.thorough
    times, flag = np.array([0.0, SPAN]), np.zeros(1, dtype=np.int64)
    found = [run(replace(problem, model=model), get_method("rk4"), times, flag, Steps(1e-4)) for _ in range(5)]
    return statistics.median(each.wall_time / each.result.evaluations * 1e9 for each in found)


def row(n: int) -> tuple[float, ...]:
    scene = chain(n)
    eqs: Equations = equations(scene)
    derive, quick = milliseconds(lambda: equations(scene)), milliseconds(lambda: build(eqs, scene))
    thorough = milliseconds(lambda: compile_expressions(eqs.symbols.inputs, of_motion(eqs), THOROUGH))
    momenta = milliseconds(lambda: phase_space(eqs))
    problem = problem_of(scene, SPAN, 101)
    sides = (right_hand_side(problem, is_long=False), right_hand_side(problem, is_long=True))
    answer = milliseconds(lambda: simulate(problem, get_method("dop853"), tolerance=1e-6))
    return derive, quick, thorough, momenta, *sides, answer


def main() -> None:
    row(2)
    print("n-link pendulum, milliseconds\n" + f"{'n':>3}" + "".join(f"{name:>14}" for name in COLUMNS))
    for n in range(1, LARGEST + 1):
        print(
            f"{n:3}" + "".join(f"{number:14.{0 if 4 <= i <= 5 else 2}f}" for i, number in enumerate(row(n))), flush=True
        )


if __name__ == "__main__":
    main()
