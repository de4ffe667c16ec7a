"""What holds released quantities along a motion, and what answers say of constraints."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from tests.simulation.constrained import G
from tests.simulation.test_constraints import swing

from deltaq.errors import UnknownNameError
from deltaq.simulation.service import run

PENDULUM = {"scene": "pendulum", "t_end": 5.0, "samples": 51, "tolerance": 1e-11}


def test_the_rod_of_a_pendulum_pulls_with_weight_and_centripetal_force() -> None:
    start = {"initial": {"phi": {"value": np.pi / 2, "rate": 0.0}}, "parameters": {"m": 1.0, "l": 1.0, "g": G}}
    found: Any = run({**PENDULUM, **start, "release": ["l"]})
    angle, square = swing(np.array(found["t"]))
    wrong = np.abs(np.array(found["multipliers"]["l"]) + square + G * np.cos(angle))
    assert wrong.max() < 1e-9
    assert (wrong <= np.array(found["error"]["multipliers"]["l"])).all()


def test_the_force_of_a_guide_does_the_work_that_the_motion_takes_up() -> None:
    found: Any = run({"scene": "kapitza", "release": ["y"], "t_end": 0.5, "samples": 5001, "tolerance": 1e-11})
    power = np.array(found["multipliers"]["y"]) * np.array(found["rates"]["y"])
    total = np.array(found["energy"]["kinetic"]) + np.array(found["energy"]["potential"])
    work = np.concatenate([[0.0], np.cumsum(0.5 * (power[1:] + power[:-1]) * np.diff(found["t"]))])
    assert np.ptp(work) > 1.0
    assert np.abs(work - (total - total[0])).max() < 1e-4 * np.ptp(work)


KINKED = [
    pytest.param({"kind": "potential", "energy": "max(phi, 0)^2"}, id="a spring on one side"),
    pytest.param({"kind": "potential", "energy": "abs(phi)"}, id="a potential with an edge"),
    pytest.param({"kind": "moment", "angle": "phi", "moment": "sign(phi)"}, id="a moment that jumps"),
    pytest.param({"kind": "moment", "angle": "phi", "moment": "-sign(dot(phi))"}, id="a moment against the rate"),
    pytest.param({"kind": "moment", "angle": "phi", "moment": "-6*sign(dot(phi))"}, id="a moment that holds"),
    pytest.param({"kind": "dissipation", "function": "step(phi)*dot(phi)^2/2"}, id="a damper on one side"),
]


@pytest.mark.parametrize("load", KINKED)
def test_a_rod_pulls_with_weight_and_centripetal_force_beside_kinks(load: dict[str, str]) -> None:
    """Z = −m l φ̇² − m g cos φ, whatever moment turns the rod."""
    found: Any = run({"scene": hanging(load), "t_end": 3.0, "samples": 61, "release": ["l"], "tolerance": 1e-9})
    assert found["status"] == "ok"
    angle, rate = np.array(found["coordinates"]["phi"]), np.array(found["rates"]["phi"])
    wrong = np.abs(np.array(found["multipliers"]["l"]) + rate**2 + G * np.cos(angle))
    assert (wrong <= np.array(found["error"]["multipliers"]["l"])).all()
    assert wrong.max() < 1e-6


def test_a_rod_takes_its_share_of_a_force_with_a_kink() -> None:
    """Z = −m l φ̇² − m g cos φ − Fₓ sin φ of a string that pulls on one side of it."""
    string = {"kind": "force", "at": "bob", "force": ["-50*min(l*sin(phi)-0.2,0)", "0"]}
    found: Any = run({"scene": hanging(string), "t_end": 3.0, "samples": 61, "release": ["l"], "tolerance": 1e-9})
    angle, rate = np.array(found["coordinates"]["phi"]), np.array(found["rates"]["phi"])
    pull = -50.0 * np.minimum(np.sin(angle) - 0.2, 0.0)
    wrong = np.abs(np.array(found["multipliers"]["l"]) + rate**2 + G * np.cos(angle) + pull * np.sin(angle))
    assert (pull > 0.0).any()
    assert (pull == 0.0).any()
    assert wrong.max() < 1e-6


def test_a_guide_feels_the_friction_on_the_side_that_the_motion_is_on() -> None:
    """Z = m ẍ − k (u − x) − c sgn(u̇ − ẋ): at the start u̇ = ẋ, and u falls behind."""
    scene: Any = {
        "format": 1,
        "id": "pulled",
        "title": {"en": "Pulled"},
        "coordinates": [{"name": "x"}, {"name": "u", "value": 1.0}],
        "parameters": [{"name": "k", "value": 30.0}],
        "bodies": [{"kind": "particle", "name": f"at_{n}", "mass": "1", "position": [n, "0"]} for n in "xu"],
        "loads": [
            {"kind": "potential", "name": "spring", "energy": "k*(u-x)^2/2"},
            {"kind": "dissipation", "name": "dry", "function": "abs(dot(u)-dot(x))"},
        ],
    }
    found: Any = run({"scene": scene, "freeze": ["x"], "t_end": 1.0, "release": ["x"], "tolerance": 1e-9})
    u, rate = np.array(found["coordinates"]["u"]), np.array(found["rates"]["u"])
    side = np.where(rate == 0.0, -1.0, np.sign(rate))
    np.testing.assert_allclose(found["multipliers"]["x"], -30.0 * u - side, atol=1e-6)


def test_a_shift_of_a_bound_body_is_held_beside_a_kink() -> None:
    """Z = m ẍ of a body at x + a: the load acts on x, and a has no part in it."""
    scene: Any = hanging({"kind": "potential", "energy": "20*max(x,0)^2"})
    scene["coordinates"] = [{"name": "x", "value": 0.6}, {"name": "y", "value": -0.8}]
    scene["parameters"].append({"name": "a", "value": 0.0, "positive": False})
    scene["bodies"][0]["position"] = ["x + a", "y"]
    scene["constraints"] = [{"kind": "equation", "name": "rod", "equation": "x^2+y^2=l^2"}]
    found: Any = run({"scene": scene, "t_end": 2.0, "samples": 41, "release": ["a"], "tolerance": 1e-9})
    x, y, vx, vy = (np.array(found[key][name]) for key in ("coordinates", "rates") for name in "xy")
    force = -40.0 * np.maximum(x, 0.0)
    pull = (vx**2 + vy**2 + x * force - y * G) / -2.0  # ẍ = force + 2 λ x, ÿ = −g + 2 λ y, x ẍ + y ÿ = −v²
    wrong = np.abs(np.array(found["multipliers"]["a"]) - force - 2.0 * pull * x)
    assert (x > 0.1).any()
    assert (x < -0.1).any()
    assert wrong.max() < 1e-6


def hanging(load: dict[str, Any]) -> dict[str, Any]:
    """A pendulum of mass 1 and length 1 with a load more."""
    return {
        "format": 1,
        "id": "hanging",
        "title": {"en": "Hanging"},
        "coordinates": [{"name": "phi", "value": 1.0}],
        "parameters": [{"name": "m", "value": 1.0}, {"name": "l", "value": 1.0}, {"name": "g", "value": G}],
        "bodies": [{"kind": "particle", "name": "bob", "mass": "m", "position": ["l*sin(phi)", "-l*cos(phi)"]}],
        "loads": [{"kind": "gravity", "acceleration": ["0", "-g"]}, {"name": "more", **load}],
    }


def test_what_nothing_holds_is_refused_where_it_is_asked() -> None:
    with pytest.raises(UnknownNameError) as caught:
        run({**PENDULUM, "release": ["l", "phi"]})
    assert [(problem.code, problem.pointer) for problem in caught.value.problems] == [("cannot-release", "/release/1")]


def test_an_answer_tells_of_constraints_only_where_there_are_some() -> None:
    found = run(dict(PENDULUM))
    assert not {"multipliers", "undetermined", "drift", "moved"} & found.keys()
