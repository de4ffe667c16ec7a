"""Equality by canonical form beside SymPy's simplify and equals: the same questions, one run, ratios printed.

python -m tests.benchmarks.bench_canonical
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from typing import Any

import sympy
from sympy.core.cache import clear_cache
from tests.language import test_latex_syntax, test_plain_syntax
from tests.language.scene_names import DOUBLE, DOUBLE_KINETIC_ENERGY, NAMES, SYMBOLS, Symbols, read

from deltaq.language.canonical import display, is_zero
from deltaq.language.parser import parse
from deltaq.language.sympy_algebra import to_sympy

DOUBLE_EQUATION = f"d/dt (diff({DOUBLE_KINETIC_ENERGY}, dot(phi1))) - diff({DOUBLE_KINETIC_ENERGY}, phi1)"

QUESTIONS = [
    ("virtual work", "F0*cos(phi)*l*cos(phi)*delta(phi) - F0*sin(phi)*(delta(y) - l*sin(phi)*delta(phi))",
     "F0*l*delta(phi) - F0*sin(phi)*delta(y)", NAMES),
    ("elastic pendulum, kinetic energy", "m*((l*cos(phi)*dot(phi))^2 + (dot(y) - l*sin(phi)*dot(phi))^2)/2",
     "m*(dot(y)^2 - 2*l*dot(y)*dot(phi)*sin(phi) + l^2*dot(phi)^2)/2", NAMES),
    ("double pendulum, kinetic energy", DOUBLE_KINETIC_ENERGY,
     "(m1 + m2)*l1^2*dot(phi1)^2/2 + m2*l1*l2*cos(phi1 - phi2)*dot(phi1)*dot(phi2) + m2*l2^2*dot(phi2)^2/2", DOUBLE),
    ("double pendulum, first equation", DOUBLE_EQUATION,
     "(m1 + m2)*l1^2*ddot(phi1) + m2*l1*l2*cos(phi1 - phi2)*ddot(phi2) + m2*l1*l2*sin(phi1 - phi2)*dot(phi2)^2",
     DOUBLE),
    ("tangent of half the angle", "tan(phi/2)", "sin(phi)/(1 + cos(phi))", NAMES),
    ("a wrong sign", "m*l^2*ddot(phi) + m*g*l*sin(phi)", "m*l^2*ddot(phi) - m*g*l*sin(phi)", NAMES),
]  # fmt: skip


def timed(function: Callable[[], Any], runs: int) -> tuple[Any, float]:
    """The answer, and the median time with cold caches in milliseconds."""
    times = []
    answer = None
    for _ in range(runs):
        clear_cache()
        started = time.perf_counter()
        answer = function()
        times.append(1e3 * (time.perf_counter() - started))
    return answer, statistics.median(times)


def equality() -> None:
    """One line for each question."""
    print(f"{'question':36} {'canonical':>18} {'simplify':>22} {'equals':>22}")
    for title, left, right, names in QUESTIONS:
        difference = read(left, names=names) - read(right, names=names)
        symbols = Symbols(names)
        ours, own = timed(lambda d=difference, s=symbols: is_zero(d, s), 9)
        theirs, simplify = timed(lambda d=difference: sympy.simplify(d) == 0, 1)
        other, equals = timed(lambda d=difference: d.equals(0), 1)
        print(
            f"{title:36} {own:8.2f} ms {ours!s:>6} {simplify:9.1f} ms {theirs!s:>5} {simplify / own:5.0f}x"
            f" {equals:9.1f} ms {other!s:>5} {equals / own:5.0f}x"
        )


def reading_and_display() -> None:
    """Parse times over the tables of accepted inputs, and display times."""
    for syntax, rows in (("plain", test_plain_syntax.ACCEPTED), ("latex", test_latex_syntax.ACCEPTED)):
        times = sorted(min(timed(lambda t=text, s=syntax: parse(t, NAMES, s), 5)[1:]) for text, _ in rows)
        print(f"parse {syntax}: median {statistics.median(times):.2f} ms, worst {times[-1]:.2f} ms, {len(times)} texts")
    for title, text, _, names in QUESTIONS[:4]:
        value = to_sympy(parse(text, names).tree, Symbols(names))
        symbols = Symbols(names)
        cold = timed(lambda v=value, s=symbols: display(v, s), 9)[1]
        started = time.perf_counter()
        display(value, symbols)
        warm = 1e3 * (time.perf_counter() - started)
        print(f"display {title}: cold {cold:.2f} ms, warm {warm:.2f} ms")
    assert SYMBOLS.names is NAMES


if __name__ == "__main__":
    equality()
    reading_and_display()
