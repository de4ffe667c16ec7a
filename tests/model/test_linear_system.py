"""M, f, A and γ in their places: behind M and f the power of a damper may come before the constraints."""

from __future__ import annotations

import numpy as np
import pytest
from tests.simulation.scenes import get_scene

from deltaq.mechanics.document import read_scene
from deltaq.mechanics.writing import write_scene
from deltaq.model.model import Model, compile_model

MASS, LENGTH, GRAVITY, DAMPING = 2.0, 1.5, 9.81, 0.3


def pendulum(*, is_damped: bool) -> Model:
    document = write_scene(get_scene("cartesian-pendulum"))
    if is_damped:
        document["parameters"] = [*document["parameters"], {"name": "d", "unit": "N*s/m", "value": DAMPING}]
        drag = {"kind": "dissipation", "name": "drag", "function": "d*(dot(x)^2 + dot(y)^2)/2"}
        document["loads"] = [*document["loads"], drag]
    return compile_model(read_scene(document))


@pytest.mark.parametrize("is_damped", [False, True], ids=["without power", "with power"])
def test_a_pendulum_in_x_and_y(is_damped: bool) -> None:
    """On the circle, at the angle α with the rate ω: A is along (x, y), and A q̈ = γ is q̈ towards the pivot, lω²."""
    angles, omega = np.array([0.3, 2.0, -1.1]), np.array([0.7, -2.0, 0.0])
    place = LENGTH * np.column_stack([np.cos(angles), np.sin(angles)])
    rates = omega[:, None] * np.column_stack([-place[:, 1], place[:, 0]])
    parameters = np.tile([MASS, LENGTH, GRAVITY, DAMPING][: 4 if is_damped else 3], (3, 1))
    system = pendulum(is_damped=is_damped).system(np.hstack([place, rates, np.zeros((3, 1)), parameters]))
    np.testing.assert_array_equal(system.mass, np.tile(MASS * np.eye(2), (3, 1, 1)))
    drag = DAMPING * rates if is_damped else np.zeros_like(rates)
    np.testing.assert_allclose(system.forces, [0.0, MASS * GRAVITY] - drag, rtol=1e-14)
    assert system.rows.shape == (3, 1, 2)
    assert system.gamma.shape == (3, 1)
    inwards = -place / LENGTH
    along = np.einsum("smn,sn->sm", system.rows, inwards)
    np.testing.assert_allclose(np.abs(along[:, 0]), np.linalg.norm(system.rows[:, 0], axis=1), rtol=1e-14)
    np.testing.assert_allclose(system.gamma / along, (LENGTH * omega**2)[:, None], rtol=1e-13)
