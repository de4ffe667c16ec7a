"""Units of multipliers and of what holds a length, as textbooks give them."""

from __future__ import annotations

import tomllib

import pytest

from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene
from deltaq.mechanics.reaction_units import reaction_unit


def bead(unit_x: str, unit_y: str, equation: str, mass: str = "kg") -> str:
    return f"""format = 1
id = "bead"
title = {{ de = "Perle", en = "Bead" }}
dimension = 2
coordinates = [{{ name = "x", unit = "{unit_x}" }}, {{ name = "y", unit = "{unit_y}" }}]
parameters = [{{ name = "m", unit = "{mass}", value = 1.0 }}, {{ name = "a", unit = "m", value = 1.0 }}]
bodies = [{{ name = "bead", kind = "particle", mass = "m", position = ["x", "y"] }}]
constraints = [{{ name = "track", kind = "equation", equation = "{equation}" }}]
"""


@pytest.mark.parametrize(
    ("scene", "name", "unit"),
    [
        pytest.param("cartesian-pendulum", "S", "N", id="a rod between places: its force"),
        pytest.param("chaplygin-sleigh", "lambda", "N", id="a blade, by velocities: its force across"),
        pytest.param("four-bar", "lambda_x", "N", id="a joint, by a component of its place: a force"),
        pytest.param("rolling-disc-in-space", "lambda_x", "N", id="rolling, by velocities: the force at the contact"),
        pytest.param("pendulum", "l", "N", id="a length: the force of its string"),
        pytest.param("kapitza", "y", "N", id="a guide of a length: a force"),
        pytest.param("foucault", "psi", "N m", id="a guide of an angle: a moment"),
    ],
)
def test_of_built_in_scenes(scene: str, name: str, unit: str) -> None:
    assert reaction_unit(load_scene(scene), name) == unit


@pytest.mark.parametrize(
    ("document", "unit"),
    [
        pytest.param(bead("m", "m", "x^2 + y^2 = a^2"), "N/m", id="an area: a force by length"),
        pytest.param(bead("m", "m", "sin(x/a) = y/a"), "N m", id="a number: an energy"),
        pytest.param(bead("m", "m", "x*dot(y) = y*dot(x)"), "N/m", id="an area by time"),
        pytest.param(bead("m", "m", "x = 2"), "N", id="a length, a bare number beside it"),
        pytest.param(bead("", "m", "x = y"), "N", id="a coordinate without unit beside one that has one"),
        pytest.param(bead("", "", "x = y"), "", id="coordinates without units"),
        pytest.param(bead("m", "m", "x = y", mass=""), "", id="no mass has a unit"),
    ],
)
def test_of_equations(document: str, unit: str) -> None:
    scene = read_scene(tomllib.loads(document))
    assert reaction_unit(scene, scene.multipliers[0].name) == unit
