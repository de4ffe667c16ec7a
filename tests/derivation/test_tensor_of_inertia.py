"""Rigid bodies whose axes are not principal ones, against SymPy's rigid bodies and against the same body in its own."""

from __future__ import annotations

import random
from typing import Any

import pytest
import sympy as sp
from sympy.physics.mechanics import LagrangesMethod, Point, ReferenceFrame, RigidBody, dynamicsymbols, inertia

from deltaq.derivation.engine import derive
from deltaq.derivation.result import result_of
from deltaq.derivation.system import System
from deltaq.errors import Problem
from deltaq.mechanics.document import examine, read_scene
from deltaq.mechanics.scene import Scene
from deltaq.mechanics.writing import write_scene
from deltaq.simulation.driver import simulate
from deltaq.simulation.library import get_method
from deltaq.simulation.service import problem_of

MOMENTS = {"A": 1.1, "B": 1.6, "C": 2.0, "D": 0.2, "E": -0.15, "F": 0.1}
FULL = [["A", "-D", "-E"], ["-D", "B", "-F"], ["-E", "-F", "C"]]
EULER = [  # of turns about z, x, z by psi, theta and phi, along the axes of the body
    "dot(psi)*sin(theta)*sin(phi) + dot(theta)*cos(phi)",
    "dot(psi)*sin(theta)*cos(phi) - dot(theta)*sin(phi)",
    "dot(psi)*cos(theta) + dot(phi)",
]


def body(tensor: Any, omega: list[str]) -> Scene:
    return read_scene(document(tensor, omega))


def document(tensor: Any, omega: list[str]) -> dict[str, Any]:
    """A body that turns about its centre of mass in a field which pulls on theta."""
    return {
        "id": "body",
        "dimension": 3,
        "coordinates": [
            {"name": name, "value": value, "rate": rate}
            for name, value, rate in (("psi", 0.0, 0.7), ("theta", 0.9, -0.4), ("phi", 0.3, 1.9))
        ],
        "parameters": [{"name": n, "value": v, "positive": v > 0} for n, v in (MOMENTS | {"m": 1.0, "k": 0.8}).items()],
        "bodies": [
            {
                "name": "body",
                "kind": "rigid",
                "mass": "m",
                "inertia": tensor,
                "angular_velocity": omega,
                "position": ["0", "0", "0"],
            }
        ],
        "loads": [{"kind": "potential", "energy": "k*cos(theta)"}],
    }


def test_equations_are_those_of_sympy() -> None:
    ours = list(result_of(System(body(FULL, EULER))).equations.values())
    theirs = of_sympy()
    names = sorted({s.name for e in (*ours, *theirs) for s in e.free_symbols})
    assert {"D", "E", "F"} <= set(names)
    draw = random.Random(3)
    for _ in range(3):
        point = {name: sp.Float(draw.uniform(0.3, 1.2), 30) for name in names}
        for our, their in zip(ours, theirs, strict=True):
            gap = value(our, point) - value(their, point)
            assert abs(gap) < 1e-20


def of_sympy() -> list[sp.Expr]:
    """By frames that are turned one after the other, and a dyadic of inertia; nothing of the scene is read."""
    t = dynamicsymbols._t
    psi, theta, phi = angles = dynamicsymbols("psi theta phi")
    A, B, C, D, E, F, m, k = sp.symbols("A B C D E F m k")
    space = ReferenceFrame("N")
    node = space.orientnew("K", "Axis", [psi, space.z])
    turned = node.orientnew("Q", "Axis", [theta, node.x])
    own = turned.orientnew("R", "Axis", [phi, turned.z])
    centre = Point("S")
    centre.set_vel(space, 0)
    solid = RigidBody("body", centre, own, m, (inertia(own, A, B, C, -D, -F, -E), centre))
    lagrangian = solid.kinetic_energy(space) - k * sp.cos(theta)
    equations = LagrangesMethod(lagrangian, list(angles)).form_lagranges_equations()
    names = {}
    for angle in angles:
        name = angle.func.__name__
        names |= {angle.diff(t, 2): sp.Symbol(f"ddot({name})"), angle.diff(t): sp.Symbol(f"dot({name})")}
        names |= {angle: sp.Symbol(name)}
    return [equation.doit().subs(names) for equation in equations]


def value(expression: sp.Expr, point: dict[str, sp.Float]) -> sp.Float:
    return sp.N(expression.xreplace({symbol: point[symbol.name] for symbol in expression.free_symbols}), 28)


def test_every_step_is_verified() -> None:
    _, derivation = derive(body(FULL, EULER))
    assert [step.id for step in derivation.steps() if not step.verified] == []


def test_a_body_moves_alike_in_any_axes() -> None:
    """Axes turned about the third one by 30°: another tensor and another ω, and the same motion."""
    principal = body(["A", "B", "C"], EULER)
    c, s = "sqrt(3)/2", "1/2"
    a, b = "(3*A + B)/4", "(A + 3*B)/4"
    mixed = "sqrt(3)/4*(B - A)"
    omega = [f"{c}*({EULER[0]}) + {s}*({EULER[1]})", f"{c}*({EULER[1]}) - {s}*({EULER[0]})", EULER[2]]
    turned = body([[a, mixed, "0"], [mixed, b, "0"], ["0", "0", "C"]], omega)
    motions = [
        simulate(problem_of(scene, 5.0, 11), get_method("dop853"), tolerance=1e-11) for scene in (principal, turned)
    ]
    assert [motion.outcome.status for motion in motions] == ["ok", "ok"]
    assert abs(motions[0].values - motions[1].values).max() < 1e-9
    assert abs(motions[0].values - motions[0].values[0]).max() > 1


INERTIA = "/bodies/0/inertia"


@pytest.mark.parametrize(
    ("tensor", "problem"),
    [
        pytest.param(
            [*FULL[:2], ["-E", "F", "C"]],
            Problem(
                "inertia-not-symmetric", f"{INERTIA}/2/1", parameters={"name": "body", "upper": "-F", "lower": "F"}
            ),
            id="not symmetric",
        ),
        pytest.param(
            [["A", "9*D", "0"], ["9*D", "B", "0"], ["0", "0", "C"]],
            Problem("inertia-indefinite", INERTIA, parameters={"name": "body"}),
            id="a product too large for its moments",
        ),
        pytest.param(
            [["A", "D", "0"], ["D", "B", "0"], ["0", "0", "-C"]],
            Problem("inertia-not-positive", INERTIA, parameters={"name": "body", "value": -2.0}),
            id="a negative moment",
        ),
        pytest.param(
            FULL[:2], Problem("wrong-dimension", INERTIA, parameters={"expected": 3, "found": 2}), id="two rows"
        ),
        pytest.param(
            [*FULL[:2], ["-E", "-F"]],
            Problem("wrong-dimension", f"{INERTIA}/2", parameters={"expected": 3, "found": 2}),
            id="a short row",
        ),
        pytest.param([*FULL[:2], "C"], Problem("not-a-list", f"{INERTIA}/2"), id="a row that is none"),
    ],
)
def test_what_is_no_tensor_of_inertia_is_told_at_its_place(tensor: Any, problem: Problem) -> None:
    errors = [one for one in examine(document(tensor, EULER))[1] if one.severity == "error"]
    assert errors == [problem]


# the moments of boxes are sums of squares of two edges; those of rods and plates are at the bound
@pytest.mark.parametrize(
    ("tensor", "is_told"),
    [
        pytest.param(FULL, False, id="a body without a plane of symmetry"),
        pytest.param(["1^2 + 2^2", "2^2 + 3^2", "3^2 + 1^2"], False, id="a box"),
        pytest.param(["1.1", "0.7", "1.8"], False, id="a plate"),
        pytest.param(["0.001", "0.3", "0.3"], False, id="a rod"),
        pytest.param(["1.1", "0.7", "1.81"], True, id="flatter than a plate"),
        pytest.param(["0.001", "3", "1"], True, id="unlike any rod"),
        # turned by 45° from 1, 5 and 2
        pytest.param([["3", "2", "0"], ["2", "3", "0"], ["0", "0", "2"]], True, id="axes of its own"),
        pytest.param([["3", "2", "0"], ["2", "3", "0"], ["0", "0", "4.1"]], False, id="a body with axes of its own"),
    ],
)
def test_moments_that_no_body_has_are_told_and_computed_with(tensor: Any, is_told: bool) -> None:
    scene, found = examine(document(tensor, EULER))
    warning = Problem("inertia-of-no-body", INERTIA, parameters={"name": "body"}, severity="warning")
    assert scene is not None
    assert [one for one in found if one.code != "unused-parameter"] == [warning] * is_told


def test_a_tensor_is_written_as_it_was_read() -> None:
    (written,) = write_scene(body(FULL, EULER))["bodies"]
    assert written["inertia"] == FULL
