"""The norm, the mean and the running integral, on cases that can be done by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest

from deltaq.lab.ladder.distance import Accuracy, Yardstick
from deltaq.lab.ladder.mean import Mean
from deltaq.lab.ladder.quadrature import running_integral
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene
from deltaq.mechanics.mass import total_mass
from deltaq.mechanics.scene import Scene
from deltaq.simulation.service import problem_of


def rod(**more: object) -> Scene:
    """A rod of mass 3 and length 2 that slides and turns: J = m l²/12 = 1."""
    body = {"name": "rod", "kind": "rigid", "mass": "m", "inertia": "m*l^2/12", "angle": "phi", "position": ["x", "0"]}
    return read_scene(
        {
            "coordinates": [{"name": "x"}, {"name": "phi", "unit": "rad"}],
            "parameters": [{"name": "m", "value": 3.0, "unit": "kg"}, {"name": "l", "value": 2.0, "unit": "m"}],
            "bodies": [body],
            **more,
        }
    )


def yardstick(states: np.ndarray) -> Yardstick:
    scene = rod()
    times = np.linspace(0.0, 1.0, len(states))
    turns = (0.0, 1.0)
    return Yardstick(problem_of(scene, 1.0), total_mass(scene), times, states, 0.0, turns, Accuracy(1e-8, len(states)))


@pytest.mark.parametrize(
    ("x", "phi", "expected"),
    [
        pytest.param(0.5, 0.0, 0.5, id="a displacement, in metres"),
        pytest.param(0.0, math.pi / 2, math.sqrt(2.0) / math.sqrt(3.0), id="a turn: radius of gyration times chord"),
        pytest.param(0.0, 2.0 * math.pi, 0.0, id="a whole turn is none"),
        pytest.param(0.5, math.pi, math.sqrt(0.25 + 4.0 / 3.0), id="both"),
    ],
)
def test_distance(x: float, phi: float, expected: float) -> None:
    full = yardstick(np.zeros((1, 4)))
    assert full.errors({"x": np.array([x]), "phi": np.array([phi])}) == pytest.approx([expected], abs=1e-12)


def test_extent_is_how_far_a_motion_gets_from_its_start() -> None:
    states = np.zeros((3, 4))
    states[:, 0] = [1.0, 1.5, 0.2]
    assert yardstick(states).extent == pytest.approx(0.8)


def test_mass_of_all_kinds_of_bodies() -> None:
    assert total_mass(rod()) == pytest.approx(3.0)
    assert total_mass(load_scene("physical-pendulum")) == pytest.approx(1.0)
    assert total_mass(load_scene("double-pendulum")) == pytest.approx(2.0)


@pytest.mark.parametrize("degree", range(6))
def test_running_integral_is_exact_for_polynomials_of_degree_five(degree: int) -> None:
    times = np.linspace(0.0, 2.0, 9)
    found = running_integral(times**degree, float(times[1]))
    assert found == pytest.approx(times ** (degree + 1) / (degree + 1), rel=1e-12, abs=1e-13)


def test_running_integral_has_order_six() -> None:
    errors = []
    for count in (33, 65):
        times = np.linspace(0.0, 3.0, count)
        errors.append(np.abs(running_integral(np.exp(times), float(times[1])) - np.expm1(times)).max())
    assert math.log2(errors[0] / errors[1]) > 5.5


@pytest.mark.parametrize(
    ("guide", "expected"),
    [
        pytest.param("sin(5*t)", 0.0, id="over periods"),
        pytest.param("2 + cos(3*t) + sin(7*t)", 2.0, id="two frequencies"),
        pytest.param("1 + sin(t + t^2/50)", 1.0, id="no period"),
    ],
)
def test_means_over_time(guide: str, expected: float) -> None:
    scene = rod(guides=[{"coordinate": "x", "value": guide}])
    mean = Mean.of(scene, 1.0)
    values = problem_of(scene, 1.0)
    seen = values.model.observe(values.inputs(mean.times, np.zeros((len(mean.times), 2)))).values["x"]
    assert mean.weights.sum() == pytest.approx(1.0)
    assert mean.weights @ seen == pytest.approx(expected, abs=2e-3)


def test_what_does_not_depend_on_time_needs_one_moment() -> None:
    assert Mean.of(rod(), 1.0).times.size == 1
