"""The step of failure: what the stability function predicts is what a run shows."""

from __future__ import annotations

import math

import numpy as np
import pytest

from deltaq.errors import RequestError
from deltaq.lab.experiments.stability import run, stiffness_of
from deltaq.lab.failure import failure, growth_in_a_step
from deltaq.lab.region import region
from deltaq.lab.rest import at_rest
from deltaq.mechanics.library import load_scene
from deltaq.simulation.library import get_method, method_ids
from deltaq.simulation.service import problem_of
from deltaq.simulation.stiffness import eigenvalues

LINEAR = ("quarter-car", "two-mass-oscillator", "wilberforce")
IMPLICIT = ("implicit-midpoint", "newmark", "variational-midpoint", "gauss-4", "gauss-6", "radau-5")


@pytest.mark.parametrize("scene", LINEAR)
@pytest.mark.parametrize("method", method_ids())
def test_prediction_and_measurement_agree_on_linear_scenes(scene: str, method: str) -> None:
    problem = problem_of(load_scene(scene), 10.0)
    found = failure(problem, get_method(method), eigenvalues(problem, 0.0, problem.state[: 2 * problem.degrees]))
    if method in IMPLICIT:
        assert (found.predicted, found.measured, found.deviation) == (math.inf, math.inf, None)
    else:
        assert found.deviation == pytest.approx(0.0, abs=0.05)
        assert found.bound <= found.predicted


@pytest.mark.parametrize("scene", ["double-pendulum", "elastic-pendulum"])
@pytest.mark.parametrize("method", ["explicit-euler", "rk4", "stormer-verlet", "dop853"])
def test_they_agree_at_rest_on_nonlinear_scenes(scene: str, method: str) -> None:
    problem = at_rest(problem_of(load_scene(scene), 10.0), "/at")
    found = failure(problem, get_method(method), eigenvalues(problem, 0.0, problem.state[: 2 * problem.degrees]))
    assert found.deviation == pytest.approx(0.0, abs=0.05)


def test_a_scene_without_motion_never_fails() -> None:
    problem = problem_of(load_scene("pendulum"), 1.0)
    found = failure(problem, get_method("rk4"), np.zeros(2, dtype=complex))
    assert (found.predicted, found.measured, found.cause) == (math.inf, math.inf, "")


def test_growth_is_read_off_the_later_part() -> None:
    assert growth_in_a_step(1e-6 * 1.02 ** np.arange(400.0)) == pytest.approx(1.02, rel=1e-6)
    assert growth_in_a_step(np.full(400, 1e-6)) == 1.0


def test_the_region_of_eulers_method_is_the_circle_around_minus_one() -> None:
    (line,) = region(get_method("explicit-euler"))
    radii = np.hypot(np.array(line)[:, 0] + 1.0, np.array(line)[:, 1])
    assert radii == pytest.approx(1.0, abs=2e-3)


def test_the_region_of_rk4_ends_where_the_textbook_says() -> None:
    points = np.concatenate([np.array(line) for line in region(get_method("rk4"))])
    assert points[np.abs(points[:, 1]) < 0.05, 0].min() == pytest.approx(-2.785, abs=0.02)


@pytest.mark.parametrize(
    ("scene", "expected"),
    [
        pytest.param("elastic-pendulum", "k", id="a spring's"),
        pytest.param("quarter-car", "k1", id="by its unit"),
        pytest.param("pendulum", "", id="none"),
    ],
)
def test_the_stiffness_of_a_scene(scene: str, expected: str) -> None:
    assert stiffness_of(load_scene(scene)) == expected


def test_what_stiffness_costs_explicit_methods_and_not_implicit_ones() -> None:
    found = list(run({"scene": "quarter-car", "methods": ["rk4"]}))[-1].result
    series = found["series"]
    assert isinstance(series, list)
    spent = {(row["method"], row["factor"]): row["evaluations"] for row in series if row["status"] == "ok"}
    assert spent["dop853", 1.0] < 2 * spent["radau-5", 1.0]
    assert spent["dop853", 1e5] > 4 * spent["radau-5", 1e5]
    failed = {row["method"] for row in series if row["status"] != "ok"}
    for name in failed:
        assert [row["status"] for row in series if row["method"] == name].index("ok") == 0


def test_rest_is_where_no_force_is_left() -> None:
    """The elastic pendulum hangs still where the spring carries the weight, and the turning force the rod."""
    problem = problem_of(load_scene("elastic-pendulum"), 1.0)
    found = eigenvalues(at_rest(problem, "/at"), 0.0, at_rest(problem, "/at").state[:4])
    assert np.abs(found.real).max() < 1e-6
    hanging = at_rest(problem_of(load_scene("double-pendulum"), 1.0), "/at")
    assert hanging.values == pytest.approx((0.0, 0.0), abs=1e-9)


def test_a_scene_without_rest_says_so() -> None:
    with pytest.raises(RequestError) as caught:
        next(run({"scene": "atwood", "at": "rest"}))
    assert [(problem.code, problem.pointer) for problem in caught.value.problems] == [("lab-no-rest", "/at")]
