"""Impacts and dry friction in scenes with constraints, whose impulses and reactions answer them.

Sources: Whittaker, Analytical Dynamics, §§44–47 (impulses and constraints); Pfeiffer, Glocker, Multibody Dynamics with
Unilateral Contacts, ch. 4–8; Goldsmith, Impact, ch. 2 (rods).
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from deltaq.errors import RequestError
from deltaq.handout.script import script
from deltaq.mechanics.document import read_scene
from deltaq.simulation.service import run

G = 9.81
Document = dict[str, Any]


def scene(
    coordinates: dict[str, tuple[float, float]], parameters: dict[str, float], bodies: list[Document], **more: Any
) -> Document:
    return {
        "id": "own",
        "coordinates": [{"name": name, "value": q, "rate": v} for name, (q, v) in coordinates.items()],
        "parameters": [{"name": name, "value": value, "positive": False} for name, value in parameters.items()],
        "bodies": bodies,
    } | more


def particle(name: str, x: str, y: str, mass: str = "m") -> Document:
    return {"name": name, "kind": "particle", "mass": mass, "position": [x, y]}


def moved(document: Document, t_end: float, **more: Any) -> Document:
    include = ["coordinates", "rates", "multipliers", "energy", "error"]
    found = run({"scene": document, "t_end": t_end, "tolerance": 1e-10, "include": include} | more)
    assert found["status"] == "ok"
    return found


WEIGHT = {"kind": "gravity", "name": "weight", "acceleration": ["0", "-g"]}


def dumbbell(e: float, tilt: float, speed: float) -> Document:
    """Two masses on a rod of length l without weight, falling flat with one end a little above the floor."""
    at = {"x1": (0.0, 0.0), "y1": (1e-3, -speed), "x2": (math.cos(tilt), 0.0), "y2": (1e-3 + math.sin(tilt), -speed)}
    return scene(
        at,
        {"m": 1.5, "l": 1.0, "e": e},
        [particle("one", "x1", "y1"), particle("two", "x2", "y2")],
        constraints=[{"kind": "distance", "name": "rod", "from": "one", "to": "two", "length": "l", "multiplier": "S"}],
        events=[{"name": "floor", "value": "y1", "then": "bounce", "restitution": "e"}],
    )


@pytest.mark.parametrize("e", [0.0, 0.6, 1.0])
def test_a_dumbbell_rebounds_as_the_rigid_body_that_it_is(e: float) -> None:
    """Λ = (1 + e) v/(1/M + (½l cos α)²/J), M = 2m, J = ½ml²: v_S⁺ = Λ/M − v, ω⁺ = −½l cos α Λ/J."""
    tilt, speed, m = 0.5, 2.0, 1.5
    found = moved(dumbbell(e, tilt, speed), 2e-3, samples=5)
    arm, mass, inertia = 0.5 * math.cos(tilt), 2 * m, m / 2
    impulse = (1 + e) * speed / (1 / mass + arm**2 / inertia)
    assert found["events"][0]["kind"] == "impact"
    rates = {name: column[-1] for name, column in found["rates"].items()}
    places = {name: column[-1] for name, column in found["coordinates"].items()}
    across = np.array([places["x2"] - places["x1"], places["y2"] - places["y1"]])
    assert np.hypot(*across) == pytest.approx(1.0, abs=1e-13)
    centre = 0.5 * np.array([rates["x1"] + rates["x2"], rates["y1"] + rates["y2"]])
    turn = across[0] * (rates["y2"] - rates["y1"]) - across[1] * (rates["x2"] - rates["x1"])
    assert centre == pytest.approx([0.0, impulse / mass - speed], abs=1e-9)
    assert turn == pytest.approx(-arm * impulse / inertia, abs=1e-9)
    loss = 0.5 * (1 - e**2) * speed**2 / (1 / mass + arm**2 / inertia)
    assert found["events"][0]["loss"] == pytest.approx(loss, rel=1e-5, abs=1e-12)


def test_a_double_pendulum_by_rods_meets_a_wall_as_the_one_by_angles() -> None:
    """All impacts at the same times, with the same angles behind them."""
    wall = {"then": "bounce", "restitution": "e"}
    begun = [(0.9, 0.3), (0.4, -0.2)]
    values = {"m": 1.0, "l": 1.0, "g": G, "e": 0.7}
    upper, lower = ("l*sin(a)", "-l*cos(a)"), ("l*sin(a) + l*sin(b)", "-l*cos(a) - l*cos(b)")
    angles = scene(
        {"a": begun[0], "b": begun[1]},
        values,
        [particle("upper", *upper), particle("lower", *lower)],
        loads=[WEIGHT],
        events=[{"name": "wall", "value": "l*sin(a) + l*sin(b)", **wall}],
    )
    at, speed, coordinates = np.zeros(2), np.zeros(2), {}
    for k, (angle, rate) in enumerate(begun, 1):
        at = at + np.array([math.sin(angle), -math.cos(angle)])
        speed = speed + rate * np.array([math.cos(angle), math.sin(angle)])
        coordinates |= {f"x{k}": (at[0], speed[0]), f"y{k}": (at[1], speed[1])}
    rods = scene(
        coordinates,
        values,
        [particle("upper", "x1", "y1"), particle("lower", "x2", "y2")],
        points=[{"name": "pivot", "position": ["0", "0"]}],
        loads=[WEIGHT],
        constraints=[
            {"kind": "distance", "name": "first", "from": "pivot", "to": "upper", "length": "l"},
            {"kind": "distance", "name": "second", "from": "upper", "to": "lower", "length": "l"},
        ],
        events=[{"name": "wall", "value": "x2", **wall}],
    )
    one, other = moved(angles, 3.0, samples=61), moved(rods, 3.0, samples=61)
    assert len(one["events"]) >= 2
    assert [each["kind"] for each in one["events"]] == [each["kind"] for each in other["events"]]
    for this, that in zip(one["events"], other["events"], strict=True):
        assert this["time"] == pytest.approx(that["time"], abs=1e-9)
        assert this["loss"] == pytest.approx(that["loss"], abs=1e-6)
    a, b = (np.array(one["coordinates"][name]) for name in "ab")
    assert np.abs(np.array(other["coordinates"]["x2"]) - np.sin(a) - np.sin(b)).max() < 1e-8
    assert np.abs(np.array(other["coordinates"]["y2"]) + np.cos(a) + np.cos(b)).max() < 1e-8
    assert other["energy"]["drift"] < 1e-7


def hung(friction: float) -> Document:
    """A block on a table that a hanging weight pulls by a string: x + y is kept."""
    return scene(
        {"x": (0.0, 0.5), "y": (1.0, -0.5)},
        {"m": 1.0, "M": 2.0, "g": G, "mu": friction},
        [particle("block", "x", "0", "M"), particle("weight", "0", "y")],
        loads=[WEIGHT, {"kind": "friction", "name": "table", "coordinate": "x", "force": "mu*M*g"}],
        constraints=[{"kind": "equation", "name": "string", "equation": "x + y = 1", "multiplier": "S"}],
    )


def test_a_block_that_sticks_holds_the_weight_on_its_string() -> None:
    """It stops after v(M + m)/((μM − m)g) and stays; |S| is m(g − ÿ) while it slips, and the weight mg then."""
    found = moved(hung(0.8), 2.0, samples=81)
    stop = 0.5 * 3.0 / (0.6 * G)
    ((event),) = found["events"]
    assert (event["kind"], event["time"]) == ("stick", pytest.approx(stop, abs=1e-12))
    times, rates = np.array(found["t"]), np.array(found["rates"]["x"])
    assert np.abs(rates[times > stop]).max() < 1e-12
    force = np.abs(np.array(found["multipliers"]["S"]))
    behind = times > stop
    assert np.abs(force[behind][1:] - G).max() < 1e-9
    assert np.abs(force[times < stop] - (G + 0.6 * G / 3.0)).max() < 1e-9
    assert found["energy"]["drift"] < 1e-12


def test_a_block_whose_friction_is_too_small_goes_on() -> None:
    found = moved(hung(0.4), 2.0, samples=11)
    assert found["events"] == []
    assert found["rates"]["x"][-1] == pytest.approx(0.5 + 2.0 * (1.0 - 0.8) * G / 3.0, abs=1e-9)


def test_a_program_does_not_pretend_to_know_such_motions() -> None:
    with pytest.raises(RequestError) as caught:
        script(read_scene(hung(0.8)), "en", 1.0)
    assert [each.code for each in caught.value.problems] == ["program-friction-with-constraints"]


def test_friction_tells_what_acts_and_how_much_may() -> None:
    """Slipping, R = −μMg; sticking, the weight mg on the string holds the block, and R = mg < μMg."""
    found = moved(hung(0.8), 2.0, samples=81, include=["coordinates", "loads"])
    friction, stop = found["friction"]["table"], 0.5 * 3.0 / (0.6 * G)
    times, force, largest = (np.array(column) for column in (found["t"], friction["force"], friction["largest"]))
    assert np.abs(largest - 1.6 * G).max() < 1e-12
    assert np.abs(force[times < stop] + 1.6 * G).max() < 1e-9
    assert np.abs(np.abs(force[times > stop]) - G).max() < 1e-9
