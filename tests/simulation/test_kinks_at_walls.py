"""Walls: with a kink of a potential at their very place, whose other side is never met, and in any unit of a gap."""

from __future__ import annotations

import math

import pytest
from tests.derivation.kinked_scenes import document, friction, potential, wall

from deltaq.simulation.service import run


@pytest.mark.parametrize(
    ("energy", "gap"),
    [
        pytest.param("k*abs(x)", "x", id="the same function"),
        pytest.param("k*abs(x)", "3*x", id="a multiple of it"),
        pytest.param("k*max(x, -2*x)", "x", id="two slopes"),
        pytest.param("k*max(x, 0)", "x", id="flat behind the wall"),
        pytest.param("-k*min(-x, x)", "x", id="the smaller of two"),
    ],
)
@pytest.mark.parametrize("loads", [(), (friction("c"),)], ids=["free", "with friction"])
def test_rebounds_pile_up_at_a_kink_as_at_any_wall(energy: str, gap: str, loads: tuple[dict[str, object], ...]) -> None:
    """As V = kx with e = 1/2; without friction impacts end at √(2h/a) (1 + e)/(1 − e)."""
    asked = {"initial": {"x": {"value": 0.3, "rate": 0.0}}, "t_end": 3.0, "samples": 31, "tolerance": 1e-9}
    values = {"k": 2.0, "c": 0.5}
    kinked = run({"scene": document([potential(energy), *loads], values, [wall(gap)]), **asked})
    smooth = run({"scene": document([potential("k*x"), *loads], values, [wall("x")]), **asked})
    assert kinked["status"] == "ok"
    x, same = (dict(zip(each["t"], each["coordinates"]["x"], strict=True)) for each in (kinked, smooth))  # type: ignore[index, call-overload]
    shared = [t for t in x if t in same]
    assert len(shared) >= 31
    assert [x[t] for t in shared] == pytest.approx([same[t] for t in shared], abs=1e-8)
    assert x[3.0] == pytest.approx(0.0, abs=1e-11)  # what a gap may be of a contact that counts as closed
    if not loads:
        last = max(event["time"] for event in kinked["events"])  # type: ignore[attr-defined]
        assert last == pytest.approx(3.0 * math.sqrt(0.3), abs=1e-6)


@pytest.mark.parametrize("energy", ["k*abs(x)", "k*max(x, -x)", "k*max(x, -3*x)"])
def test_what_is_at_rest_in_a_kink_stays(energy: str) -> None:
    """Forces of both signs on both sides of it."""
    answer = run({"scene": document([potential(energy)], {"k": 2.0}), "initial": {"x": {"value": 0.0}}, "t_end": 2.0})
    assert answer["status"] == "ok"
    assert max(map(abs, answer["coordinates"]["x"])) < 1e-9  # type: ignore[index]


@pytest.mark.parametrize("scale", ["1/1000000", "1/1000", "7", "1000", "1000000"])
@pytest.mark.parametrize(
    ("height", "begins", "rate"), [(0.1 + 0.2, 0.3, 0.0), (0.3, 0.3, 0.0), (0.0, 0.5, 0.0), (-4.0, -4.0, 1.0)]
)
def test_a_contact_is_the_same_in_any_unit_of_its_gap(scale: str, height: float, begins: float, rate: float) -> None:
    """Starts on the table at any height, where rounding may put it on either side, and rebounds that pile up there."""
    scene = document([potential("m*g*x")], {"h": height}, [wall(f"{scale}*(x - h)")])
    asked = {"initial": {"x": {"value": begins, "rate": rate}}, "t_end": 2.0, "samples": 5, "tolerance": 1e-9}
    answer = run({"scene": scene, **asked})
    assert answer["status"] == "ok"
    assert answer["coordinates"]["x"][-1] == pytest.approx(height, abs=5e-11)  # type: ignore[index]
