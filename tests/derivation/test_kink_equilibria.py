"""Rest at kinks in several coordinates: closed forms, and minima that SciPy descends to."""

from __future__ import annotations

from random import Random

import numpy as np
import pytest
from scipy.optimize import minimize
from tests.derivation.kinked_scenes import plane, potential, wall
from tests.derivation.model_scenes import model_steps

from deltaq.derivation.kink_equilibria import kink_search
from deltaq.derivation.system import System
from deltaq.mechanics.scene import Scene

Row = tuple[tuple[str, str], tuple[str, ...], str]
ORIGIN = ("0", "0")
WEIGHT = potential("m*g*y")
CASES = [
    *(
        pytest.param(plane(potential(energy), k=2.0, c=0.5), [(ORIGIN, shares, stability)], id=told)
        for energy, shares, stability, told in (
            ("k*abs(x) + k*y^2/2", ("0",), "stable", "a trough"),
            ("k*abs(x) - k*y^2/2", ("0",), "unstable", "down along it"),
            ("-k*abs(x) + k*y^2/2", ("0",), "unstable", "down on both sides"),
            ("k*abs(x) + y^4", ("0",), "undecided", "no curvature along it"),
            ("k*abs(x) + c*abs(y)", ("0", "0"), "stable", "a corner"),
            ("k*abs(x) - c*abs(y)", ("0", "0"), "unstable", "a saddle"),
        )
    ),
    pytest.param(
        plane(potential("k*abs(x - y) + c*(x - a)^2 + c*(y + a)^2"), k=2.0, c=1.5, a=0.3),
        [(ORIGIN, ("2*a*c/k",), "stable")],
        id="pulled apart across a trough",
    ),
    pytest.param(
        plane(potential("k*abs(x - y) + c*(x - a)^2 + c*(y + a)^2"), k=0.2, c=1.5, a=0.3), [], id="pulled out of it"
    ),
    pytest.param(
        plane(potential("k*abs(x^2 + y^2 - 4) + c*x"), k=2.0, c=1.5),
        [(("-2", "0"), ("c/(4*k)",), "stable"), (("2", "0"), ("-c/(4*k)",), "unstable")],
        id="a round trough that is inclined",
    ),
    pytest.param(
        plane(WEIGHT, potential("k*abs(x - a)"), events=[wall("y", "floor")], k=0.7, a=0.4),
        [(("a", "0"), ("0",), "stable")],
        id="a trough over a floor",
    ),
]  # fmt: skip


@pytest.mark.parametrize(("scene", "expected"), CASES)
def test_rest_where_forces_jump(scene: Scene, expected: list[Row]) -> None:
    system = System(scene)
    found = kink_search(system)
    assert found is not None
    told = [
        (tuple(str(each.equilibrium.values[system.q(q)]) for q in "xy"), tuple(map(str, each.shares)), each.stability)
        for each in found.kinks
    ]
    assert told == expected
    assert found.complete
    assert all(step.verified for step in model_steps(scene).values())


@pytest.mark.one_in(4)
@pytest.mark.parametrize("seed", range(12))
def test_the_one_minimum_of_a_convex_potential_is_found(seed: int) -> None:
    """A bowl with two creases: SciPy descends to its one minimum, which is on none, one or both of them."""
    source = Random(f"creases {seed}")
    a, b, p, q, u, v = (round(source.uniform(low, high), 2) for low, high in [(0.2, 2)] * 2 + [(-1, 1)] * 4)
    energy = f"(x - ({u}))^2 + (y - ({v}))^2 + {a}*abs(x - y + ({p})) + {b}*abs(x + 2*y - ({q}))"
    system = System(plane(potential(energy)))

    def value(z: np.ndarray) -> float:
        x, y = z
        return float((x - u) ** 2 + (y - v) ** 2 + a * abs(x - y + p) + b * abs(x + 2 * y - q))

    least = minimize(value, [0.0, 0.0], method="Nelder-Mead", options={"xatol": 1e-10, "fatol": 1e-13, "maxiter": 4000})
    known = kink_search(system)
    assert known is not None
    kinks = [[float(each.equilibrium.values[system.q(name)]) for name in "xy"] for each in known.kinks]
    on_creases = min(abs(least.x[0] - least.x[1] + p), abs(least.x[0] + 2 * least.x[1] - q)) < 1e-6
    assert len(kinks) == int(on_creases)
    if kinks:
        assert known.kinks[0].stability == "stable"
        np.testing.assert_allclose(kinks[0], least.x, atol=1e-5)
