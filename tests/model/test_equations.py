"""M and f against SymPy's LagrangesMethod, energies and powers against each other."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sp
from tests.model.lagranges_method import lagranges_method
from tests.simulation.scenes import all_scenes, get_scene, oscillator

from deltaq.model.equations import equations
from deltaq.model.model import compile_model

POINTS = 5


def random_inputs(count: int, width: int) -> np.ndarray:
    return np.random.default_rng(7).uniform(0.3, 1.4, (count, width))


@pytest.mark.one_in(14)
@pytest.mark.parametrize("name", all_scenes())
def test_mass_matrix_and_forcing_are_those_of_lagranges_method(name: str) -> None:
    scene = get_scene(name)
    model, n = compile_model(scene), len(scene.free)
    symbols, mass, forcing = lagranges_method(scene)
    expected = sp.lambdify(symbols, [mass.tolist(), list(forcing)], "math", cse=True)
    inputs = random_inputs(POINTS, 2 * n + 1 + len(scene.parameters))
    system = model.system(inputs)
    for row, found_mass, found in zip(inputs, system.mass, system.forces, strict=True):
        wanted_mass, wanted_forcing = expected(*row)
        np.testing.assert_allclose(found_mass, np.array(wanted_mass), rtol=1e-12, atol=1e-12)
        np.testing.assert_allclose(found, np.array(wanted_forcing), rtol=1e-11, atol=1e-11)


@pytest.mark.parametrize("name", all_scenes())
def test_power_is_what_energy_gains(name: str) -> None:
    """d(E + V)/dt along the motion, by differences of order 4, equals the power P₀ + p₁·q̈."""
    scene = get_scene(name)
    model, n = compile_model(scene), len(scene.free)
    row = random_inputs(1, 2 * n + 1 + len(scene.parameters))[0]

    def accelerations(at: np.ndarray) -> np.ndarray:
        system = model.system(at[None])
        return np.linalg.solve(system.mass[0], system.forces[0])

    def energy(dt: float) -> float:
        """E + V a time dt later: q, q̇ by Taylor series whose third derivative does not matter at dt² accuracy."""
        at, a = row.copy(), accelerations(row)
        at[:n] += row[n : 2 * n] * dt + a * dt**2 / 2
        at[n : 2 * n] += a * dt
        at[2 * n] += dt
        seen = model.observe(at[None])
        return float(seen.kinetic[0] + seen.potential[0])

    h = 2e-4
    slope = (8 * (energy(h) - energy(-h)) - (energy(2 * h) - energy(-2 * h))) / (12 * h)
    power = 0.0
    if model.layout.is_powered:
        last = model.motion.table(row[None])[0, n * (n + 1) // 2 + n :]
        power = last[0] + last[1:] @ accelerations(row)
    assert slope == pytest.approx(power, abs=1e-8)


@pytest.mark.parametrize(
    ("name", "is_powered"),
    [
        pytest.param("pendulum", False, id="weight has a potential"),
        pytest.param("base-pendulum", False, id="weight and spring have potentials"),
        pytest.param("elastic-pendulum", True, id="a follower force has none"),
        pytest.param("guided-pendulum", True, id="the guide does work"),
        pytest.param("spherical-pendulum", False, id="in space"),
    ],
)
def test_which_scenes_are_fed_power(name: str, is_powered: bool) -> None:
    assert equations(get_scene(name)).is_powered is is_powered


def test_uniform_force_is_a_potential() -> None:
    eqs = equations(oscillator("F0"))
    force, x = eqs.symbols.values["F0"], eqs.symbols.values["x"]
    assert eqs.potential == -force * x


def test_guided_weight_has_its_own_arrow_and_guide_its_motion() -> None:
    scene = get_scene("guided-pendulum")
    model = compile_model(scene)
    row = np.array([[0.3, 0.0, 2.0, *(p.value for p in scene.parameters)]])
    seen = model.observe(row)
    y0, omega = 0.15, 5.0
    assert seen.values["y"][0] == pytest.approx(y0 * np.sin(omega * 2.0))
    assert seen.rates["y"][0] == pytest.approx(y0 * omega * np.cos(omega * 2.0))
    assert seen.positions["bob"][0] == pytest.approx([np.sin(0.3), y0 * np.sin(10.0) + np.cos(0.3)])
    assert seen.arrows["weight"][0] == pytest.approx([0.0, 9.81])


def test_weights_of_several_bodies_are_told_apart_by_place() -> None:
    assert compile_model(get_scene("wild-double-pendulum")).layout.arrows == ("gravity:upper", "gravity:lower")
