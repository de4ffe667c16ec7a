"""Poincaré sections of motions with impacts and dry friction, against closed forms and known results."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from tests.simulation.scenes import document

from deltaq.errors import InputError, RequestError
from deltaq.lab.library import get_experiment

GRAVITY = 9.81


def ask(**fields: Any) -> dict[str, Any]:
    *_, last = get_experiment("poincare-section").run({"count": 0, "t_end": 30.0, **fields})
    return last.result  # type: ignore[return-value]


# --- a ball on a vibrating table -------------------------------------------------------------------------------------


def once_in_a_period(restitution: float, direction: str) -> dict[str, Any]:
    """A request for the impacts of a ball that bounces once in each period T = 1 s.

    It leaves with g T/2, when the table moves with (g T/2)(1 − e)/(1 + e). Source: P. J. Holmes, J. Sound and Vibration
    84 (1982) 173–189.
    """
    omega, leaving, cosine = math.tau, 0.5 * GRAVITY, 0.96
    amplitude = leaving * (1.0 - restitution) / (1.0 + restitution) / (omega * cosine)
    phase = math.acos(cosine)
    since = 1.0 - phase / omega
    height = amplitude * math.sin(phase) + leaving * since - 0.5 * GRAVITY * since**2
    return {
        "scene": "bouncing-ball",
        "plane": "z - a*sin(omega*t)",
        "direction": direction,
        "horizontal": "cos(omega*t)",
        "vertical": "dot(z)",
        "initial": {"z": {"value": height, "rate": leaving - GRAVITY * since}},
        "parameters": {"e": restitution, "a": amplitude, "omega": omega, "g": GRAVITY},
    }


@pytest.mark.parametrize(
    ("direction", "rate"),
    [
        pytest.param("rising", 0.5 * GRAVITY, id="behind the impact"),
        pytest.param("falling", -0.5 * GRAVITY, id="before the impact"),
        pytest.param("both", 0.5 * GRAVITY, id="once, behind it"),
    ],
)
@pytest.mark.parametrize("restitution", [0.3, 0.5, 0.8])
def test_a_ball_that_bounces_once_in_a_period_lands_where_it_must(
    restitution: float, direction: str, rate: float
) -> None:
    found = ask(**once_in_a_period(restitution, direction))
    (orbit,) = found["orbits"]
    assert (found["driven"], orbit["status"], orbit["chaotic"]) == (True, "ok", False)
    assert len(orbit["t"]) == 30
    np.testing.assert_allclose(np.diff(orbit["t"]), 1.0, atol=1e-11)
    np.testing.assert_allclose(orbit["x"], 0.96, atol=1e-11)
    np.testing.assert_allclose(orbit["y"], rate, atol=1e-11)
    assert np.all(np.array(orbit["error"]) < 1e-11)


def test_a_jump_over_the_plane_crosses_nothing() -> None:
    """Where the ball turns at its highest point its rate falls through zero; at the impact it jumps back over it."""
    asked = once_in_a_period(0.5, "both") | {"plane": "dot(z)", "horizontal": "z"}
    (orbit,) = ask(**asked)["orbits"]
    amplitude, phase = asked["parameters"]["a"], math.acos(0.96)
    highest = amplitude * math.sin(phase) + GRAVITY / 8.0
    np.testing.assert_allclose(orbit["x"], highest, atol=1e-10)
    np.testing.assert_allclose(np.diff(orbit["t"]), 1.0, atol=1e-10)


def test_starts_behind_the_table_are_left_out() -> None:
    """Of a grid over what the ball's own motion covers, which dips under z = 0 with the table, none is under it."""
    found = ask(scene="bouncing-ball", count=5, crossings=3)
    starts = [orbit["initial"]["z"]["value"] for orbit in found["orbits"]]
    assert min(starts) >= 0.0
    assert found["behind"] == 26 - len(starts)


# --- a ball between two walls ----------------------------------------------------------------------------------------


def wedge(half_angle: float, **start: float) -> dict[str, Any]:
    """A ball between two walls that meet below it, each at so many degrees to the vertical; nothing is lost.

    Source: H. E. Lehtihet, B. N. Miller, Physica D 21 (1986) 93–104.
    """
    sine, cosine = math.sin(math.radians(half_angle)), math.cos(math.radians(half_angle))
    begin = {name: (start.get(name, 0.0), start.get(f"v{name}", 0.0)) for name in "xy"}
    weight = {"kind": "gravity", "name": "weight", "acceleration": ["0", "-g"]}
    found = document(begin, {"m": 1.0, "g": 1.0}, {"ball": ("m", ["x", "y"])}, [weight])
    walls = {"right": f"{sine!r}*y - {cosine!r}*x", "left": f"{sine!r}*y + {cosine!r}*x"}
    impacts = [{"name": name, "value": value, "then": "bounce", "restitution": "1"} for name, value in walls.items()]
    return found | {"events": impacts}


def at_the_right_wall(half_angle: float, **fields: Any) -> dict[str, Any]:
    scene = wedge(half_angle, x=0.1, y=1.0, vx=0.3)
    gap = scene["events"][0]["value"]
    rate = gap.replace("y", "dot(y)").replace("x", "dot(x)")
    return ask(scene=scene, plane=gap, horizontal="y", vertical=rate, **fields)


def test_walls_at_a_right_angle_part_the_motion() -> None:
    """Each wall has a bouncing motion of its own: its rate v behind impacts stays, and they come after 2 v √2 / g."""
    found = at_the_right_wall(45.0, count=5, crossings=15, t_end=60.0)
    assert (found["driven"], found["kept"] < 1e-12, found["missed"]) == (False, True, 0)
    assert len(found["orbits"]) > 4
    for orbit in found["orbits"]:
        np.testing.assert_allclose(orbit["y"], orbit["y"][0], atol=1e-10)
        np.testing.assert_allclose(np.diff(orbit["t"]), 2.0 * math.sqrt(2.0) * orbit["y"][0], atol=1e-10)


@pytest.mark.parametrize(
    ("half_angle", "low", "high"),
    [
        pytest.param(45.0, 1.0, 1.0, id="integrable"),
        pytest.param(60.0, 0.0, 0.0, id="chaos alone, as Wojtkowski proved for wide wedges"),
    ],
)
def test_the_regular_part_of_a_wedge_is_the_known_one(half_angle: float, low: float, high: float) -> None:
    """Source: M. P. Wojtkowski, Comm. Math. Phys. 126 (1990) 507–533."""
    found = at_the_right_wall(half_angle, count=4, crossings=60, t_end=200.0)
    assert low <= found["regular"] <= high


# --- dry friction ----------------------------------------------------------------------------------------------------


def shaken_block(force: float) -> dict[str, Any]:
    """A mass on a spring with dry friction, shaken by cos t."""
    loads = [
        {"kind": "potential", "name": "spring", "energy": "k*x^2/2"},
        {"kind": "force", "name": "shaker", "at": "block", "force": ["cos(omega*t)", "0"]},
        {"kind": "friction", "name": "rubbing", "coordinate": "x", "force": "F"},
    ]
    values = {"m": 1.0, "k": 4.0, "omega": 1.0, "F": force}
    return document({"x": (0.1, 0.0)}, values, {"block": ("m", ["x", "0"])}, loads)


def test_friction_stronger_than_the_shaker_holds_the_block() -> None:
    """k x + 1 < F: it never moves, and each period shows the start."""
    (orbit,) = ask(scene=shaken_block(2.0), crossings=4)["orbits"]
    assert orbit["x"] == [0.1] * 4
    assert orbit["y"] == [0.0] * 4


# --- what is refused -------------------------------------------------------------------------------------------------

REFUSED = [
    pytest.param({"scene": "catching-pendulum"}, "section-dissipation", "/scene", id="energy is lost at impacts"),
    pytest.param({"scene": "stick-slip"}, "section-one-degree", "/scene", id="one degree on a steady belt"),
    pytest.param({"scene": "bouncing-ball", "energy": 1.0}, "section-energy-driven", "/energy", id="no energy is kept"),
    pytest.param(
        {"scene": "bouncing-ball", "initial": {"z": {"value": -5.0}}},
        "event-at-start",
        "/scene/events/0/value",
        id="under the table",
    ),
    pytest.param({"scene": "bouncing-ball", "plane": "z - 50"}, "section-never-met", "/plane", id="too high"),
]


@pytest.mark.parametrize(("asked", "code", "pointer"), REFUSED)
def test_what_has_no_section_is_refused_with_its_place(asked: dict[str, Any], code: str, pointer: str) -> None:
    with pytest.raises((InputError, RequestError)) as caught:
        ask(**asked)
    (problem,) = caught.value.problems
    assert (problem.code, problem.pointer) == (code, pointer)
