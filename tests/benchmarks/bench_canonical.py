"""Equality by canonical form beside SymPy's simplify and equals: the same questions, one run, ratios printed.

python -m tests.benchmarks.bench_canonical
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable, Iterator
from typing import Any

import sympy
from sympy.core.cache import clear_cache
from tests.language import test_latex_syntax, test_plain_syntax
from tests.language.scene_names import DOUBLE, DOUBLE_KINETIC_ENERGY, NAMES, SYMBOLS, Symbols, read

from deltaq.language.canonical import display, is_zero
from deltaq.language.parser import parse
from deltaq.language.sympy_algebra import time_derivative, to_sympy
from deltaq.mechanics.library import load_scene
from deltaq.narration.derive import derive_request

SCENES = ("pendulum", "base-pendulum", "elastic-pendulum", "guided-pendulum", "double-pendulum", "spherical-pendulum")

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


def scene_questions(scene_id: str) -> Iterator[tuple[str, Any, Symbols]]:
    """For each equation that is derived and shown: its difference from d/dt ∂T/∂q̇ − ∂T/∂q − Q, not simplified."""
    scene = load_scene(scene_id)
    symbols = Symbols(scene.names)
    guides = {}
    for guide in scene.guides:
        value = to_sympy(guide.value.tree, symbols)
        guides |= {symbols.name(guide.coordinate): value}
        guides |= {symbols.rate(guide.coordinate): time_derivative(value, symbols)}
    energy = sympy.Integer(0)
    for body in scene.bodies:
        velocity = [time_derivative(to_sympy(x.tree, symbols), symbols).xreplace(guides) for x in body.position]
        energy += to_sympy(body.mass.tree, symbols) * sympy.Add(*(v**2 for v in velocity)) / 2
    result = derive_request({"scene": scene_id})["result"]
    for force, shown in zip(result["generalized_forces"]["total"], result["equations"], strict=True):
        q, rate = symbols.name(shown["coordinate"]), symbols.rate(shown["coordinate"])
        left = time_derivative(energy.diff(rate), symbols) - energy.diff(q)
        left -= to_sympy(parse(force["plain"], scene.names).tree, symbols)
        equation = to_sympy(parse(shown["plain"], scene.names).tree, symbols)
        yield f"{scene_id}, {shown['coordinate']}", left - (equation.lhs - equation.rhs), symbols


def scenes() -> None:
    """The equations of the lecture's scenes and of the double pendulum."""
    ratios: list[tuple[float, float]] = []
    for scene_id in SCENES:
        for title, difference, symbols in scene_questions(scene_id):
            if difference == 0:
                print(f"{title:36} the same without any simplification")
                continue
            ours, own = timed(lambda d=difference, s=symbols: is_zero(d, s), 9)
            theirs, simplify = timed(lambda d=difference: sympy.simplify(d) == 0, 3)
            other, equals = timed(lambda d=difference: d.equals(0), 3)
            ratios.append((simplify / own, equals / own))
            print(
                f"{title:36} {own:8.2f} ms {ours!s:>6} {simplify:9.1f} ms {theirs!s:>5} {simplify / own:5.0f}x"
                f" {equals:9.1f} ms {other!s:>5} {equals / own:5.0f}x"
            )
    first, second = (statistics.median(column) for column in zip(*ratios, strict=True))
    print(f"median ratio over {len(ratios)} equations: {first:.0f}x to simplify, {second:.0f}x to equals")


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
    scenes()
    reading_and_display()
