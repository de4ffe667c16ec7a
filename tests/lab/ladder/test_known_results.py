"""Rungs whose error, or whose motion, is known beforehand."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from tests.lab.ladder.climbing import Climbed, climbed

from deltaq.mechanics.changes import change
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene
from deltaq.mechanics.scene import Scene
from deltaq.simulation.driver import simulate
from deltaq.simulation.library import get_method
from deltaq.simulation.service import problem_of


def starting(scene: Scene, **values: float) -> Scene:
    """The scene with other initial values, at rest."""
    coordinates = tuple(
        replace(each, value=values[each.name], rate=0.0, min=None, max=None) if each.name in values else each
        for each in scene.coordinates
    )
    return replace(scene, coordinates=coordinates)


def scene_of(found: Climbed, rung: str) -> Scene:
    document = next(each.scene for each in found.ladder.rungs if each.id == rung)
    assert document is not None
    return read_scene(document)


def ratios(errors: list[float]) -> list[float]:
    return [b / a for a, b in pairwise(errors)]


def test_the_error_of_a_rigid_spring_is_inverse_to_its_stiffness() -> None:
    """The elastic pendulum, from the length at rest: each ten times stiffer spring leaves a tenth of the error."""
    errors = []
    for k in (1e4, 1e5, 1e6):
        scene = change(load_scene("elastic-pendulum"), parameters={"k": k})
        errors.append(climbed(starting(scene, y=9.81 / k), 4.0).largest("rigid:suspension"))
    assert ratios(errors) == pytest.approx([0.1, 0.1], rel=0.1)


def test_the_error_of_a_rigid_tyre_is_inverse_to_its_stiffness() -> None:
    """The tyre is a potential, and its other end is guided: the wheel then follows the road, from the start."""
    scene = load_scene("quarter-car")
    rolling = tuple(replace(each, rate=0.16) if each.name == "z1" else each for each in scene.coordinates)
    scene = replace(scene, coordinates=rolling)
    errors = [climbed(change(scene, parameters={"k1": k}), 4.0).largest("rigid:tyre") for k in (1e7, 1e8)]
    assert ratios(errors) == pytest.approx([0.1], rel=0.1)


def test_the_error_of_a_rigid_suspension_is_inverse_to_its_stiffness() -> None:
    """Wheel and body become one; the way back finds the coordinate that was given up."""
    scene = starting(load_scene("quarter-car"), z1=0.02, z2=0.02)
    errors = [climbed(change(scene, parameters={"k2": k}), 4.0).largest("rigid:spring") for k in (1e7, 1e8)]
    assert ratios(errors) == pytest.approx([0.1], rel=0.1)


def test_the_linearized_pendulum_has_the_frequency_of_small_oscillations() -> None:
    found = climbed(load_scene("pendulum"), 3.0)
    scene = scene_of(found, "linearized")
    motion = simulate(problem_of(scene, 3.0), get_method("dop853"), tolerance=1e-10)
    length = next(each.value for each in scene.parameters if each.name == "l")
    start = scene.coordinates[0].value
    assert motion.values[:, 0] == pytest.approx(start * np.cos(math.sqrt(9.81 / length) * motion.times), abs=1e-9)


def test_the_linearized_pendulum_errs_by_the_cube_of_the_amplitude_and_the_time() -> None:
    """ω = ω₀ (1 − φ₀²/16): the phase is wrong by φ₀² ω₀ t/16, the angle by φ₀ times that (Landau, Lifshitz, §11)."""
    scene, angle, span = change(load_scene("pendulum"), parameters={"l": 1.0}), 0.1, 20.0
    found = climbed(starting(scene, phi=angle), span, (0.2, 0.5, 1.0))
    phase = angle**2 / 16 * math.sqrt(9.81) * span
    assert found.largest("linearized") == pytest.approx(angle * phase, rel=0.05)
    assert found.growth["linearized"].slope == pytest.approx(2.0, abs=0.02)


@pytest.mark.parametrize(
    ("identifier", "rung"),
    [
        pytest.param("spherical-pendulum", "cyclic:psi", id="spherical pendulum"),
        pytest.param("bead-on-free-hoop", "cyclic:psi", id="free hoop"),
        pytest.param("heavy-top", "cyclic:psi,phi", id="two cyclic angles that share a momentum"),
        pytest.param("cart-pendulum", "cyclic:x", id="displacement, seen from the centre of mass"),
    ],
)
def test_routh_is_exact(identifier: str, rung: str) -> None:
    found = climbed(load_scene(identifier), 10.0, (0.5, 1.0))
    full, reduced = (next(each for each in found.ladder.rungs if each.id == name) for name in ("full", rung))
    assert found.relative(rung) < 1e-8
    assert reduced.degrees == full.degrees - len(rung.split(","))
    assert found.least.rung == rung


def test_routh_is_exact_while_the_whole_system_drifts() -> None:
    scene = load_scene("cart-pendulum")
    moving = tuple(replace(each, rate=1.5) for each in scene.coordinates)
    assert climbed(replace(scene, coordinates=moving), 10.0).relative("cyclic:x") < 1e-8


def test_the_effective_potential_of_the_spherical_pendulum() -> None:
    """p²/(2 m ℓ² sin² ϑ) with p = m ℓ² sin² ϑ₀ ψ̇₀ (Landau, Lifshitz, §14, problem 1)."""
    scene = scene_of(climbed(load_scene("spherical-pendulum"), 1.0), "cyclic:psi")
    energy = next(load for load in scene.loads if load.name == "centrifugal")
    momentum = next(each for each in scene.parameters if each.name == "p_psi")
    assert energy.energy.text == "(1/2)*p_psi^2/(l^2*m*sin(theta)^2)"
    assert momentum.value == pytest.approx(math.sin(0.9) ** 2 * 2.0)


def test_a_steady_motion_is_exact_with_the_angle_held() -> None:
    """The conical pendulum: θ stays as it is by itself, so that holding it changes nothing."""
    found = climbed(load_scene("conical-pendulum"), 5.0)
    assert found.relative("frozen:theta") < 1e-9
    assert found.relative("guided:psi") < 1e-9
    assert found.relative("frozen:psi") > 1.0
    assert found.least.rung == "frozen:theta"


def test_the_elastic_pendulum_with_its_pivot_held_is_the_pendulum() -> None:
    scene = change(load_scene("elastic-pendulum"), parameters={"F0": 0.0, "l": 0.8})
    held = scene_of(climbed(starting(scene, phi=0.7), 1.0), "frozen:y")
    plain = starting(change(load_scene("pendulum"), parameters={"l": 0.8}), phi=0.7)
    motions = [simulate(problem_of(each, 5.0), get_method("dop853"), tolerance=1e-10) for each in (held, plain)]
    assert motions[0].values == pytest.approx(motions[1].values, abs=1e-9)


def test_the_error_without_damping_is_proportional_to_the_damping() -> None:
    scene = load_scene("damped-pendulum")
    errors = [climbed(change(scene, parameters={"c": c}), 5.0).largest("undamped") for c in (1e-4, 2e-4, 4e-4)]
    assert ratios(errors) == pytest.approx([2.0, 2.0], rel=0.01)


def test_the_error_of_a_point_mass_falls_with_the_square_of_the_size() -> None:
    """A disc of radius r on a massless rod: J/(m ℓ²) = r²/(2 ℓ²) of the inertia is left out."""
    errors = [climbed(disc(radius), 4.0).largest("point-mass") for radius in (0.02, 0.04, 0.08)]
    assert ratios(errors) == pytest.approx([4.0, 4.0], rel=0.05)


def disc(radius: float) -> Scene:
    return read_scene(
        {
            "coordinates": [{"name": "phi", "value": 0.5, "unit": "rad"}],
            "parameters": [
                {"name": "m", "value": 2.0, "unit": "kg"},
                {"name": "r", "value": radius, "unit": "m"},
                {"name": "l", "value": 1.0, "unit": "m"},
                {"name": "g", "value": 9.81, "unit": "m/s^2"},
            ],
            "bodies": [
                {
                    "name": "disc",
                    "kind": "rigid",
                    "mass": "m",
                    "inertia": "m*r^2/2",
                    "angle": "phi",
                    "position": ["l*sin(phi)", "-l*cos(phi)"],
                }
            ],
            "loads": [{"kind": "gravity", "name": "weight", "acceleration": ["0", "-g"]}],
        }
    )
