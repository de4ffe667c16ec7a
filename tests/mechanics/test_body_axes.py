"""Angular velocities along axes fixed in the body, and along others; truth is the addition of three turns, by SymPy."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import product
from typing import Any

import pytest
import sympy as sp

from deltaq.mechanics.document import examine
from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.mechanics.soundness import soundness_problems

ANGLES = sp.symbols("psi theta phi")
NAMES = tuple(map(str, ANGLES))
RATES = sp.symbols("psi_rate theta_rate phi_rate")
OFF, NONE = "angular-velocity-beside-body", "angular-velocity-of-none"
BOX, ROD, BALL = ("1.0", "1.3", "1.7"), ("1.2", "1.2", "0.4"), ("0.4", "0.4", "0.4")


def turned(axis: int, angle: Any) -> Any:
    return [sp.rot_axis1, sp.rot_axis2, sp.rot_axis3][axis](-angle)


def components(axes: Sequence[int], frame: str) -> list[str]:
    """Those of three turns one after the other: along axes of the body, of space, or those that do not spin with it."""
    first, second, third = (turned(axis, angle) for axis, angle in zip(axes, ANGLES, strict=True))
    one, two, three = (sp.eye(3).col(axis) * rate for axis, rate in zip(axes, RATES, strict=True))
    omega = {
        "body": third.T * (second.T * one + two) + three,
        "space": one + first * (two + second * three),
        "unspun": second.T * one + two + three,
    }[frame]
    written = [str(sp.expand(x)).replace("**", "^") for x in omega]
    for q in ANGLES:
        written = [text.replace(f"{q}_rate", f"dot({q})") for text in written]
    return written


def told(omega: Sequence[str], moments: Sequence[Any], names: Sequence[str] = NAMES) -> list[tuple[str, str]]:
    document = {
        "dimension": 3,
        "coordinates": [{"name": name, "value": 0.4} for name in names],
        "bodies": [
            {
                "name": "body",
                "kind": "rigid",
                "mass": "1",
                "position": ["0", "0", "0"],
                "inertia": list(moments),
                "angular_velocity": list(omega),
            }
        ],
    }
    _, problems = examine(document)
    return [(each.code, each.pointer) for each in problems if each.code in {OFF, NONE}]


PLACE = "/bodies/0/angular_velocity"
ORDERS = [order for order in product(range(3), repeat=3) if order[0] != order[1] != order[2]]


@pytest.mark.parametrize("order", ORDERS)
def test_every_sequence_of_turns_has_an_angular_velocity(order: tuple[int, ...]) -> None:
    assert told(components(order, "body"), BOX) == []


@pytest.mark.parametrize("radius", ["1e-6", "1e-5", "1e-3", "1", "1e3", "1e6"])
@pytest.mark.parametrize(("frame", "expected"), [("body", []), ("space", [(NONE, "/bodies/0/angular_velocity")])])
def test_an_angle_may_be_an_arc_on_a_small_or_large_circle(
    radius: str, frame: str, expected: list[tuple[str, str]]
) -> None:
    omega = [
        re.sub(r"\btheta\b", f"(s/{radius})", each.replace("dot(theta)", "dot(s)/" + radius))
        for each in components((2, 0, 2), frame)
    ]
    assert told(omega, BOX, ("psi", "s", "phi")) == expected


@pytest.mark.parametrize("moments", [BOX, ROD, BALL])
@pytest.mark.parametrize("frame", ["space", "unspun"])
def test_other_axes_are_told_and_are_an_error_where_the_energy_is_wrong(frame: str, moments: tuple[str, ...]) -> None:
    is_right = moments is BALL or (moments is ROD and frame == "unspun")
    assert told(components((2, 0, 2), frame), moments) == [(OFF if is_right else NONE, PLACE)]


def test_products_of_inertia_leave_no_axis_of_revolution() -> None:
    tensor = [["1.2", "0", "0.1"], ["0", "1.2", "0"], ["0.1", "0", "0.4"]]
    assert told(components((2, 0, 2), "unspun"), tensor) == [(NONE, PLACE)]


def test_a_turn_the_wrong_way_is_told() -> None:
    omega = ["dot(psi)*sin(theta)*sin(phi) - dot(theta)*cos(phi)", *components((2, 0, 2), "body")[1:]]
    assert told(omega, BOX) == [(NONE, PLACE)]


@pytest.mark.parametrize("name", scene_ids())
def test_built_in_bodies_have_axes_of_their_own(name: str) -> None:
    assert [each for each in soundness_problems(load_scene(name)) if each.code in {OFF, NONE}] == []


EULER = sp.symbols("a b c d")


def by_euler_parameters(frame: str) -> list[str]:
    """2 q̄ q̇ along axes of the body, 2 q̇ q̄ along those of space; the product is Hamilton's, of SymPy."""
    q = sp.Quaternion(*EULER)
    rate = sp.Quaternion(*sp.symbols("a_rate b_rate c_rate d_rate"))
    whole = (q.conjugate() * rate if frame == "body" else rate * q.conjugate()).expand()
    written = [str(sp.expand(2 * part)) for part in (whole.b, whole.c, whole.d)]
    for name in map(str, EULER):
        written = [text.replace(f"{name}_rate", f"dot({name})") for text in written]
    return written


@pytest.mark.parametrize(
    ("frame", "factor", "moments", "expected"),
    [
        pytest.param("body", "1", BOX, set(), id="along axes of the body"),
        pytest.param("body", "1", BALL, set(), id="of a ball"),
        pytest.param("body", "1/(a^2 + b^2 + c^2 + d^2)", BOX, set(), id="right beside the constraint, too"),
        pytest.param("space", "1", BOX, {NONE}, id="along axes of space"),
        pytest.param("space", "1", BALL, {OFF}, id="of a ball along them"),
        pytest.param("body", "1/2", BOX, {NONE}, id="half as fast"),
        pytest.param("body", "a", BOX, {NONE}, id="with a factor that moves"),
    ],
)
def test_euler_parameters_are_looked_at_where_they_are_some(
    frame: str, factor: str, moments: tuple[str, ...], expected: set[str]
) -> None:
    """Beside a² + b² + c² + d² = 1 these components are those of no rotation, which is no matter."""
    top = {"name": "top", "kind": "rigid", "mass": "1", "position": ["0", "0", "0"], "inertia": list(moments)}
    document = {
        "format": 1,
        "id": "top",
        "dimension": 3,
        "coordinates": [{"name": name, "value": 0.5} for name in map(str, EULER)],
        "bodies": [top | {"angular_velocity": [f"({factor})*({each})" for each in by_euler_parameters(frame)]}],
        "constraints": [{"kind": "equation", "name": "unit", "equation": "a^2 + b^2 + c^2 + d^2 = 1"}],
    }
    _, problems = examine(document)
    assert {problem.code for problem in problems} & {OFF, NONE} == expected
