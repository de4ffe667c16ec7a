"""Scenes as requests name or bring them."""

from __future__ import annotations

import pytest

from deltaq.contract.base import SceneWithChanges, SceneWithInitialValues
from deltaq.contract.reading import read
from deltaq.errors import InputError, Problem
from deltaq.mechanics.families.chain_pendulum import ChainPendulum
from deltaq.mechanics.library import load_scene
from deltaq.mechanics.requests import begun_scene, changed_scene
from deltaq.mechanics.scene import Scene
from deltaq.mechanics.writing import write_scene


def changed(document: dict[str, object]) -> Scene:
    return changed_scene(read(SceneWithChanges, document))


def test_by_name_and_by_document() -> None:
    scene = load_scene("pendulum")
    assert changed({"scene": "pendulum"}) == changed({"scene": write_scene(scene)}) == scene


@pytest.mark.parametrize("reference", ["pendulum", write_scene(load_scene("pendulum"))], ids=["name", "document"])
def test_without_changes_it_is_the_very_scene_of_the_request_before(reference: object) -> None:
    """Of a copy all that is known of a scene would have to be found out anew, at every request."""
    for reading, asked in ((changed_scene, SceneWithChanges), (begun_scene, SceneWithInitialValues)):
        first, second = (reading(read(asked, {"scene": reference})) for _ in range(2))
        assert first is second
    nudged = begun_scene(read(SceneWithInitialValues, {"scene": reference, "initial": {"phi": {"value": 0.3}}}))
    assert nudged.free[0].value == 0.3
    assert nudged is not first


@pytest.mark.parametrize("size", [1, 2, 12])
def test_member_of_a_family(size: int) -> None:
    scene = changed({"scene": "chain-pendulum", "parameters": {"n": size, "g": 1.6}})
    assert len(scene.free) == len(scene.bodies) == size
    assert {p.name: p.value for p in scene.parameters}["g"] == 1.6


def test_default_member() -> None:
    assert len(changed({"scene": "chain-pendulum"}).free) == ChainPendulum.default


def test_documents_that_come_again_are_told_apart_by_every_part() -> None:
    """A scene that is kept is none of another document, nor of the same one changed since, nor one with a problem."""
    document = write_scene(load_scene("pendulum"))
    first = changed({"scene": document})
    assert changed({"scene": document, "parameters": {"l": 0.25}}).parameters[1].value == 0.25
    assert changed({"scene": document}) == first
    document["parameters"][1]["value"] = 1.5
    assert changed({"scene": document}).parameters[1].value == 1.5
    document["parameters"][1]["value"] = "long"
    for _ in range(2):
        with pytest.raises(InputError) as caught:
            changed({"scene": document})
        assert caught.value.problems[0].pointer == "/scene/parameters/1/value"


SIZE = {"name": "n", "least": 1, "most": 12}
REFUSED = [
    pytest.param("chain-pendulum", {"n": 13}, Problem("family-size", "/parameters/n", parameters=SIZE), id="too many"),
    pytest.param("chain-pendulum", {"n": 0}, Problem("family-size", "/parameters/n", parameters=SIZE), id="none"),
    pytest.param("chain-pendulum", {"n": 2.5}, Problem("family-size", "/parameters/n", parameters=SIZE), id="a half"),
    pytest.param(
        "pendulum",
        {"n": 2},
        Problem("unknown-parameter", "/parameters/n", parameters={"name": "n", "known": "m, l, g"}),
        id="not a family",
    ),
    pytest.param(7, {}, Problem("request-scene-type", "/scene"), id="a number"),
    pytest.param({"bodies": []}, {}, Problem("no-body", "/scene/bodies"), id="a document with a problem"),
]


@pytest.mark.parametrize(("reference", "parameters", "problem"), REFUSED)
def test_refused(reference: object, parameters: dict[str, float], problem: Problem) -> None:
    with pytest.raises(InputError) as caught:
        changed({"scene": reference, "parameters": parameters})
    assert caught.value.problems[0] == problem
