"""The pendulum of n links: the numeric model against SymPy's LagrangesMethod, and the derivation that is read.

Run it from the checkout: `python -m tests.benchmarks.bench_chain`. The model is what runs: equations and machine code.
LagrangesMethod does the same by `form_lagranges_equations` and `lambdify`; it is left out from the n on for which
it took longer than a minute. Medians of three runs (one where a run takes long). Prints; judges nothing.
"""

from __future__ import annotations

import statistics
from collections.abc import Callable
from time import perf_counter

import sympy as sp
from sympy.core.cache import clear_cache
from sympy.physics.mechanics import LagrangesMethod, dynamicsymbols
from tests.derivation.scenes import chain

from deltaq.model.equations import equations
from deltaq.model.model import build
from deltaq.narration.derive import derive_request

LARGEST, LIMIT, LONG = 12, 60.0, 5.0


def seconds(work: Callable[[], object]) -> float:
    """The median of three runs, or one if it takes long."""
    times: list[float] = []
    while len(times) < 3 and sum(times) < LONG:
        clear_cache()
        start = perf_counter()
        work()
        times.append(perf_counter() - start)
    return statistics.median(times)


def model(n: int) -> Callable[[], object]:
    scene = chain(n)
    return lambda: build(equations(scene), scene)


def lagranges_method(n: int) -> None:
    m, l, g = sp.symbols("m l g", positive=True)
    angles = dynamicsymbols(f"phi1:{n + 1}")
    t = dynamicsymbols._t
    x = [sum(l * sp.sin(q) for q in angles[: i + 1]) for i in range(n)]
    y = [sum(l * sp.cos(q) for q in angles[: i + 1]) for i in range(n)]
    kinetic = sum(m * (a.diff(t) ** 2 + b.diff(t) ** 2) / 2 for a, b in zip(x, y, strict=True))
    method = LagrangesMethod(kinetic + m * g * sum(y), angles)
    method.form_lagranges_equations()
    rates = [q.diff(t) for q in angles]
    sp.lambdify([*angles, *rates, m, l, g], [method.mass_matrix, method.forcing], cse=True)


def main() -> None:
    seconds(model(2))
    print(f"{'n':>3}{'model, ms':>12}{'LagrangesMethod, ms':>22}{'ratio':>8}{'derivation, ms':>16}")
    peer = 0.0
    for n in range(2, LARGEST + 1):
        own = seconds(model(n))
        read = seconds(lambda n=n: derive_request({"scene": "chain-pendulum", "parameters": {"n": n}}))  # type: ignore[misc]
        peer = seconds(lambda n=n: lagranges_method(n)) if peer < LIMIT else peer  # type: ignore[misc]
        told = f"{peer * 1e3:22.0f}{peer / own:8.0f}" if peer < LIMIT else f"{'over a minute':>22}{'':8}"
        print(f"{n:3}{own * 1e3:12.1f}{told}{read * 1e3:16.0f}", flush=True)


if __name__ == "__main__":
    main()
