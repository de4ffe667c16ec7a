"""Constraints on rates against published solutions: the disc that rolls in space, and a trailer behind a car.

Sources: Routh, Advanced Rigid Dynamics, §§241–244; Neimark, Fufaev, Dynamics of Nonholonomic Systems, ch. II–III
(rolling disc); Bloch, Nonholonomic Mechanics and Control, ch. 1 (sleigh, in `test_constraints`; disc); Laumond, Robot
Motion Planning and Control, ch. 1 (car with trailers).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from deltaq.derivation.engine import derive
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene
from deltaq.mechanics.scene import Scene
from deltaq.simulation.driver import simulate
from deltaq.simulation.library import get_method
from deltaq.simulation.problem import Floats
from deltaq.simulation.service import problem_of
from deltaq.simulation.trajectory import Trajectory

M, R, G = 1.0, 0.5, 9.81  # of the scene
ACROSS, AXIAL = M * R**2 / 4, M * R**2 / 2  # a thin disc


def rolling(lean: float, turning: float, spin: float, leaning: float = 0.0) -> Scene:
    """The disc of the library with θ, ψ̇, φ̇ and θ̇ given, heading along x."""
    begun = {"x": (0, R * spin), "y": (0, 0), "psi": (0, turning), "theta": (lean, leaning), "phi": (0, spin)}
    scene = load_scene("rolling-disc-in-space")
    coordinates = (
        replace(each, value=float(begun[each.name][0]), rate=float(begun[each.name][1])) for each in scene.coordinates
    )
    return replace(scene, coordinates=tuple(coordinates))


def moved(scene: Scene, t_end: float) -> Trajectory:
    found = simulate(problem_of(scene, t_end, 201), get_method("dop853"), tolerance=1e-12)
    assert found.reached == t_end
    return found


def test_a_disc_rolls_steadily_in_a_circle() -> None:
    """(C + mR²) Ω ω₃ cos θ − A Ω² sin θ cos θ + mgR sin θ = 0 with ω₃ = φ̇ + Ω sin θ; its friction is centripetal."""
    lean, turning = 0.3, -1.1
    axial = (ACROSS * turning**2 * np.cos(lean) - M * G * R) * np.tan(lean) / ((AXIAL + M * R**2) * turning)
    found = moved(rolling(lean, turning, axial - turning * np.sin(lean)), 10.0)
    heading = turning * found.times
    radius = R * (axial - turning * np.sin(lean)) / turning
    assert np.abs(found.values[:, 3] - lean).max() < 1e-9
    assert np.abs(found.values[:, 2] - heading).max() < 1e-9
    assert np.abs(found.values[:, 0] - radius * np.sin(heading)).max() < 1e-9
    assert np.abs(found.values[:, 1] - radius * (1 - np.cos(heading))).max() < 1e-9
    assert found.reactions is not None
    force = M * R * turning * axial * np.column_stack([-np.sin(heading), np.cos(heading)])
    assert np.abs(found.reactions.multipliers - force).max() < 1e-9


@pytest.mark.parametrize("share", [1.05, 0.95])
def test_an_upright_disc_stays_up_above_its_critical_spin(share: float) -> None:
    """φ̇² > AmgR/(C(C + mR²)) = g/(3R): a lean swings at ω² = (C(C + mR²)φ̇²/A − mgR)/(A + mR²), below it grows."""
    critical, lean = G / (3 * R), 1e-5
    spin = np.sqrt(share * critical)
    square = (AXIAL * (AXIAL + M * R**2) * spin**2 / ACROSS - M * G * R) / (ACROSS + M * R**2)
    assert np.sign(square) == np.sign(share - 1.0)
    found = moved(rolling(lean, -AXIAL * spin / ACROSS * lean, spin), 2.0)
    known = lean * np.cos(np.emath.sqrt(square) * found.times).real
    assert np.abs(found.values[:, 3] - known).max() < 1e-9
    assert np.abs(found.rates[:, 2] + AXIAL * spin / ACROSS * known).max() < 1e-9


def newton_euler(lean: float, turning: float, spin: float, times: Floats) -> Floats:
    """θ, θ̇, ψ̇, φ̇ of the disc by Newton's and Euler's laws: shape (4, samples).

    In the frame e₁ horizontal, e₂ from the contact to the centre, e₃ the axle, with ω and dH/dt = −R e₂ × F,
    F = m dv/dt + mg ẑ, v = ω × R e₂.
    """
    arm = np.array([0.0, R, 0.0])
    inertia = np.diag([ACROSS, ACROSS, AXIAL])

    def rhs(_time: float, state: Floats) -> Floats:
        angle, omega = state[0], state[1:]
        frame = np.array([omega[0], omega[1], omega[1] * np.tan(angle)])
        up = np.array([0.0, np.cos(angle), np.sin(angle)])
        speed = np.cross(omega, arm)
        # (J + m[R][R]ᵀ) ω̇ = −ω_f × Jω − R e₂ × m(ω_f × v) − R e₂ × mg ẑ
        columns = [np.cross(arm, M * np.cross(unit, arm)) for unit in np.eye(3)]
        right = -np.cross(frame, inertia @ omega) - np.cross(arm, M * np.cross(frame, speed) + M * G * up)
        return np.array([-omega[0], *np.linalg.solve(inertia + np.column_stack(columns), right)])

    start = [lean, 0.0, turning * np.cos(lean), spin + turning * np.sin(lean)]
    found = solve_ivp(rhs, (0.0, times[-1]), start, "DOP853", times, rtol=1e-13, atol=1e-13).y
    turns = found[2] / np.cos(found[0])
    return np.array([found[0], -found[1], turns, found[3] - turns * np.sin(found[0])])


def test_a_disc_wobbles_as_newton_and_euler_say() -> None:
    found = moved(rolling(0.4, 0.7, 5.0), 4.0)
    known = newton_euler(0.4, 0.7, 5.0, found.times)
    assert np.ptp(known[0]) > 0.3  # it is no steady motion
    seen = np.array([found.values[:, 3], found.rates[:, 3], found.rates[:, 2], found.rates[:, 4]])
    assert np.abs(seen - known).max() < 1e-9


def trailer(angle: float, speed: float) -> Scene:
    """A car driven along x whose rear axle bears the hitch, and a trailer whose axle is d behind it."""
    return read_scene(
        {
            "id": "trailer",
            "coordinates": [
                {"name": "x", "unit": "m"},
                {"name": "y", "unit": "m"},
                {"name": "phi", "unit": "rad"},
                {"name": "psi", "unit": "rad", "value": angle, "rate": -speed / 1.6 * np.sin(angle)},
            ],
            "parameters": [
                {"name": "M", "unit": "kg", "value": 3.0},
                {"name": "J", "unit": "kg m^2", "value": 0.8},
                {"name": "a", "unit": "m", "value": 0.5},
                {"name": "m", "unit": "kg", "value": 2.0},
                {"name": "I", "unit": "kg m^2", "value": 0.4},
                {"name": "d", "unit": "m", "value": 1.6},
                {"name": "v", "unit": "m/s", "value": speed, "positive": False},
            ],
            "bodies": [
                {"name": "car", "kind": "rigid", "mass": "M", "inertia": "J", "angle": "phi"}
                | {"position": ["x + a*cos(phi)", "y + a*sin(phi)"]},
                {"name": "trailer", "kind": "rigid", "mass": "m", "inertia": "I", "angle": "psi"}
                | {"position": ["x - d*cos(psi)", "y - d*sin(psi)"]},
            ],
            "guides": [{"coordinate": "x", "value": "v*t"}],
            "constraints": [
                {"name": "rear", "kind": "equation", "equation": "dot(x)*sin(phi) - dot(y)*cos(phi) = 0"},
                {"name": "axle", "kind": "equation"}
                | {"equation": "dot(x)*sin(psi) - dot(y)*cos(psi) + d*dot(psi) = 0"},
            ],
        }
    )


@pytest.mark.parametrize("speed", [1.2, -0.8], ids=["pulled", "pushed"])
def test_a_trailer_follows_the_tractrix(speed: float) -> None:
    """tan ψ/2 = tan ψ₀/2 · e^{−vt/d}; its axle is pushed across by (md² + I) ψ̈/d, ψ̈ = (v/d)² sin ψ cos ψ."""
    start, length, mass, inertia = 0.9, 1.6, 2.0, 0.4
    found = moved(trailer(start, speed), 3.0)
    angle = 2 * np.arctan(np.tan(start / 2) * np.exp(-speed * found.times / length))
    assert np.abs(found.values[:, -1] - angle).max() < 1e-9
    assert np.abs(found.values[:, :2]).max() < 1e-9  # y and φ: the car runs straight
    assert found.reactions is not None
    bend = (speed / length) ** 2 * np.sin(angle) * np.cos(angle)
    assert np.abs(found.reactions.multipliers[:, 1] - (mass * length**2 + inertia) * bend / length).max() < 1e-8


def test_a_trailer_is_derived_with_every_step_verified() -> None:
    _, derivation = derive(trailer(0.9, 1.2))
    assert all(step.verified for step in derivation.steps())
