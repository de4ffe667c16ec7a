"""Rungs whose error is known beforehand."""

from __future__ import annotations

import pytest
from tests.lab.ladder.climbing import climbed

from deltaq.mechanics.changes import change
from deltaq.mechanics.library import load_scene


def test_a_steady_motion_is_exact_with_the_angle_held() -> None:
    """The conical pendulum: θ stays as it is by itself, so that holding it changes nothing."""
    found = climbed(load_scene("conical-pendulum"), 5.0)
    assert found.relative("frozen:theta") < 1e-9
    assert found.relative("guided:psi") < 1e-9
    assert found.relative("frozen:psi") > 1.0
    assert found.least.rung == "frozen:theta"


def test_the_error_without_damping_is_proportional_to_the_damping() -> None:
    scene = load_scene("damped-pendulum")
    errors = [climbed(change(scene, parameters={"c": c}), 5.0).largest("undamped") for c in (1e-4, 2e-4, 4e-4)]
    assert [error / errors[0] for error in errors] == pytest.approx([1.0, 2.0, 4.0], rel=0.01)
