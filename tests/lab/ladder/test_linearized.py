"""Linearized scenes have the eigenvalues of the full ones, and go on like them as long as amplitudes are small."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

from deltaq.lab.ladder.building import simplified
from deltaq.lab.ladder.centre import centre_of
from deltaq.lab.ladder.distance import Yardstick
from deltaq.lab.ladder.findings import Part
from deltaq.lab.ladder.mean import Mean
from deltaq.lab.ladder.measurement import deviation, full_run, run_rung, seen, yardstick
from deltaq.lab.ladder.simplification import SimplificationContext
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.mechanics.scene import Scene
from deltaq.model.linear_laws import is_linear
from deltaq.simulation.service import problem_of
from deltaq.simulation.stiffness import eigenvalues

LINEARIZED = (Part("linearized", {}),)
SPAN, SMALL = 3.0, 1e-3


def motion(scene: Scene) -> Yardstick:
    return yardstick(full_run(scene, SPAN, np.zeros(1, dtype=np.int64)))


def context(scene: Scene) -> SimplificationContext:
    run = full_run(scene, SPAN, np.zeros(1, dtype=np.int64))
    centre = centre_of(scene, yardstick(run))
    return SimplificationContext(scene, centre.values if centre else {}, Mean.of(scene, SPAN), seen(run))


def has_rest(found: SimplificationContext) -> bool:
    return all(each.name in found.centre for each in found.scene.free) and not found.scene.guides


@pytest.fixture(scope="module")
def resting() -> dict[str, SimplificationContext]:
    """Every scene with a position of rest."""
    every = {identifier: context(load_scene(identifier)) for identifier in scene_ids()}
    return {identifier: found for identifier, found in every.items() if has_rest(found)}


def test_most_scenes_have_rest(resting: dict[str, SimplificationContext]) -> None:
    assert len(resting) >= 12


def test_eigenvalues_are_those_of_the_full_scene_at_rest(resting: dict[str, SimplificationContext]) -> None:
    wrong = {identifier: pair for identifier, full in resting.items() for pair in _eigenvalues(full)}
    assert wrong == {}


def _eigenvalues(full: SimplificationContext) -> Iterator[tuple[list[complex], list[complex]]]:
    """Those of the full scene at rest and of the linearized one, if they differ."""
    rest = np.array([full.centre[each.name] for each in full.scene.free])
    state = np.concatenate([rest, np.zeros(len(rest))])
    expected, found = (
        np.sort_complex(np.round(eigenvalues(problem_of(scene, SPAN), 0.0, state), 5))
        for scene in (full.scene, simplified(full, LINEARIZED).scene)
    )
    if found != pytest.approx(expected, rel=1e-4, abs=2e-4 * np.abs(expected).max()):
        yield expected.tolist(), found.tolist()


@pytest.mark.parametrize(
    "identifier", [pytest.param(name, id=name) for name in ("guided-pendulum", "kapitza", "bead-on-rotating-hoop")]
)
def test_driven_scenes_too_are_right_for_small_amplitudes(identifier: str) -> None:
    """With guides, what their accelerations do to small deviations belongs to the stiffness: Kapitza's pendulum."""
    scene = load_scene(identifier)
    centre = centre_of(scene, motion(scene))
    assert centre is not None
    small = context(scene).with_scene(centre.at(SMALL))
    flag = np.zeros(1, dtype=np.int64)
    below = simplified(small, LINEARIZED)
    found = deviation(yardstick(run_rung(small.scene, SPAN, flag)), run_rung(below.scene, SPAN, flag), below.back)
    assert found is not None
    assert found.relative is not None
    assert found.relative < 2 * SMALL


def test_what_is_linear_already_is_not_linearized() -> None:
    linear = {identifier for identifier in scene_ids() if is_linear(load_scene(identifier))}
    assert {"two-mass-oscillator", "quarter-car", "wilberforce", "foucault"} <= linear
    assert {"pendulum", "elastic-pendulum", "kapitza"}.isdisjoint(linear)


def test_follower_and_gyroscopic_forces_become_forces_along_the_coordinates() -> None:
    """ẍ = −x − x³ + b ẏ + c y, ÿ = −y − b ẋ − c x, with c skew in the positions and b in the rates."""
    scene = read_scene(
        {
            "coordinates": [{"name": name, "value": 0.1, "unit": "m"} for name in ("x", "y")],
            "parameters": [
                {"name": "m", "value": 1.0, "unit": "kg"},
                {"name": "k", "value": 1.0, "unit": "N/m"},
                {"name": "k3", "value": 1.0, "unit": "N/m^3"},
                {"name": "b", "value": 0.3, "unit": "N s/m"},
                {"name": "c", "value": 0.2, "unit": "N/m"},
            ],
            "bodies": [{"name": "bob", "kind": "particle", "mass": "m", "position": ["x", "y"]}],
            "loads": [
                {"kind": "potential", "name": "well", "energy": "k*(x^2 + y^2)/2 + k3*x^4/4"},
                {"kind": "force", "name": "skew", "at": "bob", "force": ["b*dot(y) + c*y", "-b*dot(x) - c*x"]},
            ],
        }
    )
    found = simplified(context(scene), LINEARIZED).scene
    forces = {load.name: tuple(part.text for part in load.force) for load in found.loads if load.kind == "force"}
    assert {load.name for load in found.loads} == {"restoring", "along_x", "along_y"}
    assert forces == {"along_x": ("c*y + b*dot(y)", "0"), "along_y": ("(-c)*x + (-b)*dot(x)", "0")}
