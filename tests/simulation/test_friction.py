"""Dry friction: a body that it stops is found to have stopped, in bounded time, by every method."""

from __future__ import annotations

import math
from random import Random

import pytest
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


@pytest.mark.parametrize("accuracy", [{"tolerance": 1e-4}, {"step": 0.01}], ids=["tolerance", "step"])
@pytest.mark.parametrize("method", method_ids())
def test_a_sliding_block_stops(method: str, accuracy: dict[str, float]) -> None:
    """v²/(2 μ g) from where it was pushed, after v/(μ g)."""
    found = simulate(problem_of(sliding("-mu*m*g*sign(dot(x))", 0.0, 2.0), 10.0), get_method(method), **accuracy)
    assert found.outcome.status == "stopped"
    assert dict(found.outcome.parameters)["name"] == "x"
    assert found.reached == pytest.approx(2.0 / (MU * G), abs=0.011 if "step" in accuracy else 2e-3)
    assert found.values[-1, 0] == pytest.approx(4.0 / (2.0 * MU * G), abs=0.03)
    assert found.cost.steps < 100_000


@pytest.mark.parametrize("method", ["dop853", "rk4", "heun", "dormand-prince-54", "radau-5"])
def test_a_block_on_a_spring_turns_until_friction_holds_it(method: str) -> None:
    """Each half swing of x″ = −x ∓ F loses 2F: from 2 with F = 0.3 over −1.4 and 0.8 to −0.2, where |x| < F."""
    problem = problem_of(sliding("-x - F*sign(dot(x))", 2.0, 0.0, F=0.3), 30.0)
    found = simulate(problem, get_method(method), tolerance=1e-5)
    assert found.outcome.status == "stopped"
    assert found.reached == pytest.approx(3.0 * math.pi, abs=1e-3)
    assert found.values[-1, 0] == pytest.approx(-0.2, abs=2e-3)


def test_whatever_step_is_given_the_stop_is_told_with_its_error() -> None:
    """Runs that are compared may be held one after the other; half swings lose 2F each, whatever the step."""
    source = Random(8)
    for _ in range(60):
        friction, method = source.uniform(0.1, 0.9), source.choice(["rk4", "heun", "dop853", "explicit-euler"])
        problem = problem_of(sliding("-x - F*sign(dot(x))", 2.0, 0.0, F=friction), 40.0, source.choice([21, 501]))
        found = simulate(problem, get_method(method), step=10.0 ** source.uniform(-3.0, -1.0))
        rest, sign = 2.0, 1.0
        while rest > friction:
            rest, sign = abs(rest - 2.0 * friction), math.copysign(1.0, 2.0 * friction - rest) * sign
        assert found.outcome.status == "stopped"
        assert len(found.times) == len(found.values) == len(found.estimate.errors)
        assert abs(abs(found.values[-1, 0]) - rest) <= found.estimate.errors[-1], (friction, method)


def test_what_is_held_from_the_start_is_told_at_once() -> None:
    problem = problem_of(sliding("P - mu*m*g*sign(dot(x))", 0.0, 0.0, P=1.0), 5.0)
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
