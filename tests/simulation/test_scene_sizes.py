"""The same scene as small as dust and as large as a mountain: the same events, and none of its numbers is "too large".

Lengths, masses and times are multiplied by powers of ten; kinds of events and their times, in units of the scene, are
to stay. The numbers of the scene at magnitude 1 are the reference.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import Any, NamedTuple

import numpy as np
import pytest

from deltaq.simulation.service import run

TITLE = {"de": "Größe", "en": "Size"}
ADAPTIVE = ("dormand-prince-54", "dop853", "taylor", "radau-5")
METHODS = (*ADAPTIVE, "gauss-6", "implicit-midpoint")


class Size(NamedTuple):
    """By how much lengths, masses and times are multiplied."""

    length: float
    mass: float = 1.0
    time: float = 1.0

    def scaled(self, value: float, length: int = 0, mass: int = 0, time: int = 0) -> float:
        """A quantity with these powers of length, mass and time."""
        return float(value * self.length**length * self.mass**mass * self.time**time)


class Events(NamedTuple):
    """How a run ended, and its events: their kinds and names, and their times in units of the scene."""

    status: str
    kinds: tuple[tuple[str, str], ...]
    times: tuple[float, ...]


def document(scene: Mapping[str, Any], values: Mapping[str, float]) -> dict[str, Any]:
    parameters = [{"name": name, "value": value, "positive": False} for name, value in values.items()]
    return {"format": 1, "id": "size", "title": TITLE, "dimension": 2, "parameters": parameters, **scene}


def braked_pendulum(size: Size) -> dict[str, Any]:
    """A pendulum with dry friction at its pivot, M ∝ m l²/T²."""
    values = {
        "l": size.scaled(1.0, length=1),
        "m": size.scaled(1.0, mass=1),
        "g": size.scaled(10.0, length=1, time=-2),
        "M": size.scaled(1.0, length=2, mass=1, time=-2),
    }
    scene = {
        "coordinates": [{"name": "phi", "value": 0.5, "rate": 0.0, "unit": "rad"}],
        "bodies": [{"name": "bob", "kind": "particle", "mass": "m", "position": ["l*sin(phi)", "-l*cos(phi)"]}],
        "loads": [
            {"kind": "gravity", "name": "weight", "acceleration": ["0", "-g"]},
            {"kind": "friction", "name": "pivot", "coordinate": "phi", "force": "M"},
        ],
    }
    return document(scene, values)


def resting_cart(size: Size, units: tuple[str, str]) -> dict[str, Any]:
    """A cart with a pendulum whose bob comes to rest at a wall, and two frictions: one of a belt, a small one.

    While the bob slides along the wall the small friction slips by l φ̇ (1 − cos φ), whose row differs from that of the
    wall by φ²/2 alone.
    """
    values = {
        "l": size.scaled(0.9069, length=1),
        "m1": size.scaled(0.7393, mass=1),
        "m2": size.scaled(1.867, mass=1),
        "g": size.scaled(11.1, length=1, time=-2),
        "F": size.scaled(2.511, length=1, mass=1, time=-2),
        "a": size.scaled(0.2646, length=1),
        "om": size.scaled(4.821, time=-1),
    }
    x, rate = size.scaled(0.14220610703970502, length=1), size.scaled(-0.0325205033455358, length=1, time=-1)
    turning = size.scaled(1.8777172714098098, time=-1)
    scene = {
        "coordinates": [
            {"name": "x", "value": x, "rate": rate, "unit": units[0]},
            {"name": "phi", "value": -0.7942452477863122, "rate": turning, "unit": units[1]},
        ],
        "bodies": [
            {"name": "cart", "kind": "particle", "mass": "m1", "position": ["x", "0"]},
            {"name": "bob", "kind": "particle", "mass": "m2", "position": ["x + l*sin(phi)", "-l*cos(phi)"]},
        ],
        "loads": [
            {"kind": "gravity", "name": "weight", "acceleration": ["0", "-g"]},
            {"kind": "friction", "name": "belt", "coordinate": "l*phi", "force": "F", "surface_rate": "0.3*a*om"},
            {"kind": "friction", "name": "small", "coordinate": "x + l*phi", "force": "0.0001*F"},
        ],
        "events": [{"name": "wall", "value": "1.2*l - x - l*sin(phi)", "then": "bounce", "restitution": "0"}],
    }
    return document(scene, values)


def events(scene: Mapping[str, Any], size: Size, span: float, method: str) -> Events:
    asked = {"scene": scene, "t_end": span * size.time, "samples": 21, "tolerance": 1e-9, "method": method}
    found: Any = run(asked)
    told = found["events"]
    kinds = tuple((each["kind"], each["name"]) for each in told)
    status = found["status"].replace("tolerance_missed", "ok")  # how well a tolerance is met is no matter here
    return Events(status, kinds, tuple(each["time"] / size.time for each in told))


def assert_alike(found: Events, reference: Events) -> None:
    assert found[:2] == reference[:2]
    np.testing.assert_allclose(found.times, reference.times, atol=1e-6)


@cache
def braked_at_one(method: str) -> Events:
    one = Size(1.0)
    found = events(braked_pendulum(one), one, 3.0, method)
    assert found[:2] == ("ok", (("turn", "pivot"), ("stick", "pivot")))
    return found


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize(
    "size",
    [Size(1e6, 1e6), Size(1e6, 1.0, 1e-2), Size(1e3, 1e6, 1e-2), Size(1e6, 1e6, 1e-2), Size(1e-6, 1e-6, 1e2)],
    ids=str,
)
def test_energies_and_momenta_of_any_size_are_no_divergence(size: Size, method: str) -> None:
    assert_alike(events(braked_pendulum(size), size, 3.0, method), braked_at_one(method))


def driven(force: str, value: float) -> dict[str, Any]:
    """A mass that something drives away, with a friction, so that work is done."""
    scene = {
        "coordinates": [{"name": "x", "value": 1.0, "rate": 1.0, "unit": "m"}],
        "bodies": [{"name": "mass", "kind": "particle", "mass": "m", "position": ["x", "0"]}],
        "loads": [
            {"kind": "force", "name": "drive", "at": "mass", "force": [force, "0"]},
            {"kind": "friction", "name": "slide", "coordinate": "x", "force": "0.1"},
        ],
    }
    return document(scene, {"m": 1.0, "k": value})


@pytest.mark.parametrize("method", ADAPTIVE)
@pytest.mark.parametrize(
    ("force", "value", "span"),
    [pytest.param("k*x", 1.0, 60.0, id="both grow"), pytest.param("k", 1e18, 0.01, id="the rate alone")],
)
def test_places_and_rates_beyond_all_bounds_are_one(force: str, value: float, span: float, method: str) -> None:
    found: Any = run({"scene": driven(force, value), "t_end": span, "samples": 21, "tolerance": 1e-6, "method": method})
    assert found["status"] == "diverged"
    # at x = 10¹⁵ m after ln 10¹⁵ s, or where k t has become 10¹⁵ m/s
    bound = {"k*x": 15.0 * np.log(10.0), "k": 1e-3}[force]
    assert 0.5 * bound < found["t_reached"] < 1.1 * bound


@cache
def resting_at_one(units: tuple[str, str], method: str) -> Events:
    found = events(resting_cart(Size(1.0), units), Size(1.0), 4.0, method)
    assert found.status == "ok"
    kinds = [kind for kind, _ in found.kinds]
    assert [kinds.count(each) for each in ("turn", "impact", "rest", "stick", "slip", "release")] == [10, 1, 1, 2, 2, 1]
    return found


@pytest.mark.parametrize("method", ["dop853", "dormand-prince-54"])
@pytest.mark.parametrize("units", [("m", "rad"), ("", "")], ids=["with units", "without"])
@pytest.mark.parametrize(
    "size",
    [
        *(Size(10.0**power) for power in (-6, -4, -2, 2, 4, 6)),
        Size(1e-6, 1e-4),
        Size(1e-3, 1e6, 1e3),
        Size(1e3, 1e-6, 1e-2),
    ],
    ids=str,
)
def test_the_small_and_the_large_have_the_same_events(size: Size, units: tuple[str, str], method: str) -> None:
    found = events(resting_cart(size, units), size, 4.0, method)
    assert_alike(found, resting_at_one(units, method))
