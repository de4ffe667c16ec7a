"""Lyapunov exponents held against truth from outside: motions drawn at random, variational equations in heyoka.

`python -m tests.benchmarks.bench_lyapunov [seed] [per family]` draws motions, measures both, and prints how many
intervals cover and how many verdicts are right, undecided, wrong. With `--write` the truth goes into the table that the
tests read.
Needs heyoka (`pip install heyoka`); equations of motion stand here once more, by hand, so that nothing is shared.
"""

from __future__ import annotations

import json
import math
import sys
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import asdict, replace
from importlib import import_module
from typing import Any

import numpy as np
from tests.lab.motions import TABLE, Motion

from deltaq.lab.divergence import followed, rhythm_of
from deltaq.lab.lyapunov import exponent_of, judge

LONG = {
    "henon": 100_000,
    "quartic": 60_000,
    "spring": 40_000,
    "atwood": 40_000,
    "double": 60_000,
}  # periods, if chaotic
SHORT, OTHERS, TRANSIENT = 8_000, 30_000, 1_000
GROWS = 0.005  # in a period
G = 9.81

Draw = Callable[[float, float], float]


def _henon(u: Draw) -> Motion:
    while True:
        energy, y, rate = u(0.02, 0.1666), u(-0.4, 0.5), u(-0.4, 0.4)
        square = 2 * energy - rate**2 - y**2 + 2 * y**3 / 3
        if square >= 0.0:
            return Motion("henon", {"m": 1.0}, (0.0, y), (math.sqrt(square), rate), 0.0)


def _double(u: Draw) -> Motion:
    angles = (u(-3, 3), u(-3, 3))
    masses = {"m1": u(0.3, 3), "m2": u(0.3, 3), "l1": u(0.4, 1.5), "l2": u(0.4, 1.5), "g": G}
    return Motion("double", masses, angles, (0.0, 0.0), 0.0)


def _small_double(u: Draw) -> Motion:
    masses = {"m1": 1.0, "m2": 1.0, "l1": 1.0, "l2": 1.0, "g": G}
    return Motion("double", masses, (u(-0.8, 0.8), u(-0.8, 0.8)), (0.0, 0.0), 0.0)


def _driven(u: Draw) -> Motion:
    q, force, frequency = u(1.8, 4), u(0.6, 1.6), u(0.55, 0.75)
    parameters = {"m": 1.0, "l": 1.0, "g": 1.0, "F": force, "w": frequency, "c": 1.0 / q}
    return Motion("driven", parameters, (u(-1, 1),), (u(-1, 1),), 0.0)


def _two_wells(u: Draw) -> Motion:
    parameters = {"m": 1.0, "k": u(0.1, 0.5), "a": -1.0, "b": 1.0, "B": u(0.1, 0.6), "w": u(0.9, 1.4)}
    return Motion("duffing", parameters, (u(-1, 1),), (0.0,), 0.0)


def _ueda(u: Draw) -> Motion:
    parameters = {"m": 1.0, "k": u(0.05, 0.3), "a": 0.0, "b": 1.0, "B": u(4, 13), "w": 1.0}
    return Motion("duffing", parameters, (u(-1, 1),), (0.0,), 0.0)


def _spring(u: Draw) -> Motion:
    parameters = {"m": 1.0, "k": u(20, 80), "l": 1.0, "g": G}
    return Motion("spring", parameters, (u(0.9, 1.6), u(0.05, 1.5)), (0.0, 0.0), 0.0)


def _quartic(u: Draw) -> Motion:
    return Motion("quartic", {"m": 1.0, "c": u(0.5, 3)}, (u(0.2, 2), u(-1, 1)), (u(-1, 1), u(-2, 2)), 0.0)


def _atwood(u: Draw) -> Motion:
    return Motion("atwood", {"m": 1.0, "M": u(1.2, 5), "g": G}, (u(0.5, 1.5), u(0.3, 1.5)), (0.0, 0.0), 0.0)


def _pendulum(angle: float, rate: float, damping: float = 0.0) -> Motion:
    return Motion("pendulum", {"m": 1.0, "l": 1.0, "g": 1.0, "c": damping}, (angle,), (rate,), 0.0)


DRAWS: tuple[Callable[[Draw], Motion], ...] = (
    _henon,
    _double,
    _small_double,
    _driven,
    _two_wells,
    _ueda,
    _spring,
    _quartic,
    _atwood,
    lambda u: _pendulum(u(0.2, 2.9), u(-0.2, 0.2)),
    lambda u: _pendulum(0.0, u(2.1, 3.5)),
    lambda u: _pendulum(u(0.5, 2.5), 0.0, u(0.02, 0.5)),
    lambda u: Motion(
        "oscillator", {"m": 1.0, "k": u(0.5, 4), "c": 0.05 * round(u(0, 1))}, (u(0.1, 2),), (u(-1, 1),), 0.0
    ),
)


def system(motion: Motion) -> tuple[list[Any], float]:
    """Equations for heyoka, and a typical period."""
    hy, p = import_module("heyoka"), motion.parameters
    n = len(motion.values)
    names = ("x", "y")[:n] + ("u", "v")[:n]
    state = hy.make_vars(*names)
    q, v = state[:n], state[n:]
    slopes, period = {
        "henon": lambda: ([-q[0] - 2 * q[0] * q[1], -q[1] - q[0] ** 2 + q[1] ** 2], math.tau),
        "quartic": lambda: ([-q[0] - p["c"] * q[0] * q[1] ** 2, -q[1] - p["c"] * q[0] ** 2 * q[1]], math.tau),
        "pendulum": lambda: ([-p["g"] * hy.sin(q[0]) - p["c"] * v[0]], math.tau),
        "driven": lambda: (
            [-hy.sin(q[0]) - p["c"] * v[0] + p["F"] * hy.cos(p["w"] * hy.time)],
            math.tau / p["w"],
        ),
        "oscillator": lambda: ([-p["k"] * q[0] - p["c"] * v[0]], math.tau),
        "duffing": lambda: (
            [-p["k"] * v[0] - p["a"] * q[0] - p["b"] * q[0] ** 3 + p["B"] * hy.cos(p["w"] * hy.time)],
            math.tau / p["w"],
        ),
        "spring": lambda: (
            [
                q[0] * v[1] ** 2 + p["g"] * hy.cos(q[1]) - p["k"] / p["m"] * (q[0] - p["l"]),
                (-p["g"] * hy.sin(q[1]) - 2 * v[0] * v[1]) / q[0],
            ],
            math.tau * math.sqrt(p["m"] / p["k"]),
        ),
        "atwood": lambda: (
            [
                (q[0] * v[1] ** 2 + p["g"] * hy.cos(q[1]) - p["g"] * p["M"]) / (1 + p["M"]),
                (-p["g"] * hy.sin(q[1]) - 2 * v[0] * v[1]) / q[0],
            ],
            math.tau * math.sqrt(motion.values[0] / p["g"]),
        ),
        "double": lambda: (_double_pendulum(hy, p, q, v), math.tau * math.sqrt(p["l1"] / p["g"])),
    }[motion.family]()
    return list(zip(state, [*v, *slopes], strict=True)), period


def _double_pendulum(hy: Any, p: Any, q: Any, v: Any) -> list[Any]:
    """Accelerations in closed form (see any textbook of chaos)."""
    m1, m2, l1, l2, g = (p[name] for name in ("m1", "m2", "l1", "l2", "g"))
    off = q[0] - q[1]
    under = 2 * m1 + m2 - m2 * hy.cos(2 * off)
    first = -g * (2 * m1 + m2) * hy.sin(q[0]) - m2 * g * hy.sin(q[0] - 2 * q[1])
    first -= 2 * hy.sin(off) * m2 * (v[1] ** 2 * l2 + v[0] ** 2 * l1 * hy.cos(off))
    second = v[0] ** 2 * l1 * (m1 + m2) + g * (m1 + m2) * hy.cos(q[0]) + v[1] ** 2 * l2 * m2 * hy.cos(off)
    return [first / (l1 * under), 2 * hy.sin(off) * second / (l2 * under)]


def truth(motion: Motion) -> Motion:
    """The motion with its exponent: a vector carried by the variational equations, made short in every period."""
    rates, period = rates_of(motion, SHORT)
    if rates.mean() * period > GROWS:
        rates, period = rates_of(motion, LONG.get(motion.family, OTHERS))
    parts = rates[: rates.size // 8 * 8].reshape(8, -1).mean(axis=1)
    is_zero = abs(rates.mean()) * period < 0.6 * GROWS  # regular and not damped: the mean falls like ln(t)/t
    exponent, error = (0.0, 0.0) if is_zero else (float(rates.mean()), float(parts.std(ddof=1) / math.sqrt(8)))
    return replace(motion, exponent=float(f"{exponent:.6g}"), error=float(f"{error:.2g}"))


def rates_of(motion: Motion, periods: int) -> tuple[np.ndarray, float]:
    """Growth rates in each period after a transient, and the period."""
    hy, (equations, period) = import_module("heyoka"), system(motion)
    width = len(equations)
    variational = hy.var_ode_sys(equations, hy.var_args.vars, order=1)
    stepper = hy.taylor_adaptive(variational, [*motion.values, *motion.rates], tol=1e-13)
    unit, found = np.eye(width).ravel(), np.zeros(periods + TRANSIENT)
    vector = np.random.default_rng(5).normal(size=width)
    for index in range(found.size):
        stepper.state[width:] = unit
        stepper.propagate_until((index + 1) * period)
        vector = stepper.state[width:].reshape(width, width) @ vector
        size = float(np.linalg.norm(vector))
        found[index], vector = math.log(size) / period, vector / size
    return found[TRANSIENT:], period


def draw(seed: int, each: int) -> Iterator[Motion]:
    """So many motions of each family."""
    random = np.random.default_rng(seed)

    def between(low: float, high: float) -> float:
        return float(np.round(random.uniform(low, high), 4))

    for make in DRAWS:
        for _ in range(each):
            yield make(between)


def main() -> None:
    """Draws, measures, and prints or writes."""
    numbers = [int(one) for one in sys.argv[1:] if one.isdigit()]
    seed, each = [*numbers, *(2, 4)[len(numbers) :]]
    tally: Counter[str] = Counter()
    known = []
    for motion in map(truth, draw(seed, each)):
        known.append(motion)
        *_, seen = followed(motion.problem, rhythm_of(motion.problem))
        found = exponent_of(seen)
        said, right = judge(seen, found).verdict, "chaotic" if motion.exponent > 0.0 else "regular"
        tally["covered" if found and found.lower <= motion.exponent <= found.upper else "missed"] += 1
        tally["undecided" if said == "undecided" else "right" if said == right else "wrong"] += 1
        interval = f"[{found.lower:10.6f} {found.upper:10.6f}]" if found else ""
        print(f"{motion.family:11}{motion.exponent:11.6f} ±{motion.error:8.1e} {interval} {said}", flush=True)
    print(dict(tally))
    if "--write" in sys.argv:
        TABLE.write_text(json.dumps([asdict(one) for one in known], indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
