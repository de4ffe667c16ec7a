"""What holds a released quantity where motions jump, stick and rest: against Newton's law, and against constraints.

Z = m r̈ · ∂r/∂l − F · ∂r/∂l − R ∂c/∂l − λ ∂g/∂l of a particle at r(q, l), with R and λ as the answer tells them.
"""

from __future__ import annotations

from random import Random
from typing import Any

import numpy as np
import pytest
from tests.simulation.constrained import G
from tests.simulation.rods import ASKED, LENGTH, MASS, WEIGHT, block, friction, hinged, rod, wind
from tests.simulation.scenes import document
from tests.simulation.test_impact import contact

from deltaq.errors import UnknownNameError
from deltaq.simulation.service import run


def told(found: dict[str, Any], name: str) -> np.ndarray:
    """R of the friction, or λ of a contact."""
    known = {**found.get("friction", {}), **found.get("contacts", {})}
    return np.array(known[name]["force"], dtype=float) if name in known else np.zeros(len(found["t"]))


CASES = [
    pytest.param(rod(friction("phi", 2.0, 4.0)), {}, {"stick", "turn"}, id="friction in the pivot, no share of it"),
    pytest.param(rod(friction("l*phi", 1.0, 8.0)), {"dry": "phi"}, {"stick", "turn"}, id="friction along the arc"),
    pytest.param(rod(events=(contact("wall", "phi + 0.2", 0.8),)), {}, {"impact"}, id="a wall at an angle"),
    pytest.param(rod(events=(contact("wall", "l*sin(phi) + 0.3", 0.5),)), {"wall": "sin"}, {"impact"}, id="a wall"),
    pytest.param(
        rod(wind(-30.0), events=(contact("wall", "l*sin(phi) + 0.3", 0.0),)),
        {"wall": "sin"},
        {"rest"},
        id="pressed to a wall",
    ),
    pytest.param(
        rod(wind(-30.0), friction("l*phi", 1.0, 1.5), events=(contact("wall", "l*sin(phi) + 0.3", 0.6),)),
        {"wall": "sin", "dry": "phi"},
        {"impact", "turn"},
        id="friction and a wall",
    ),
]


@pytest.mark.parametrize("method", ["dop853", "radau-5", "gauss-4", "rk4"])
@pytest.mark.parametrize(("scene", "shares", "kinds"), CASES)
def test_a_rod_is_held_by_newtons_law(
    scene: dict[str, Any], shares: dict[str, str], kinds: set[str], method: str
) -> None:
    asked = {"t_end": 12.0, "samples": 301, "release": ["l"], "method": method, **ASKED}
    found: Any = run({"scene": scene, **asked})
    phi, rate = np.array(found["coordinates"]["phi"]), np.array(found["rates"]["phi"])
    slopes = {"phi": phi, "sin": np.sin(phi)}
    pushes = sum((told(found, name) * slopes[of] for name, of in shares.items()), np.zeros(len(phi)))
    blown = sum(float(load["force"][0]) for load in scene["loads"] if load["name"] == "wind") * np.sin(phi)
    expected = -MASS * (LENGTH * rate**2 + G * np.cos(phi)) - blown - pushes
    determined, given = ~np.isnan(expected), np.array(found["multipliers"]["l"], dtype=float)
    assert {each["kind"] for each in found["events"]} >= kinds
    np.testing.assert_array_equal(determined, ~np.isnan(given))
    assert determined.sum() > 20
    np.testing.assert_allclose(given[determined], expected[determined], rtol=1e-7, atol=1e-6)


@pytest.mark.parametrize("seed", range(12))
def test_a_released_length_is_held_by_what_a_constraint_would_be(seed: int) -> None:
    """Z = −S: the force of a rod that links two particles, from two descriptions of the same system."""
    by_angles, by_rods = hinged(Random(seed))
    asked = {"t_end": 3.0, "samples": 61, **ASKED}
    one: Any = run({"scene": by_angles, "release": ["l"], **asked})
    other: Any = run({"scene": by_rods, **asked})
    until = min(one["t_reached"], other["t_reached"])
    behind = [each["time"] for each in one["events"]]
    found, known = (
        dict(zip(one["t"], one["multipliers"]["l"], strict=True)),
        dict(zip(other["t"], other["multipliers"]["S"], strict=True)),
    )
    away = [t for t in np.linspace(0.0, 3.0, 61).round(15) if t <= until and all(abs(t - at) > 1e-6 for at in behind)]
    compared = [t for t in away if t in found and t in known and found[t] is not None and known[t] is not None]
    assert len(compared) > 5
    np.testing.assert_allclose([found[t] for t in compared], [-known[t] for t in compared], rtol=1e-5, atol=1e-4)
    impulses = [
        (each["impulses"], also["impulses"]) for each, also in zip(one["events"], other["events"], strict=False)
    ]
    for each, also in impulses[:5]:
        assert ("l" in each) == ("S" in also)
        if "l" in each:
            assert each["l"] == pytest.approx(-also["S"], rel=1e-4, abs=1e-5)


@pytest.mark.parametrize("e", [0.0, 0.6, 1.0])
def test_the_impulse_in_a_rod_is_newtons(e: float) -> None:
    """m Δv = Λ eₓ + Ẑ (sin φ, −cos φ): both components of the jump of the momentum."""
    scene = rod(events=(contact("wall", "l*sin(phi) + 0.3", e),))
    found: Any = run({"scene": scene, "t_end": 4.0, "samples": 5, "release": ["l"], **ASKED})
    times, phi, rate = (np.array(each) for each in (found["t"], found["coordinates"]["phi"], found["rates"]["phi"]))
    impacts = [each for each in found["events"] if each["kind"] in ("impact", "rest")]
    assert impacts
    for each in impacts:
        before = int(np.abs(times - each["time"]).argmin())
        before -= times[before] == times[before - 1]
        jump = MASS * LENGTH * (rate[before + 1] - rate[before])
        impulse, held, angle = each["impulses"]["wall"], each["impulses"]["l"], phi[before]
        assert impulse + held * np.sin(angle) == pytest.approx(jump * np.cos(angle), rel=2e-5)
        assert -held * np.cos(angle) == pytest.approx(jump * np.sin(angle), rel=2e-5)


def test_impulses_of_contacts_that_depend_on_each_other_are_left_out() -> None:
    """Two walls at the same place: nothing tells how much each of them pushes, but what the rod takes is known."""
    walls = (contact("one", "l*sin(phi) + 0.3", 0.0), contact("two", "2*l*sin(phi) + 0.6", 0.0))
    alone: Any = run({"scene": rod(events=walls[:1]), "t_end": 1.0, "samples": 5, "release": ["l"], **ASKED})
    found: Any = run({"scene": rod(events=walls), "t_end": 1.0, "samples": 5, "release": ["l"], **ASKED})
    assert found["events"][0]["impulses"].keys() == {"l"}
    assert found["events"][0]["impulses"]["l"] == pytest.approx(alone["events"][0]["impulses"]["l"], rel=1e-5)


def test_no_impulses_are_told_that_nobody_asked_for() -> None:
    scene = rod(events=(contact("wall", "phi + 0.2", 0.8),))
    found: Any = run({"scene": scene, "t_end": 1.0, "samples": 5, "include": ["coordinates"], "tolerance": 1e-8})
    assert [each["impulses"] for each in found["events"]] == [{}]


OPEN = [
    pytest.param("l*phi", id="friction along the arc, which has a share in the length"),
    pytest.param("phi", id="friction in the pivot, which has none"),
]


@pytest.mark.parametrize("coordinate", OPEN)
def test_what_holds_beside_indeterminate_forces_is_indeterminate(coordinate: str) -> None:
    """A wall and friction that hold the same angle: of the wall's force, which takes part in Z, nothing is known."""
    scene = rod(wind(-30.0), friction(coordinate, 1.0, 8.0), events=(contact("wall", "l*sin(phi) + 0.3", 0.0),))
    found: Any = run({"scene": scene, "t_end": 2.0, "samples": 21, "release": ["l"], **ASKED})
    (span,) = found["indeterminate"]
    assert span["names"] == ["dry", "wall", "l"]
    is_open = np.isnan(np.array(found["multipliers"]["l"], dtype=float))
    rests = np.array(found["contacts"]["wall"]["force"], dtype=float)
    np.testing.assert_array_equal(is_open, np.isnan(rests))
    assert is_open.any()
    assert not is_open.all()


def test_what_holds_is_told_beside_indeterminate_forces_without_a_share_in_it() -> None:
    """Two frictions in the pivot: Z = −m g cos φ at rest, however they share the moment."""
    scene = rod(friction("phi", 9.0, 9.0), {**friction("phi", 9.0, 9.0), "name": "other"}, start=(0.5, 0.0))
    found: Any = run({"scene": scene, "t_end": 1.0, "samples": 11, "release": ["l"], **ASKED})
    assert found["indeterminate"][0]["names"] == ["dry", "other"]
    np.testing.assert_allclose(found["multipliers"]["l"], -MASS * G * np.cos(0.5), rtol=1e-12)


def test_a_guide_carries_what_slides_on_it() -> None:
    found: Any = run({"scene": block({"y": "0"}, (0.0, 3.0)), "t_end": 3.0, "samples": 31, "release": ["y"], **ASKED})
    np.testing.assert_allclose(found["multipliers"]["y"], MASS * G, rtol=1e-12)


def test_a_guide_at_rest_shares_with_friction_and_nothing_tells_how() -> None:
    found: Any = run({"scene": block({"x": "0", "y": "0"}), "t_end": 1.0, "samples": 3, "release": ["x", "y"], **ASKED})
    assert found["multipliers"]["x"] == [None] * 3
    assert found["indeterminate"] == [{"names": ["x"], "start": 0.0, "end": 1.0}]
    np.testing.assert_allclose(found["multipliers"]["y"], MASS * G, rtol=1e-12)


def test_a_guide_that_moves_has_friction_against_it() -> None:
    """Z = m ẍ − W + F sgn ẋ with x = sin t."""
    found: Any = run(
        {"scene": block({"x": "sin(t)", "y": "0"}), "t_end": 6.0, "samples": 61, "release": ["x"], **ASKED}
    )
    times = np.array(found["t"])
    expected = -MASS * np.sin(times) - 5.0 + 3.0 * np.sign(np.cos(times))
    np.testing.assert_allclose(found["multipliers"]["x"], expected, atol=1e-9)


def beam(*events: dict[str, object], gap: str = "l") -> dict[str, Any]:
    """A rod of mass 2 and length 1.5 on a pivot with friction; its centre is half of `gap` away from it."""
    body = {"kind": "rigid", "name": "bar", "mass": "m", "inertia": "m*l^2/12", "angle": "phi"}
    values = {"m": MASS, "l": LENGTH}
    found = document({"phi": (1.0, 0.0)}, values, {"bar": ("m", ["0", "0"])}, [WEIGHT, friction("phi", 2.0, 4.0)])
    place = {"position": [f"{gap}/2*sin(phi)", f"-{gap}/2*cos(phi)"]}
    return found | {"bodies": [{**body, **place}], "events": list(events)}


def test_a_rod_with_mass_is_held_while_its_pivot_sticks() -> None:
    """Z δl is the work of m (l/2 φ̇² + g cos φ) on δl/2, by which its centre is displaced along the rod."""
    found: Any = run({"scene": beam(), "t_end": 12.0, "samples": 121, "release": ["l"], **ASKED})
    phi, rate = np.array(found["coordinates"]["phi"]), np.array(found["rates"]["phi"])
    assert {"turn", "stick"} <= {each["kind"] for each in found["events"]}
    expected = -MASS * (LENGTH / 2 * rate**2 + G * np.cos(phi)) / 2
    np.testing.assert_allclose(found["multipliers"]["l"], expected, rtol=1e-7)


def test_a_length_in_a_gap_is_refused_and_the_advice_helps() -> None:
    """Of a rod with its length in its inertia: the place at which it is held gets a coordinate, frozen and released.

    Between impacts it takes m (l/2 φ̇² + g cos φ), with friction in the pivot as without.
    """
    wall = contact("wall", "l*sin(phi) + 0.3", 0.5)
    with pytest.raises(UnknownNameError) as caught:
        run({"scene": beam(wall), "t_end": 1.0, "release": ["l"]})
    (problem,) = caught.value.problems
    assert (problem.code, problem.pointer) == ("cannot-release-of-contact", "/release/0")
    assert dict(problem.parameters)["event"] == "wall"
    scene = beam(contact("wall", "(p + l)*sin(phi) + 0.3", 0.5), gap="(2*p + l)")
    scene["coordinates"].append({"name": "p", "value": 0.0, "unit": "m"})
    asked = {"scene": scene, "t_end": 4.0, "samples": 81, "freeze": ["p"], "release": ["p"], **ASKED}
    found: Any = run(asked)
    phi, rate = np.array(found["coordinates"]["phi"]), np.array(found["rates"]["phi"])
    assert "impact" in {each["kind"] for each in found["events"]}
    resting = np.array(found["contacts"]["wall"]["force"], dtype=float)
    expected = -MASS * (LENGTH / 2 * rate**2 + G * np.cos(phi)) - resting * np.sin(phi)
    np.testing.assert_allclose(found["multipliers"]["p"], expected, rtol=1e-7, atol=1e-7)


def test_what_holds_a_string_that_catches_is_its_tension() -> None:
    """−Z = m (v² − g y)/l while it is taut and 0 while it is not, and m v·e at a jerk, which takes all of that."""
    found: Any = run({"scene": "catching-pendulum", "t_end": 4.0, "samples": 201, "release": ["l"], **ASKED})
    times = np.array(found["t"])
    x, y, u, v = (np.array(found[part][name]) for part in ("coordinates", "rates") for name in ("x", "y"))
    tension, is_taut = -np.array(found["multipliers"]["l"]), np.array(found["contacts"]["taut"]["force"]) > 0.0
    assert is_taut.any()
    assert not is_taut.all()
    np.testing.assert_allclose(tension[is_taut], (u**2 + v**2 - 9.81 * y)[is_taut], atol=1e-6)
    np.testing.assert_array_equal(tension[~is_taut], 0.0)
    (jerk,) = (each for each in found["events"] if each["kind"] == "rest" and each["loss"] > 1e-3)
    before = int(np.abs(times - jerk["time"]).argmin())
    before -= times[before] == times[before - 1]
    along = x[before] * u[before] + y[before] * v[before]
    assert -jerk["impulses"]["l"] == pytest.approx(along, rel=1e-4)
    assert found["reactions"]["l"] == {"unit": "N", "of_rod": True}
