"""What jumps with a coordinate, and positions and constraints that bend, are refused where they stand."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from itertools import combinations
from typing import Any

import pytest

from deltaq.errors import Problem
from deltaq.language.floats import evaluate
from deltaq.language.tree import Node
from deltaq.mechanics import continuity
from deltaq.mechanics.document import examine


def scene(**changes: object) -> dict[str, object]:
    """A particle in the plane, with changes."""
    base: dict[str, object] = {
        "coordinates": [{"name": "x", "value": -0.7}, {"name": "y", "value": 0.2}],
        "parameters": [{"name": "m"}, {"name": "k", "value": 2.0}],
        "bodies": [{"name": "bob", "kind": "particle", "mass": "m", "position": ["x", "y"]}],
    }
    return base | changes


def potential(energy: str, kind: str = "potential") -> dict[str, object]:
    return scene(loads=[{"kind": kind, "energy": energy}])


def errors(document: dict[str, object]) -> list[Problem]:
    return [problem for problem in examine(document)[1] if problem.severity == "error"]


# A potential, and the function that makes it jump.
JUMPING = [
    ("k*step(x)", "step(x)"),
    ("k*sign(x)", "sign(x)"),
    ("k*(x + 1)*step(x)", "step(x)"),
    ("k*sign(x - 5) + k*x^2", "sign(x - 5)"),
    ("k*step(x - 300)", "step(x - 300)"),
    ("k*step(x - 1/1000)", "step(x - 1/1000)"),
    ("k*sign(x^3)", "sign(x^3)"),
    ("k*cos(x)*step(x + y)", "step(x + y)"),
    ("k*y*step(x)", "step(x)"),  # zero in one point of the line x = 0 alone
    ("k*x*step(x*y)", "step(x*y)"),  # zero on one of two lines
    ("k*step(x^2 + y^2 - 1)", "step(x^2 + y^2 - 1)"),
    ("k*step(sin(x))", "step(sin(x))"),  # stairs
    ("k*step(x - t)", "step(x - t)"),
    ("k*step(step(x) - 1/2)", "step(step(x) - 1/2)"),
    ("k*sign(max(x, 0))", "sign(max(x, 0))"),  # which never is negative
    ("k*x/abs(x)", "abs(x)"),
    ("k*y*(x - y)/abs(x - y)", "abs(x - y)"),
    ("10^6*x^2 + k*step(x)", "step(x)"),
    ("k*x + step(x)/10^6", "step(x)"),
    ("k*step(x - 50)*step(50.01 - x)", "step(x - 50)"),
]
CONTINUOUS = [
    "k*x^2*step(x)",
    "k*x*step(x)",
    "k*x*sign(x)",
    "k*max(x, 0)^2",
    "k*max(x, y, 1)",
    "k*abs(x)",
    "k*sqrt(abs(x))",
    "k*abs(x)^(1/10)",
    "k*(1 - cos(x))*step(x)",
    "k*(exp(x) - 1)*step(x)",
    "k*sin(x)*sign(sin(x))",
    "k*sin(y)*x*sign(x)",
    "k*(x + 1)*step(x) - k*step(x)",
    "k*x^2/2*(1 - step(x - 3)) + (3*k*x - 4.5*k)*step(x - 3)",  # a line goes on where a parabola ends
    "2*step(x) + k*(x - 1)*step(x)",  # with k = 2
    "(x + 10^6)^2*step(x) - 10^12*step(x)",
    "k*x*(x - y)*step(x - y)",
    "k*abs(x)*y*step(x*y)",
    "k*max(0, min(1, 10^6*x))",  # a steep ramp
    "k*tanh(10^6*x) + abs(x)",
    "k*step(x^2 + 1)",
    "k*x*step(t - 1)",  # a force that is switched on
    "k/abs(x)",
    "k*log(abs(x))",
    "k*sign(x)/sqrt(abs(x))",
]


# Where it starts: beside the places where these switch, or at them.
STARTS = [(-0.7, 0.2), (0.0, 0.0), (1.0, 1.0), (5.0, -5.0), (1e-9, 0.0), (300.0, 0.0)]


def starting(document: dict[str, object], start: tuple[float, float]) -> dict[str, object]:
    return document | {"coordinates": [{"name": n, "value": value} for n, value in zip("xy", start, strict=True)]}


@pytest.mark.parametrize("start", STARTS)
@pytest.mark.parametrize(("energy", "call"), JUMPING)
def test_a_potential_that_jumps_is_refused(energy: str, call: str, start: tuple[float, float]) -> None:
    told = Problem("potential-jumps", "/loads/0/energy", energy.index(call), len(call), {"call": call})
    assert errors(starting(potential(energy), start)) == [told]


@pytest.mark.parametrize("start", STARTS)
@pytest.mark.parametrize("energy", CONTINUOUS)
def test_a_continuous_potential_is_not(energy: str, start: tuple[float, float]) -> None:
    assert errors(starting(potential(energy), start)) == []


@pytest.mark.parametrize(
    ("energy", "jumps"),
    [
        ("k*y*dot(x) + k*step(x)", True),
        ("k*step(x)*dot(y)", True),
        ("k*x*step(x)*dot(y)", False),
        ("k*y*dot(x) + k*x^2*step(x)", False),
    ],
)
def test_nor_may_generalized_potentials(energy: str, jumps: bool) -> None:
    found = [problem.code for problem in errors(potential(energy, "generalized-potential"))]
    assert found == ["potential-jumps"] * jumps


SPRING = {"kind": "spring", "from": "wall", "to": "bob"}
WALL = [{"name": "wall", "position": ["-3", "0"]}]
ELSEWHERE: list[Any] = [
    pytest.param(
        {"bodies": [{"kind": "particle", "mass": "m", "position": ["x", "k*step(x)"]}]}, ["/bodies/0/position/1"]
    ),
    pytest.param({"bodies": [{"kind": "particle", "mass": "m", "position": ["x", "k*x^2*step(x) + y"]}]}, []),
    pytest.param({"points": [{"name": "p", "position": ["sign(y)", "0"]}]}, ["/points/0/position/0"]),
    pytest.param({"points": WALL, "loads": [SPRING | {"stiffness": "k*step(x)"}]}, ["/loads/0/stiffness"]),
    pytest.param(
        {"points": WALL, "loads": [SPRING | {"stiffness": "k", "rest_length": "sign(x)"}]}, ["/loads/0/rest_length"]
    ),
    pytest.param({"points": WALL, "loads": [SPRING | {"stiffness": "k", "rest_length": "abs(x)"}]}, []),
    pytest.param({"points": WALL, "loads": [SPRING | {"stiffness": "k*step(t - 1)"}]}, []),
    pytest.param({"loads": [{"kind": "moment", "angle": "k*sign(x)", "moment": "1"}]}, ["/loads/0/angle"]),
    pytest.param({"loads": [{"kind": "moment", "angle": "x", "moment": "-k*sign(x)"}]}, []),
    pytest.param({"loads": [{"kind": "force", "at": "bob", "force": ["-k*sign(x)", "step(y)"]}]}, []),
]


@pytest.mark.parametrize(("changes", "pointers"), ELSEWHERE, ids=lambda each: str(each)[:100])
def test_energies_of_springs_positions_and_angles_do_not_jump_either_while_forces_may(
    changes: dict[str, object], pointers: list[str]
) -> None:
    if "bodies" in changes:
        changes = changes | {"bodies": [{"name": "bob", **body} for body in changes["bodies"]]}  # type: ignore[attr-defined]
    assert [problem.pointer for problem in errors(scene(**changes)) if problem.code.endswith("-jumps")] == pointers


# The second component of a body's position, and the function with which it bends.
BENT = [
    ("k*max(x, 0)/4", "max(x, 0)"),
    ("abs(x)", "abs(x)"),
    ("k*abs(sin(x))", "abs(sin(x))"),
    ("y + min(x, t)", "min(x, t)"),
    ("max(t - 1, 0)", "max(t - 1, 0)"),
    ("max(t - 200, 0)", "max(t - 200, 0)"),
    ("x*sign(x) + y", "sign(x)"),
    ("k*(x - 3)*step(x - 3)", "step(x - 3)"),
    ("sqrt(x^2)", "sqrt(x^2)"),
    ("(x^2)^(1/2)", "(x^2)^(1/2)"),
    ("(x^4)^0.25", "(x^4)^0.25"),
    ("sqrt((t - 1)^2)", "sqrt((t - 1)^2)"),
    ("sqrt(x^2 - 2*x + 1)", "sqrt(x^2 - 2*x + 1)"),
    ("sqrt(1 - cos(x))", "sqrt(1 - cos(x))"),
    ("sqrt(1 - sin(x)^2)", "sqrt(1 - sin(x)^2)"),
    ("acos(cos(x))", "acos(cos(x))"),
    ("asin(sin(x + t))", "asin(sin(x + t))"),
]
SMOOTH_ENOUGH = [
    "y + max(x, 0)^2",
    "k*x*abs(x)",
    "k*x^2*step(x)",
    "max(t, 0)",  # a motion begins with t = 0
    "max(t - 1, 0)^2",
    "abs(x)^1.5",
    "abs(2 + sin(x))",
    "abs(k)*x",
    "sqrt(x^2 + y^2)",  # bends in one point alone
    "sqrt(x^2 + k/10^6)",
    "(x + sqrt(x^2 + 1/10^8))/2",
    "sqrt((2 + sin(x))^2)",
    "sqrt((x^2 + k)^2)",
    "(x^2)^(3/2)",
    "sqrt(k - x^2)",
    "acos(x/10)",
    "tanh(10^4*x)",
]


def standing(component: str) -> dict[str, object]:
    bodies = {"bob": ["x", component], "other": ["y", "0"]}
    return scene(
        bodies=[{"name": n, "kind": "particle", "mass": "m", "position": position} for n, position in bodies.items()]
    )


@pytest.mark.parametrize("start", STARTS)
@pytest.mark.parametrize(("component", "call"), BENT)
def test_a_position_that_bends_is_refused(component: str, call: str, start: tuple[float, float]) -> None:
    told = Problem("position-bends", "/bodies/0/position/1", component.index(call), len(call), {"call": call})
    assert errors(starting(standing(component), start)) == [told]


@pytest.mark.parametrize("start", STARTS)
@pytest.mark.parametrize("component", SMOOTH_ENOUGH)
def test_a_position_whose_slopes_are_continuous_is_not(component: str, start: tuple[float, float]) -> None:
    found = [problem.code for problem in errors(starting(standing(component), start))]
    assert not {"position-bends", "position-jumps"} & set(found)


def test_a_body_does_not_jump_in_time_either_nor_with_a_guide() -> None:
    (found,) = errors(standing("x + step(t - 1)"))
    assert (found.code, found.pointer) == ("position-jumps", "/bodies/0/position/1")
    (found,) = errors(standing("abs(y)") | {"guides": [{"coordinate": "y", "value": "t - 1"}]})
    assert (found.code, found.pointer) == ("position-bends", "/bodies/0/position/1")


def test_a_point_without_mass_may_bend() -> None:
    stop = {"points": [{"name": "wall", "position": ["max(x, 3)", "0"]}], "loads": [SPRING | {"stiffness": "k"}]}
    assert errors(scene(**stop)) == []


def test_a_bend_may_run_along_a_continuum() -> None:
    rope = {"name": "bob", "kind": "continuum", "density": "m", "position": ["min(x, s)", "y"]}
    caught = scene(bodies=[rope | {"material": [{"name": "s", "from": "-2", "to": "2"}]}])
    assert errors(caught) == []


# An equation, and the root in it that bends.
BENT_CONDITIONS = [
    ("sqrt(x^2) + y - k = 0", "sqrt(x^2)"),
    ("y - sqrt(x^2) + k = 0", "sqrt(x^2)"),
    ("sqrt((x - 0.05)^2) + y = k", "sqrt((x - 0.05)^2)"),
    ("x^2 + y^2 = (k + sqrt((t - 0.5)^2)/10)^2", "sqrt((t - 0.5)^2)"),
    ("(x^2)^(1/2) + y = k", "(x^2)^(1/2)"),
    ("sqrt(x^2 - 2*x + 1) + y = k", "sqrt(x^2 - 2*x + 1)"),
    ("acos(cos(x)) + y = k", "acos(cos(x))"),
    ("sqrt((x - y)^2) = k", "sqrt((x - y)^2)"),
    ("x/sqrt(x^2) = y", "sqrt(x^2)"),
]


@pytest.mark.parametrize("start", STARTS)
@pytest.mark.parametrize(("equation", "call"), BENT_CONDITIONS)
def test_a_constraint_that_bends_is_refused(equation: str, call: str, start: tuple[float, float]) -> None:
    track = {"name": "track", "kind": "equation", "equation": equation}
    told = Problem("constraint-not-smooth", "/constraints/0/equation", equation.index(call), len(call))
    (found,) = errors(starting(scene(constraints=[track]), start))
    assert found == replace(told, parameters={"function": call})


@pytest.mark.parametrize(
    "equation", ["sqrt(x^2 + y^2) = k", "sqrt((x^2 + y^2)^2) = k", "sqrt(k^2 - x^2) = y", "sqrt(4 + x^2) + y = 3"]
)
def test_one_whose_roots_do_not_is_not(equation: str) -> None:
    track = {"name": "track", "kind": "equation", "equation": equation}
    assert "constraint-not-smooth" not in [problem.code for problem in errors(scene(constraints=[track]))]


def test_a_length_and_the_end_of_a_rod_do_not_bend() -> None:
    rod = {"name": "rod", "kind": "distance", "from": "p", "to": "bob", "length": "k"}
    held = scene(points=[{"name": "p", "position": ["0", "0"]}], constraints=[rod])
    assert errors(held) == []
    (found,) = errors(held | {"constraints": [rod | {"length": "k + sqrt((t - 1)^2)"}]})
    assert (found.code, found.pointer) == ("constraint-not-smooth", "/constraints/0/length")
    (found,) = errors(held | {"points": [{"name": "p", "position": ["0", "max(t - 1, 0)"]}]})
    assert (found.code, found.pointer) == ("constraint-not-smooth", "/points/0/position/1")


def test_a_coordinate_that_is_guided_may_pass_a_jump() -> None:
    """What acts on it is known from its guide; the others feel nothing of the jump."""
    guided = potential("k*y^2 + k*step(x)") | {"guides": [{"coordinate": "x", "value": "t"}]}
    assert errors(guided) == []


def test_the_work_is_bounded_and_every_bend_is_looked_at_in_turn(monkeypatch: pytest.MonkeyPatch) -> None:
    """Walls between ten bodies make a potential of 45 bends; one that jumps among 12 of them is still found."""
    calls = 0

    def counted(tree: Node, point: Mapping[str, float]) -> float:
        nonlocal calls
        calls += 1
        return evaluate(tree, point)

    monkeypatch.setattr(continuity, "evaluate", counted)
    names = [f"x{i}" for i in range(10)]
    walls = [f"max({a} - {b}, 0)^2" for a, b in combinations(names, 2)]
    bodies = [{"name": f"b{n}", "kind": "particle", "mass": "m", "position": [n, "0"]} for n in names]
    chain = potential(" + ".join(walls)) | {"coordinates": [{"name": n} for n in names], "bodies": bodies}
    assert errors(chain) == []
    assert 0 < calls < 60_000
    chain["loads"] = [{"kind": "potential", "energy": " + ".join([*walls[:12], "step(x3)"])}]
    assert [problem.code for problem in errors(chain)] == ["potential-jumps"]
