"""Which simplifications are offered for which scenes, and what they make of them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import cast

import pytest
from tests.lab.ladder.climbing import climbed

from deltaq.lab.ladder.building import kinds
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene
from deltaq.mechanics.scene import Scene
from deltaq.mechanics.writing import write_scene
from deltaq.narration.catalog import LANGUAGES, text


def line(*loads: Mapping[str, object], coordinates: str = "x") -> Scene:
    """Particles on a line."""
    return read_scene(
        {
            "coordinates": [{"name": name, "value": 0.3} for name in coordinates],
            "parameters": [{"name": "m", "value": 1.0}, {"name": "k", "value": 3.0}, {"name": "c", "value": 0.2}],
            "bodies": [
                {"name": f"b{name}", "kind": "particle", "mass": "m", "position": [name, "0"]} for name in coordinates
            ],
            "loads": list(loads),
        }
    )


def rungs(scene: Scene) -> set[str]:
    return {rung.id for rung in climbed(scene, 0.5).ladder.rungs}


SPRING = {"kind": "potential", "name": "well", "energy": "k*x^2/2"}


@pytest.mark.parametrize(
    ("identifier", "expected"),
    [
        pytest.param(
            "elastic-pendulum",
            {"frozen:y", "frozen:phi", "rigid:suspension", "linearized", "rigid:suspension+linearized"},
            id="elastic pendulum",
        ),
        pytest.param("double-pendulum", {"frozen:phi1", "frozen:phi2", "linearized"}, id="double pendulum"),
        pytest.param(
            "spherical-pendulum",
            {"cyclic:psi", "cyclic:psi+linearized", "frozen:theta", "frozen:psi", "guided:psi"},
            id="spherical pendulum: no rest to linearize about, but a steady motion",
        ),
        pytest.param(
            "quarter-car",
            {"frozen:z1", "frozen:z2", "rigid:tyre", "rigid:spring", "undamped"}
            | {"undamped+rigid:tyre", "undamped+rigid:spring"},
            id="quarter car: linear as it is",
        ),
        pytest.param("physical-pendulum", {"point-mass", "linearized"}, id="rod"),
        pytest.param("damped-pendulum", {"undamped", "linearized", "undamped+linearized"}, id="damped pendulum"),
        pytest.param("atwood", {"point-mass"}, id="no rest at all"),
    ],
)
def test_rungs_of_a_scene(identifier: str, expected: set[str]) -> None:
    assert rungs(load_scene(identifier)) == {"full", *expected}


@pytest.mark.parametrize(
    ("load", "is_damping"),
    [
        pytest.param({"kind": "dissipation", "name": "f", "function": "c*dot(x)^2/2"}, True, id="Rayleigh"),
        pytest.param({"kind": "force", "name": "f", "at": "bx", "force": ["-c*dot(x)", "0"]}, True, id="linear drag"),
        pytest.param(
            {"kind": "force", "name": "f", "at": "bx", "force": ["-c*dot(x)*abs(dot(x))", "0"]}, True, id="air drag"
        ),
        pytest.param({"kind": "force", "name": "f", "at": "bx", "force": ["c*dot(x)", "0"]}, False, id="feeds energy"),
        pytest.param(
            {"kind": "force", "name": "f", "at": "bx", "force": ["c*dot(x)*(1 - 30*x^2)", "0"]}, False, id="van der Pol"
        ),
        pytest.param({"kind": "force", "name": "f", "at": "bx", "force": ["-c*(1 + dot(x))", "0"]}, False, id="a push"),
        pytest.param({"kind": "force", "name": "f", "at": "bx", "force": ["-c*x", "0"]}, False, id="no rate"),
        pytest.param({"kind": "moment", "name": "f", "angle": "x", "moment": "-c*dot(x)^3"}, True, id="moment"),
        pytest.param(
            {
                "kind": "distributed",
                "name": "f",
                "material": [{"name": "s", "from": "0", "to": "1"}],
                "position": ["x + s", "0"],
                "density": ["-c*s*dot(x)", "0"],
            },
            True,
            id="distributed drag",
        ),
    ],
)
def test_damping_is_what_only_ever_takes_energy(load: Mapping[str, object], is_damping: bool) -> None:
    assert ("undamped" in rungs(line(SPRING, load))) is is_damping


def test_a_force_at_right_angles_to_the_velocity_is_no_damping() -> None:
    across = {"kind": "force", "name": "f", "at": "bob", "force": ["c*dot(y)", "-c*dot(x)"]}
    scene = read_scene(
        {
            "coordinates": [{"name": "x", "value": 0.3}, {"name": "y", "value": 0.1}],
            "parameters": [{"name": "m", "value": 1.0}, {"name": "c", "value": 0.2}],
            "bodies": [{"name": "bob", "kind": "particle", "mass": "m", "position": ["x", "y"]}],
            "loads": [across],
        }
    )
    assert "undamped" not in rungs(scene)


def test_a_spring_between_masses_on_a_line_is_made_rigid_by_giving_up_one_of_them() -> None:
    coupling = {"kind": "spring", "name": "s", "from": "bx", "to": "by", "stiffness": "k", "rest_length": "0"}
    scene = line(SPRING, coupling, coordinates="xy")
    found = climbed(scene, 0.5)
    rigid = next(rung for rung in found.ladder.rungs if rung.id == "rigid:s")
    assert rigid.degrees == 1
    assert found.relative("rigid:s") < 1.0


def test_the_lowest_rung_leaves_out_damping_and_spring_and_is_linear() -> None:
    drag = {"kind": "dissipation", "name": "drag", "function": "c*dot(phi)^2/2"}
    document = write_scene(load_scene("base-pendulum"))
    loads, parameters = cast("list[object]", document["loads"]), cast("list[object]", document["parameters"])
    constant = {"name": "c", "value": 0.1, "unit": "N m s"}
    damped = read_scene(document | {"loads": [*loads, drag], "parameters": [*parameters, constant]})
    ladder = climbed(damped, 0.5).ladder
    lowest = next(rung for rung in ladder.rungs if rung.id == "undamped+rigid:suspension+linearized")
    assert lowest.degrees == 1
    assert lowest.scene is not None
    assert [load["kind"] for load in cast("list[dict[str, str]]", lowest.scene["loads"])] == ["potential"]


def test_a_momentum_that_no_displacement_undoes_has_no_scene() -> None:
    """Two links that float freely: the rung is kept, with its reason."""
    scene = read_scene(
        {
            "coordinates": [{"name": "a", "value": 0.5, "rate": 0.2}, {"name": "b", "value": 0.0, "rate": 1.0}],
            "parameters": [{"name": "m", "value": 2.0}, {"name": "l", "value": 2.0}],
            "bodies": [
                {"name": "first", "kind": "particle", "mass": "m", "position": ["l*cos(a)", "l*sin(a)"]},
                {
                    "name": "second",
                    "kind": "particle",
                    "mass": "m",
                    "position": ["l*cos(a) + l*cos(a + b)", "l*sin(a) + l*sin(a + b)"],
                },
            ],
        }
    )
    found = climbed(scene, 0.5)
    refused = next(rung for rung in found.ladder.rungs if rung.id == "cyclic:a")
    assert refused.scene is None
    assert [(each.code, dict(each.parameters)) for each in refused.problems] == [("ladder-routh", {"name": "a"})]
    assert "cyclic:a" not in found.measured


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_kind_has_its_texts(language: str) -> None:
    for kind in ("full", *kinds()):
        assert text(language, f"ladder.kinds.{kind}.title", coordinate="x", load="s")
        assert text(language, f"ladder.kinds.{kind}.text", coordinate="x", load="s").endswith(".")


def test_every_kind_may_be_followed_by_kinds_there_are() -> None:
    assert {name for kind in kinds().values() for name in kind.followers} <= kinds().keys()
    assert all(module_name == kind.id for module_name, kind in kinds().items())
