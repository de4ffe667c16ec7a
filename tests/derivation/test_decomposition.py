"""Decomposition: potentials, dissipation functions, and closed loops that show there is no potential."""

from __future__ import annotations

from collections.abc import Mapping

import pytest
import sympy as sp
from tests.derivation.model_scenes import particle

from deltaq.derivation.dissipation import dissipation_function, dissipative_loads, remaining_loads
from deltaq.derivation.engine import derive
from deltaq.derivation.rules import closed_loop
from deltaq.derivation.step import Step
from deltaq.derivation.system import System
from deltaq.language.parser import parse
from deltaq.mechanics.library import load_scene
from deltaq.mechanics.scene import Scene


def pushed(*force: str) -> Scene:
    """A particle in the plane under a force P."""
    push: Mapping[str, object] = {"kind": "force", "name": "push", "at": "bob", "force": list(force)}
    return particle(["x", "y"], {"c": 0.2, "k": 3.0, "w": 2.0}, ["x", "y"], push)


def steps(scene: Scene) -> dict[str, Step]:
    _, derivation = derive(scene)
    found = {step.id: step for step in derivation.steps()}
    assert [name for name, step in found.items() if not step.verified] == []
    return found


DISSIPATION = [
    pytest.param(("-c*dot(x)", "-c*dot(y)"), "c*dot(x)^2/2 + c*dot(y)^2/2", id="linear drag"),
    pytest.param(("-c*(dot(x) - dot(y))", "c*(dot(x) - dot(y))"), "c*(dot(x) - dot(y))^2/2", id="damper between"),
    pytest.param(("-c*x^2*dot(x)", "0"), "c*dot(x)^2*x^2/2", id="with a position"),
    pytest.param(("c*dot(y)", "-c*dot(x)"), None, id="gyroscopic"),
    pytest.param(("-c*dot(x)*abs(dot(x))", "0"), None, id="quadratic drag"),
    pytest.param(("-c*dot(x) - k*x", "0"), None, id="mixed with a spring"),
    pytest.param(("k*y", "0"), None, id="no rates"),
]


@pytest.mark.parametrize(("force", "expected"), DISSIPATION)
def test_dissipation_function(force: tuple[str, str], expected: str | None) -> None:
    system = System(pushed(*force))
    function = dissipation_function(system, "push")
    if expected is None:
        assert function is None
        return
    assert function is not None
    assert system.is_zero(function - system.expression(parse(expected, system.scene.names).tree))


@pytest.mark.parametrize(
    ("force", "outcome"),
    [
        pytest.param(("-c*dot(x)", "0"), "dissipation", id="drag"),
        pytest.param(("k*y", "0"), "rest", id="shear"),
        pytest.param(("-k*x", "0"), "text", id="spring"),
    ],
)
def test_what_the_rest_is(force: tuple[str, str], outcome: str) -> None:
    assert steps(pushed(*force))["decomposition"].about["outcome"] == outcome


def test_drag_and_a_follower_force_are_told_apart() -> None:
    drag = {"kind": "force", "name": "drag", "at": "bob", "force": ["-c*dot(x)", "-c*dot(y)"]}
    shear = {"kind": "force", "name": "shear", "at": "bob", "force": ["k*y", "0"]}
    scene = particle(["x", "y"], {"c": 0.2, "k": 3.0}, ["x", "y"], drag, shear)
    system = System(scene)
    assert (dissipative_loads(system), remaining_loads(system)) == (("drag",), ("shear",))
    found = steps(scene)
    assert found["decomposition"].about == {"outcome": "dissipation-and-rest", "load": "shear"}
    assert {"rayleigh-function:drag", "closed-loop:shear"} <= found.keys()


def test_closed_loop_of_the_follower_force() -> None:
    system = System(load_scene("elastic-pendulum"))
    step = closed_loop.apply(system, "drive")
    assert step is not None
    force, length = system.q("F0"), system.q("l")
    assert step.relations[0].after.value == force * length  # type: ignore[union-attr]
    assert steps(load_scene("elastic-pendulum"))["closed-loop:drive"].relations[1].sign == "≠"


def test_no_loop_for_what_has_a_potential() -> None:
    assert not [name for name in steps(load_scene("base-pendulum")) if name.startswith("closed-loop")]
    assert closed_loop.apply(System(pushed("k*y", "k*x")), "push") is None


@pytest.mark.parametrize(
    ("force", "outcome"),
    [
        pytest.param(("k*sin(w*t)", "0"), "conservative-in-time", id="shaken"),
        pytest.param(("-k*x", "0"), "conservative", id="spring"),
        pytest.param(("k*y*sin(w*t)", "0"), "nonconservative", id="shaken shear"),
        pytest.param(("-c*dot(x)", "0"), "rates", id="drag"),
    ],
)
def test_time_may_stand_in_a_potential(force: tuple[str, str], outcome: str) -> None:
    assert steps(pushed(*force))["curl-test:push"].about["outcome"] == outcome


def test_a_potential_that_depends_on_time() -> None:
    system = System(pushed("k*sin(w*t)", "0"))
    assert system.load_potential("push") == -system.q("k") * system.q("x") * sp.sin(system.q("w") * system.t)


@pytest.mark.one_in(4)
@pytest.mark.parametrize(
    "force",
    [
        pytest.param("k*exp(x^2)", id="imaginary error function"),
        pytest.param("k*sqrt(2 + sin(x))", id="elliptic integral"),
        pytest.param("k*sin(x)/x", id="integral sine"),
    ],
)
def test_a_potential_without_closed_form_leaves_the_force_where_it_is(force: str) -> None:
    system = System(pushed(force, "0"))
    assert (system.has_potential("push"), system.is_conservative("push")) == (True, False)
    assert system.nonconservative_force("x") == system.load_force("push", "x")
    found = steps(pushed(force, "0"))
    assert found["curl-test:push"].about["outcome"] == "no-closed-form"
    assert "potential:push" not in found


@pytest.mark.parametrize(
    ("force", "potential"),
    [
        pytest.param(("-k*x/(x^2 + y^2)^(3/2)", "-k*y/(x^2 + y^2)^(3/2)"), "-k/sqrt(x^2 + y^2)", id="1/r^2"),
        pytest.param(("-k*x/(x^2 + y^2)", "-k*y/(x^2 + y^2)"), "k*log(x^2 + y^2)/2", id="1/r"),
    ],
)
def test_central_forces_that_are_infinite_at_the_origin(force: tuple[str, str], potential: str) -> None:
    system = System(pushed(*force))
    assert system.load_potential("push") == system.expression(parse(potential, system.scene.names).tree)


def test_dry_friction_and_kinks_are_derived() -> None:
    drag = {"kind": "force", "name": "drag", "at": "bob", "force": ["-c*sign(dot(x)) - k*x", "0"]}
    kink = {"kind": "potential", "name": "kink", "energy": "c*abs(x)"}
    for load in (drag, kink):
        _, derivation = derive(particle(["x"], {"c": 0.2, "k": 3.0}, ["x", "0"], load))
        assert [step.id for step in derivation.steps() if not step.verified] == []
