"""Dry friction written as a sign: a body that it stops stays, as long as that is known, by every method."""

from __future__ import annotations

import math
from random import Random

import pytest
from tests.simulation.judging import ROUNDING
from tests.simulation.scenes import scene

from deltaq.mechanics.scene import Scene
from deltaq.simulation.driver import simulate
from deltaq.simulation.library import get_method, method_ids
from deltaq.simulation.service import problem_of

MU, G = 0.3, 9.81


def sliding(force: str, value: float, rate: float, **parameters: float) -> Scene:
    load = {"kind": "force", "at": "block", "force": [force, "0"]}
    everything = {"m": 1.0, "mu": MU, "g": G, **parameters}
    return scene({"x": (value, rate)}, everything, {"block": ("m", ["x", "0"])}, [load])


ACCURACY = pytest.mark.parametrize("accuracy", [{"tolerance": 1e-4}, {"step": 0.01}], ids=["tolerance", "step"])
NESTED = "sign(dot(x)*sign(1 + x^2))"  # a sign of what jumps itself: on s = 0 there is no one value between two sides


@ACCURACY
@pytest.mark.parametrize("method", method_ids())
def test_a_sliding_block_stops_and_stays(method: str, accuracy: dict[str, float]) -> None:
    """v²/(2 μ g) from where it was pushed, after v/(μ g)."""
    found = simulate(problem_of(sliding("-mu*m*g*sign(dot(x))", 0.0, 2.0), 0.7), get_method(method), **accuracy)
    assert found.outcome.status == "ok"
    (stop,) = found.transitions
    assert stop.time == pytest.approx(2.0 / (MU * G), abs=0.011 if "step" in accuracy else 2e-3)
    assert found.values[-1, 0] == pytest.approx(4.0 / (2.0 * MU * G), abs=0.03)
    assert found.cost.steps < 100_000


@ACCURACY
@pytest.mark.parametrize("method", method_ids())
def test_a_block_that_nothing_is_known_to_hold_is_found_to_have_stopped(
    method: str, accuracy: dict[str, float]
) -> None:
    found = simulate(problem_of(sliding(f"-mu*m*g*{NESTED}", 0.0, 2.0), 10.0), get_method(method), **accuracy)
    assert found.outcome.status == "stopped"
    assert dict(found.outcome.parameters)["name"] == "x"
    assert found.reached == pytest.approx(2.0 / (MU * G), abs=0.011 if "step" in accuracy else 2e-3)
    assert found.values[-1, 0] == pytest.approx(4.0 / (2.0 * MU * G), abs=0.03)
    assert found.cost.steps < 100_000


def test_whatever_step_is_given_the_rest_is_told_with_its_error() -> None:
    """Half swings lose 2F each, whatever the step."""
    source = Random(8)
    for _ in range(60):
        friction, method = source.uniform(0.1, 0.9), source.choice(["rk4", "heun", "dop853", "explicit-euler"])
        problem = problem_of(sliding("-x - F*sign(dot(x))", 2.0, 0.0, F=friction), 40.0, source.choice([21, 501]))
        found = simulate(problem, get_method(method), step=10.0 ** source.uniform(-3.0, -1.0))
        rest, sign = 2.0, 1.0
        while rest > friction:
            rest, sign = abs(rest - 2.0 * friction), math.copysign(1.0, 2.0 * friction - rest) * sign
        assert found.outcome.status == ("ok" if found.trusted_until == 40.0 else "horizon_reached")
        assert len(found.times) == len(found.values) == len(found.estimate.errors)
        assert abs(abs(found.values[-1, 0]) - rest) <= found.estimate.errors[-1] + ROUNDING, (friction, method)


def test_what_is_held_from_the_start_stays() -> None:
    problem = problem_of(sliding("P - mu*m*g*sign(dot(x))", 0.0, 0.0, P=1.0), 5.0)
    found = simulate(problem, get_method("dop853"), tolerance=1e-6)
    assert (found.outcome.status, found.reached) == ("ok", 5.0)
    assert not found.values.any()
    problem = problem_of(sliding(f"P - mu*m*g*{NESTED}", 0.0, 0.0, P=1.0), 5.0)
    found = simulate(problem, get_method("dop853"), tolerance=1e-6)
    assert (found.outcome.status, found.reached) == ("stopped", 0.0)


@pytest.mark.parametrize(
    "force",
    [
        pytest.param("-x - 0.2*dot(x)*abs(dot(x))", id="drag bends and does not jump"),
        pytest.param("-x - 0.5*dot(x)", id="damping does not jump"),
        pytest.param("-P*sign(x)", id="a force that jumps with the place holds nothing"),
        pytest.param("P - mu*m*g*sign(dot(x))", id="a pull above friction"),
    ],
)
def test_nothing_else_is_taken_for_friction_that_holds(force: str) -> None:
    problem = problem_of(sliding(force, 1.0, 0.0, P=8.0), 8.0)
    found = simulate(problem, get_method("dormand-prince-54"), tolerance=1e-6)
    assert found.outcome.status == "ok"
