"""Runs that are measured: how often they are repeated, and that those behind events are right to the method's order."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from tests.simulation.scenes import document

from deltaq.lab.library import get_experiment
from deltaq.lab.measurement import repeated
from deltaq.lab.peers import peer_tracks
from deltaq.mechanics.document import read_scene
from deltaq.simulation.reference import reference
from deltaq.simulation.service import problem_of

OMEGA, FRICTION, RESTITUTION, WALL = 2.0, 0.25, 0.8, -0.3
OF_FORMULAS = 4e-15  # rounding of closed forms of some ωt = 12


@pytest.mark.parametrize(
    ("first", "later", "repeats", "seconds"),
    [
        pytest.param(0.004, (0.001,) * 7, 7, (0.001,) * 7, id="short: many, the first left out"),
        pytest.param(0.05, (0.04, 0.06), 7, (0.05, 0.04, 0.06), id="longer: three"),
        pytest.param(2.0, (2.1,), 7, (2.0, 2.1), id="slow twice: enough"),
        pytest.param(34.0, (0.0002, 0.0003), 7, (34.0, 0.0002, 0.0003), id="slow once: it was interrupted"),
        pytest.param(0.004, (), 1, (0.004,), id="once"),
        pytest.param(0.5, (0.001,), 1, (0.5, 0.001), id="once, but interrupted"),
    ],
)
def test_a_run_is_repeated(first: float, later: tuple[float, ...], repeats: int, seconds: tuple[float, ...]) -> None:
    remaining = iter(later)
    assert repeated(lambda: next(remaining), first, repeats) == seconds
    assert list(remaining) == []


def line(**parts: Any) -> dict[str, Any]:
    """A mass of 1 kg that starts from rest at x = 1 on a spring of 4 N/m, so that ω = 2, in a scene with more parts."""
    spring = {"kind": "potential", "name": "spring", "energy": "k*x^2/2"}
    found: dict[str, Any] = document({"x": (1.0, 0.0)}, {"m": 1.0, "k": OMEGA**2}, {"p": ("m", ["x", "0"])}, [spring])
    return found | {"loads": [*found["loads"], *parts.pop("loads", [])]} | parts


BOUNCES = line(events=[{"name": "wall", "value": "x + 0.3", "then": "bounce", "restitution": "0.8"}])
RUBS = line(loads=[{"kind": "friction", "name": "rubbing", "coordinate": "x", "force": "0.25*m"}])
BENDS = line(loads=[{"kind": "force", "name": "stop", "at": "p", "force": ["-3*k*min(x, 0)", "0"]}])


def bouncing(t: float) -> float:
    """Arcs A cos(ωs + φ) between impacts on the wall, each with e times the rate of the one before."""
    x, v, begin = 1.0, 0.0, 0.0
    while True:
        size, phase = math.hypot(x, v / OMEGA), math.atan2(-v / OMEGA, x)
        meets = math.acos(WALL / size)  # the first one falls onto the wall
        end = begin + (meets - phase) / OMEGA
        if t <= end:
            return size * math.cos(OMEGA * (t - begin) + phase)
        begin, x, v = end, WALL, RESTITUTION * OMEGA * size * math.sin(meets)


def rubbing(t: float) -> float:
    """Half periods about ±F/k: each swing is 2 F/k shorter, and the last one ends where the spring is too weak."""
    shift, half = FRICTION / OMEGA**2, math.pi / OMEGA
    turns = int(t / half)
    amplitude = 1.0 - 2.0 * shift * turns
    while amplitude <= shift and turns:  # it has stuck before
        turns, t = turns - 1, half * turns
        amplitude += 2.0 * shift
    side = (-1.0) ** turns
    return side * (shift + (amplitude - shift) * math.cos(OMEGA * (t - half * turns)))


def bending(t: float) -> float:
    """Half periods of ω for x > 0 and of 2ω for x < 0, where the spring is four times as strong."""
    up, down = math.pi / OMEGA, math.pi / (2.0 * OMEGA)
    s = (t + 0.5 * up) % (up + down)
    return math.sin(OMEGA * s) if s < up else -0.5 * math.sin(2.0 * OMEGA * (s - up))


MOTIONS = {"impacts": (BOUNCES, bouncing), "dry friction": (RUBS, rubbing), "kinks": (BENDS, bending)}
ORDERS = {"heun": 2, "rk4": 4, "gauss-4": 4, "dormand-prince-54": 5}


@pytest.mark.parametrize("name", MOTIONS)
def test_the_reference_goes_on_behind_events_as_closed_forms_do(name: str) -> None:
    scene, true = MOTIONS[name]
    found = reference(problem_of(read_scene(scene), 6.0))
    apart = np.abs(found.values[:, 0] - [true(t) for t in found.times])
    assert len(found.times) > 400
    assert (apart <= found.errors + OF_FORMULAS).all()
    assert found.errors.max() < 1e-12


@pytest.mark.parametrize("name", MOTIONS)
def test_methods_keep_their_order_behind_events(name: str) -> None:
    """Each event is found within the step: a step over a kink or a jump would leave an order of 1 or 2."""
    *_, last = get_experiment("convergence").run({"scene": MOTIONS[name][0], "t_end": 3.0, "methods": list(ORDERS)})
    found: dict[str, Any] = last.result["orders"]  # type: ignore[assignment]
    orders = {method: one["measured"] for method, one in found.items()}
    assert orders == pytest.approx(ORDERS, rel=0.15)
    assert last.result["events"] is True


def test_the_work_behind_events_is_charted() -> None:
    asked = {"scene": BOUNCES, "t_end": 2.0, "methods": ["rk4", "dop853"], "peers": True}
    *_, last = get_experiment("work-precision").run(asked)
    points: list[dict[str, Any]] = last.result["points"]  # type: ignore[assignment]
    for method in ("rk4", "dop853"):
        assert min(p["error"] for p in points if p["method"] == method and p["error"] is not None) < 1e-10
    assert {point["method"] for point in points} == {"rk4", "dop853"}
    assert all(point["time"] > 0.0 for point in points if point["status"] == "ok")
    assert last.result["peers_left_out"] is True
    assert last.result["events"] is True


@pytest.mark.parametrize(
    ("scene", "take_part"),
    [
        pytest.param(BOUNCES, False, id="they would run through a wall"),
        pytest.param(RUBS, False, id="they would not stick"),
        pytest.param(BENDS, True, id="a kink is only a harder force"),
    ],
)
def test_integrators_of_others_take_part_where_they_follow_the_same_motion(
    scene: dict[str, Any], *, take_part: bool
) -> None:
    problem = problem_of(read_scene(scene), 1.0, 5)
    tracks = [track.name for track in peer_tracks(problem, reference(problem))]
    assert ("scipy-DOP853" in tracks) is take_part
    assert bool(tracks) is take_part
