"""The step of failure: what the stability function predicts is what a run shows."""

from __future__ import annotations

import math

import numpy as np
import pytest

from deltaq.errors import RequestError
from deltaq.lab.experiments.stability import EXPERIMENT, stiffness_of
from deltaq.lab.failure import FLOW, LINEARIZATION, failure, growth_in_a_step
from deltaq.lab.neighbours import Neighbours
from deltaq.lab.region import region
from deltaq.lab.rest import at_rest
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene
from deltaq.simulation.library import get_method, method_ids
from deltaq.simulation.service import problem_of
from deltaq.simulation.stiffness import eigenvalues

LINEAR = ("quarter-car", "two-mass-oscillator", "wilberforce")
IMPLICIT = ("implicit-midpoint", "newmark", "variational-midpoint", "gauss-4", "gauss-6", "radau-5")


@pytest.mark.one_in(5)
@pytest.mark.parametrize("scene", LINEAR)
@pytest.mark.parametrize("method", method_ids())
def test_prediction_and_measurement_agree_on_linear_scenes(scene: str, method: str) -> None:
    problem = problem_of(load_scene(scene), 10.0)
    found = failure(Neighbours(problem), get_method(method))
    if method in IMPLICIT:
        assert (found.predicted, found.measured, found.deviation) == (math.inf, math.inf, None)
    else:
        assert found.deviation == pytest.approx(0.0, abs=0.05)
        assert found.bound <= found.predicted


@pytest.mark.parametrize("scene", ["double-pendulum", "elastic-pendulum"])
@pytest.mark.parametrize("method", ["explicit-euler", "rk4", "stormer-verlet", "dop853"])
def test_they_agree_at_rest_on_nonlinear_scenes(scene: str, method: str) -> None:
    problem = at_rest(problem_of(load_scene(scene), 10.0), "/at")
    found = failure(Neighbours(problem), get_method(method))
    assert found.measured == pytest.approx(found.predicted, rel=0.05)


def test_a_scene_whose_deviations_stay_as_they_are_never_fails() -> None:
    found = failure(Neighbours(problem_of(load_scene("atwood"), 1.0)), get_method("rk4"))
    assert (found.predicted, found.measured, found.cause) == (math.inf, math.inf, "")


# hω of a vibration at which |R(ihω)| = 1.01, from R as the textbooks have it (Hairer, Wanner, IV.2): Euler's 1 + z; of
# second order 1 + z + z²/2; rk4's to z⁴/24; Verlet's and symplectic Euler's r + 1/r = (hω)² − 2.
TEXTBOOK = {
    "explicit-euler": math.sqrt(1.01**2 - 1.0),
    "heun": (4.0 * (1.01**2 - 1.0)) ** 0.25,
    "rk4": 2.8324,
    "stormer-verlet": math.sqrt(2.0 + 1.01 + 1.0 / 1.01),
    "symplectic-euler": math.sqrt(2.0 + 1.01 + 1.0 / 1.01),
}


@pytest.mark.parametrize("method", TEXTBOOK)
def test_a_pendulum_at_rest_fails_where_the_textbook_says(method: str) -> None:
    problem = at_rest(problem_of(load_scene("pendulum"), 10.0), "/at")
    omega = math.sqrt(9.81 / dict(zip(problem.model.layout.parameters, problem.parameters, strict=True))["l"])
    found = failure(Neighbours(problem), get_method(method))
    assert found.predicted == pytest.approx(TEXTBOOK[method] / omega, rel=3e-3)
    assert found.measured == pytest.approx(TEXTBOOK[method] / omega, rel=1e-2)


def damped(c: float, turning: float) -> dict[str, object]:
    """Two masses on springs with dampers, on a table that turns: q̈ = −k q − c q̇ ± 2 Ω q̇ + Ω² q, in units of 1."""
    return {
        "format": 1,
        "id": "table",
        "title": {"de": "Tisch", "en": "Table"},
        "summary": {"de": "Tisch.", "en": "Table."},
        "dimension": 2,
        "coordinates": [{"name": "x", "value": 0.1}, {"name": "y", "value": 0.05}],
        "parameters": [{"name": "W", "value": turning}],
        "bodies": [
            {
                "name": "bead",
                "kind": "particle",
                "mass": "1",
                "position": ["x*cos(W*t) - y*sin(W*t)", "x*sin(W*t) + y*cos(W*t)"],
            }
        ],
        "loads": [
            {"kind": "potential", "energy": "(4*x^2 + 9*y^2)/2"},
            {"kind": "dissipation", "function": f"{c}*(dot(x)^2 + 2*dot(y)^2)/2"},
        ],
    }


@pytest.mark.one_in(7)
@pytest.mark.parametrize(("c", "turning"), [(0.1, 0.05), (8.0, 0.05), (0.2, 1.0), (9.0, 1.2)])
@pytest.mark.parametrize("method", ["explicit-euler", "symplectic-euler", "stormer-verlet", "rk4", "newmark"])
def test_prediction_holds_for_what_is_no_sum_of_vibrations(method: str, c: float, turning: float) -> None:
    """Overdamped, and on a turning table: there the growth of a step is no function of the eigenvalues alone."""
    found = failure(Neighbours(problem_of(read_scene(damped(c, turning)), 10.0)), get_method(method))
    assert found.basis == LINEARIZATION
    if found.deviation is None:
        assert found.predicted == found.measured == math.inf
    else:
        assert found.deviation == pytest.approx(0.0, abs=0.02)


FAR = [
    pytest.param("pendulum", {"phi": {"value": 2.8}}, id="close to where it turns over"),
    pytest.param("double-pendulum", {}, id="chaotic"),
    pytest.param("kapitza", {}, id="shaken"),
]


@pytest.mark.parametrize(("scene", "initial"), FAR)
def test_what_grows_by_itself_is_no_failure_of_the_method(scene: str, initial: dict[str, object]) -> None:
    """Where the linearization changes nothing is predicted; a step is measured, or a reason is given why not."""
    methods = ["symplectic-euler", "rk4"]
    result = list(EXPERIMENT.run({"scene": scene, "initial": initial, "methods": methods, "stiffness": ""}))[-1].result
    rows = result["methods"]
    assert isinstance(rows, list)
    assert float(str(result["varies"])) > 0.05
    for row in rows:
        assert row["basis"] == FLOW
        assert (row["bound"], row["predicted"], row["deviation"]) == (None, None, None)
        assert (row["measured"] is None) == bool(row["reason"])
        assert (row["limit"] or row["measured"]) > 2e-3  # not at once, as where growth itself is taken for failure


def test_a_symplectic_method_that_follows_a_large_swing_does_not_fail_before_it_loses_it() -> None:
    """The implicit midpoint rule's own tangent map on this orbit grows like t for all h < 0.63 (done apart, NumPy)."""
    found = failure(Neighbours(problem_of(load_scene("pendulum"), 10.0)), get_method("implicit-midpoint"))
    assert found.cause == "newton_failed" or found.measured is None or found.measured > 0.63


def test_the_step_of_failure_on_a_large_swing() -> None:
    """Verlet's own tangent map on the pendulum at 2.8 rad grows by 0.3 % a step for h = 0.24 s, and by 2.8 % for
    0.25 s (done apart, NumPy); truly deviations grow like t there.
    """
    large = {"scene": "pendulum", "initial": {"phi": {"value": 2.8}}, "methods": ["stormer-verlet"], "t_end": 5.0}
    rows = list(EXPERIMENT.run(large))[-1].result["methods"]
    assert isinstance(rows, list)
    assert 0.24 < rows[0]["measured"] < 0.26


@pytest.mark.parametrize("method", ["rk4", "implicit-midpoint"])
def test_at_an_unstable_rest_growth_is_not_the_methods(method: str) -> None:
    upright = {"scene": "pendulum", "initial": {"phi": {"value": 3.1}}, "at": "rest", "methods": [method]}
    rows = list(EXPERIMENT.run(upright))[-1].result["methods"]
    assert isinstance(rows, list)
    (row,) = rows
    assert row["measured"] is None
    assert row["reason"] == "motion-spreads"
    assert row["basis"] == LINEARIZATION


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
    found = list(EXPERIMENT.run({"scene": "quarter-car", "methods": ["rk4"]}))[-1].result
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


@pytest.mark.parametrize(("scene", "is_rest"), [("atwood", False), ("pendulum", True)])
def test_where_every_place_is_like_another_rest_is_not_missed(scene: str, *, is_rest: bool) -> None:
    """What falls with constant acceleration has no rest, and the same linearization wherever it is."""
    result = next(EXPERIMENT.run({"scene": scene, "at": "rest", "methods": ["rk4"]})).result
    assert (result["rest"], result["at"]) == (is_rest, "rest")


def test_a_scene_without_rest_says_so() -> None:
    with pytest.raises(RequestError) as caught:
        next(EXPERIMENT.run({"scene": "swinging-atwood", "at": "rest"}))
    assert [(problem.code, problem.pointer) for problem in caught.value.problems] == [("lab-no-rest", "/at")]
