"""Friction brakes: a motion in which it would drive, or hold with less than it brakes with, ends there and says so."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
from tests.simulation.scenes import scene

from deltaq.lab.hybrid_flow import Allowance, HybridFlow
from deltaq.mechanics.jumps import frictions_of
from deltaq.mechanics.scene import Scene
from deltaq.model.modes import enumerated_bounds, modes_of
from deltaq.simulation.driver import simulate
from deltaq.simulation.kernels.motion import FINE
from deltaq.simulation.library import get_method
from deltaq.simulation.outcome import DRIVES
from deltaq.simulation.service import problem_of
from deltaq.simulation.trajectory import Trajectory

MU, G = 0.3, 9.81
OMEGA = math.sqrt(MU * G)


def sliding(force: str, rate: float, static: str | None = None, push: str = "0") -> Scene:
    friction = {"kind": "friction", "name": "R", "coordinate": "x", "force": force}
    loads = [friction | ({} if static is None else {"static": static})]
    loads.append({"kind": "force", "name": "push", "at": "block", "force": [push, "0"]})
    return scene({"x": (0.0, rate)}, {"m": 1.0, "mu": MU, "g": G}, {"block": ("m", ["x", "0"])}, loads)


def run(found: Scene, t_end: float, method: str, tolerance: float) -> Trajectory:
    return simulate(problem_of(found, t_end, 201), get_method(method), tolerance=tolerance)


def lifting(time: float) -> float:
    """x of ẍ = −μ g (1 − x), x(0) = 0, ẋ(0) = 3."""
    return 1.0 - math.cosh(OMEGA * time) + 3.0 / OMEGA * math.sinh(OMEGA * time)


ENDING = [  # the force, the rate at first, when it comes to zero, and the motion up to then
    pytest.param("1 - t", 0.0, 1.0, lambda t: 0.0, id="at rest"),
    pytest.param("1 - t", 2.0, 1.0, lambda t: 2.0 * t - t**2 / 2.0 + t**3 / 6.0, id="while it slips"),
    pytest.param("1 - t^3", 0.5, 1.0, None, id="after it has come to rest"),
    pytest.param("mu*m*g*(1 - x)", 3.0, math.atanh(OMEGA / 3.0) / OMEGA, lifting, id="a normal force that lifts off"),
    pytest.param("mu*m*g*cos(20*t)", 1.0, math.pi / 40.0, None, id="a bound that swings"),
]


@pytest.mark.parametrize("method", ["dormand-prince-54", "taylor", "radau-5"])
@pytest.mark.parametrize(("force", "rate", "end", "motion"), ENDING)
def test_a_motion_ends_where_its_friction_would_drive_it(
    method: str, force: str, rate: float, end: float, motion: Callable[[float], float] | None
) -> None:
    found = run(sliding(force, rate), 3.0, method, 1e-9)
    assert (found.outcome.status, found.outcome.code) == ("unresolved", "friction_negative")
    assert dict(found.outcome.parameters)["name"] == "R"
    assert found.reached == pytest.approx(end, abs=1e-8)
    assert found.times[-1] <= found.reached
    assert not any(each.kind == "slip" for each in found.transitions)
    if motion is not None:
        assert found.values[:, 0] == pytest.approx([motion(t) for t in found.times], abs=1e-8)


@pytest.mark.parametrize("force", ["mu*max(m*g*(1 - x), 0)", "max(mu*m*g*(1 - x), 0)", "max(0, mu*m*g*(1 - x))/1"])
def test_friction_that_ends_with_its_normal_force_lets_the_body_go(force: str) -> None:
    found = run(sliding(force, 3.0), 3.0, "dormand-prince-54", 1e-9)
    end = math.atanh(OMEGA / 3.0) / OMEGA
    rate = -OMEGA * math.sinh(OMEGA * end) + 3.0 * math.cosh(OMEGA * end)
    assert found.outcome.status == "ok"
    assert found.values[-1, 0] == pytest.approx(1.0 + rate * (3.0 - end), abs=1e-7)


def test_friction_that_only_touches_zero_goes_on() -> None:
    """ẍ = −(1 + cos t): 5 t − t²/2 + cos t − 1, with a bound that comes to zero and grows again at π."""
    found = run(sliding("1 + cos(t)", 5.0), 4.0, "dormand-prince-54", 1e-9)
    assert found.outcome.status == "ok"
    assert found.values[-1, 0] == pytest.approx(20.0 - 8.0 + math.cos(4.0) - 1.0, abs=1e-7)


@pytest.mark.parametrize("method", ["dormand-prince-54", "taylor"])
def test_what_stops_where_nothing_could_hold_it_ends_there(method: str) -> None:
    """It stops after v/(μ g), where F₀ has fallen below F."""
    found = run(sliding("mu*m*g", 1.0, static="mu*m*g*(1.2 - t)"), 1.1, method, 1e-9)
    assert (found.outcome.status, found.outcome.code) == ("unresolved", "static_below_kinetic")
    assert found.reached == pytest.approx(1.0 / (MU * G), abs=1e-8)
    fine = run(sliding("mu*m*g", 1.0, static="mu*m*g*(1.4 - t)"), 0.39, method, 1e-9)
    assert fine.outcome.status == "ok"
    assert [each.kind for each in fine.transitions] == ["stick"]


def test_motions_of_labs_end_there_as_well() -> None:
    found = sliding("mu*m*g*(1 - t)", 0.0)
    modes = modes_of(found)
    assert modes is not None
    flow = HybridFlow(problem_of(found, 3.0), 1, 0.1, np.zeros(1, dtype=np.int64), np.full(3, 1e-6), modes, Allowance())
    ends = {t: flow.run(MU, np.zeros(2), np.array([0.0, t])).result.outcome for t in (0.9, 1.1)}
    assert ends == {0.9: FINE, 1.1: DRIVES}


@pytest.mark.parametrize(
    ("force", "watched"),
    [
        ("mu*m*g", 0),
        ("mu*m*g*x^2", 0),
        ("mu*m*g*abs(dot(x))/2", 0),
        ("mu*max(m*g*(1 - x), 0)", 0),
        ("mu*m*g*exp(-x)*sqrt(1 + x)", 0),
        ("1 + x^2", 0),
        ("1 - x^2", 1),
        ("mu*m*g*x", 1),
        ("mu*m*g*x^3 + 1", 1),
        ("mu*m*g*min(1, 2 - x)", 1),
        ("2 + cos(x)", 1),
    ],
)
def test_what_can_never_be_negative_is_not_watched(force: str, watched: int) -> None:
    found = sliding(force, 1.0)
    assert len([*enumerated_bounds(found, frictions_of(found))]) == watched
