"""The lab of Poincaré sections against closed forms and the pictures of Hénon and Heiles; and what it refuses."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np
import pytest
from tests.simulation.scenes import document

from deltaq.errors import InputError, RequestError
from deltaq.lab.library import get_experiment


def plane(energy: str, *loads: dict[str, Any], **start: float) -> dict[str, Any]:
    """A particle in the plane, in a potential."""
    begin = {name: (start.get(name, 0.0), start.get(f"v{name}", 0.0)) for name in "xy"}
    well = {"kind": "potential", "name": "well", "energy": energy}
    return document(begin, {"m": 1.0, "c": 0.0}, {"p": ("m", ["x", "y"])}, [well, *loads])


HENON_HEILES = plane("m*(x^2 + y^2)/2 + x^2*y - y^3/3", y=0.1, vx=0.4)
OSCILLATORS = plane("m*x^2/2 + m*y^2", vx=1.0, y=0.4)  # ω = 1 and √2
DRAG = {"kind": "dissipation", "name": "drag", "function": "c*(dot(x)^2 + dot(y)^2)/2"}


def ask(**fields: Any) -> dict[str, Any]:
    *_, last = get_experiment("poincare-section").run({"count": 0, "t_end": 60.0, **fields})
    return last.result  # type: ignore[return-value]


@cache
def of_henon_and_heiles(energy: float) -> dict[str, Any]:
    return ask(scene=HENON_HEILES, energy=energy, count=8, crossings=100, t_end=600.0)


@pytest.mark.parametrize(
    ("energy", "low", "high"),
    [
        pytest.param(1.0 / 12.0, 0.98, 1.0, id="curves alone"),
        pytest.param(1.0 / 8.0, 0.4, 0.8, id="islands in a sea"),
        pytest.param(1.0 / 6.0, 0.0, 0.15, id="hardly any curve"),
    ],
)
def test_regular_part_of_the_plane_is_that_of_henon_and_heiles(energy: float, low: float, high: float) -> None:
    """Their figures 4 to 7: all is regular up to E = 0.11; from there the part falls to almost nothing at 1/6."""
    found = of_henon_and_heiles(energy)
    assert low <= found["regular"] <= high
    assert found["kept"] < 1e-11
    assert found["missed"] == 0


@pytest.mark.parametrize("energy", [1.0 / 12.0, 1.0 / 8.0])
def test_the_grid_covers_what_the_energy_allows(energy: float) -> None:
    """Where x = 0: ẏ² ≤ 2E − y² + 2y³/3; cells of the grid are allowed in the part of its box that this area has."""
    found = of_henon_and_heiles(energy)
    starts = [orbit["initial"] for orbit in found["orbits"]]
    y, v = np.array([[start["y"]["value"], start["y"]["rate"]] for start in starts]).T
    room = 2.0 * energy - y**2 + 2.0 * y**3 / 3.0 - v**2
    rates = np.array([start["x"]["rate"] for start in starts])
    np.testing.assert_allclose(rates**2, room, atol=1e-12)
    assert np.all(rates > 0.0)
    turning = np.roots([2.0 / 3.0, -1.0, 0.0, 2.0 * energy])
    low, high = sorted(turning.real)[:2]
    side = np.linspace(low, high, 4001)
    area = 2.0 * np.trapezoid(np.sqrt(np.maximum(2.0 * energy - side**2 + 2.0 * side**3 / 3.0, 0.0)), side)
    whole = (high - low) * 2.0 * math.sqrt(2.0 * energy)
    assert 1.0 - found["forbidden"] / 64.0 == pytest.approx(area / whole, abs=0.08)
    assert len(starts) == 64 - found["forbidden"]  # the scene's own start has another energy
    assert np.ptp(y) > 0.85 * (high - low)


def test_points_and_their_errors_are_those_of_the_closed_form() -> None:
    """x = sin t; y = y₀ cos √2 t + …: points at 2πk, nearly all of them within their estimates."""
    found = ask(scene=OSCILLATORS, count=5, t_end=400.0, crossings=60)
    assert (found["plane"], found["horizontal"], found["vertical"]) == ("x", "y", "dot(y)")
    assert (found["driven"], found["regular"], found["sharp"]) == (False, 1.0, found["points"])
    frequency = math.sqrt(2.0)
    for orbit in found["orbits"]:
        start, t = orbit["initial"]["y"], math.tau * np.arange(60)
        y = start["value"] * np.cos(frequency * t) + start["rate"] / frequency * np.sin(frequency * t)
        true = np.abs(np.array(orbit["x"]) - y)
        assert len(orbit["t"]) == 60
        np.testing.assert_allclose(orbit["t"], t, atol=1e-10)
        assert np.mean(true <= np.array(orbit["error"]) + 1e-15) > 0.95
        assert np.max(orbit["error"]) < 1e-10


def test_own_start_and_energy_are_the_scenes() -> None:
    """E = 1/2 + 0.4²: the own start is the first orbit, and all others have its energy."""
    found = ask(scene=OSCILLATORS, count=3, crossings=5)
    assert found["energy"] == pytest.approx(0.5 + 0.16)
    assert [orbit["own"] for orbit in found["orbits"]] == [True] + [False] * (len(found["orbits"]) - 1)
    for orbit in found["orbits"]:
        (x, y) = (orbit["initial"][name] for name in "xy")
        energy = 0.5 * (x["rate"] ** 2 + y["rate"] ** 2 + x["value"] ** 2) + y["value"] ** 2
        assert energy == pytest.approx(found["energy"], rel=1e-9)


def test_a_drive_is_cut_by_its_phase() -> None:
    """The starts are a grid over what the own motion covers, and points follow one another by a period."""
    found = ask(scene="kapitza", count=2, crossings=6, t_end=2.0)
    assert (found["driven"], found["plane"], found["energy"], found["regular"]) == (True, "sin(omega*t)", None, None)
    assert len(found["orbits"]) == 5
    for orbit in found["orbits"]:
        np.testing.assert_allclose(np.diff(orbit["t"]), math.tau / found["parameters"]["omega"], atol=1e-12)


def test_a_plane_by_a_rate_and_other_axes() -> None:
    """Where ẏ falls through 0, y is at its maximum: y = √(2 (E − Eₓ)) / ω; the axes are what was asked for."""
    asked = {"plane": "dot(y)", "direction": "falling", "horizontal": "x + 2", "vertical": "y"}
    found = ask(scene=OSCILLATORS, count=3, crossings=8, **asked)
    for orbit in found["orbits"]:
        start = orbit["initial"]
        energy = 0.5 * start["y"]["rate"] ** 2 + start["y"]["value"] ** 2
        np.testing.assert_allclose(orbit["y"], math.sqrt(energy), atol=1e-10)
        assert np.all(np.abs(np.array(orbit["x"]) - 2.0) < 2.0)


def test_after_the_horizon_points_are_marked_or_left_out() -> None:
    asked = {"scene": HENON_HEILES, "energy": 1.0 / 6.0 - 1e-3, "count": 2, "t_end": 500.0, "crossings": 80}
    marked, left = ask(**asked), ask(**asked, beyond=False)
    lost = [orbit for orbit in marked["orbits"] if orbit["horizon"] is not None]
    assert lost
    assert {orbit["status"] for orbit in lost} == {"horizon_reached"}
    assert all(orbit["chaotic"] for orbit in lost)
    assert all(orbit["t"][-1] >= orbit["horizon"] * 0.999 for orbit in lost)
    assert all(o["t"][-1] < o["horizon"] for o in left["orbits"] if o["horizon"] is not None and o["t"])


def test_a_motion_that_repeats_with_each_crossing_is_one_point_and_regular() -> None:
    """Behind its transient a weakly driven pendulum with friction is where it was a period before."""
    found = ask(scene="driven-pendulum", parameters={"gamma": 0.2}, crossings=25, skip=60, t_end=300.0)
    (orbit,) = found["orbits"]
    assert np.ptp(orbit["x"]) < 1e-10
    assert (len(orbit["t"]), orbit["status"], orbit["chaotic"], orbit["horizon"]) == (25, "ok", False, None)


def test_first_points_can_be_left_out() -> None:
    whole, rest = ask(scene=OSCILLATORS, crossings=9), ask(scene=OSCILLATORS, crossings=6, skip=3)
    assert rest["orbits"][0]["t"] == whole["orbits"][0]["t"][3:]


REFUSED = [
    pytest.param(
        {"scene": "double-pendulum", "initial": {"phi1": {"value": 1e12}}},
        "angle-too-large",
        "/initial/phi1/value",
        id="an angle beside which there are no near numbers",
    ),
    pytest.param({"scene": "pendulum"}, "section-one-degree", "/scene", id="nothing to cut"),
    pytest.param({"scene": "kapitza", "energy": 1.0}, "section-energy-driven", "/energy", id="no energy is kept"),
    pytest.param({"scene": OSCILLATORS, "plane": "m + 1"}, "section-plane-constant", "/plane", id="no plane"),
    pytest.param({"scene": OSCILLATORS, "plane": "x - x"}, "section-plane-constant", "/plane", id="zero"),
    pytest.param(
        {"scene": OSCILLATORS, "plane": "1/(y - 1/10)"}, "section-never-met", "/plane", id="a pole is no root"
    ),
    pytest.param({"scene": OSCILLATORS, "plane": "x - 3"}, "section-never-met", "/plane", id="too far out"),
    pytest.param(
        {"scene": OSCILLATORS, "plane": "dot(x)^2 + x^2 - 1"}, "section-plane-contains", "/plane", id="a constant"
    ),
    pytest.param({"scene": OSCILLATORS, "plane": "ddot(x)"}, "section-derivative", "/plane", id="an acceleration"),
    pytest.param({"scene": OSCILLATORS, "plane": "z"}, "unknown-name", "/plane", id="no name"),
    pytest.param({"scene": OSCILLATORS, "horizontal": "x +"}, "unexpected-end", "/horizontal", id="no expression"),
    pytest.param({"scene": OSCILLATORS, "vertical": "sqrt(x - 1)"}, "never-defined", "/vertical", id="no value there"),
    pytest.param(
        {"scene": OSCILLATORS, "energy": -1.0, "count": 3}, "section-energy-unreachable", "/energy", id="too little"
    ),
    pytest.param({"scene": "four-bar"}, "lab-constraints", "/scene", id="constraints"),
    pytest.param({"scene": OSCILLATORS, "count": 40, "t_end": 500.0}, "section-too-large", "/count", id="too long"),
    pytest.param({"scene": OSCILLATORS, "count": 30, "crossings": 200}, "section-too-large", "/count", id="too many"),
]


@pytest.mark.parametrize(("fields", "code", "pointer"), REFUSED)
def test_what_has_no_section_is_told_with_what_to_do(fields: dict[str, Any], code: str, pointer: str) -> None:
    with pytest.raises(InputError) as caught:
        ask(**fields)
    assert [(one.code, one.pointer) for one in caught.value.problems] == [(code, pointer)]


def test_damping_without_a_drive_is_told() -> None:
    damped = plane("m*x^2/2 + m*y^2", DRAG, vx=1.0, y=0.4)
    assert ask(scene=damped, crossings=3)["points"] == 3  # c is 0
    with pytest.raises(RequestError) as caught:
        ask(scene=damped, parameters={"c": 0.1})
    assert [(one.code, one.pointer) for one in caught.value.problems] == [("section-dissipation", "/scene")]


@pytest.mark.parametrize("speed", [1.0, -1.0])
@pytest.mark.parametrize("direction", ["rising", "falling"])
@pytest.mark.parametrize(
    "energy",
    [
        pytest.param("m*(x^2/2 + x*abs(x)/4) + m*y^2", id="a modulus"),
        pytest.param("m*(x^2/4 + max(0, x)^2/2) + m*y^2", id="a maximum"),
        pytest.param("m*(x^2/2 + x^2*sign(x)/4) + m*y^2", id="a sign"),
    ],
)
def test_a_motion_that_begins_on_a_kink_in_the_plane(energy: str, direction: str, speed: float) -> None:
    """x″ = −1.5 x where x > 0, else −0.5 x: half a turn each; the start counts if it is in the direction."""
    found = ask(
        scene=plane(energy, vx=speed, y=0.4),
        plane="x",
        direction=direction,
        horizontal="y",
        vertical="dot(y)",
        crossings=4,
    )["orbits"][0]
    halves = math.pi / math.sqrt(1.5), math.pi / math.sqrt(0.5)
    begins = (speed > 0.0) == (direction == "rising")
    first = 0.0 if begins else halves[0] if speed > 0.0 else halves[1]
    assert found["status"] == "ok"
    np.testing.assert_allclose(found["t"], first + sum(halves) * np.arange(4), atol=1e-10)
