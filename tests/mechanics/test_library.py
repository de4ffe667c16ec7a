"""The built-in scenes."""

from __future__ import annotations

import json
import pickle

import pytest

from deltaq.errors import Problem, UnknownNameError
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.mechanics.writing import write_scene


@pytest.mark.parametrize("identifier", scene_ids())
def test_every_scene_is_sound(identifier: str) -> None:
    scene = load_scene(identifier)
    assert scene.id == identifier, "a scene is called like its file"
    assert set(scene.title) == set(scene.summary) == {"de", "en"}
    assert scene.drawing.elements
    assert read_scene(json.loads(json.dumps(write_scene(scene)))) == scene
    assert pickle.loads(pickle.dumps(scene)) == scene


def test_the_lectures_scenes_are_there() -> None:
    assert {"pendulum", "base-pendulum", "guided-pendulum", "elastic-pendulum"} <= set(scene_ids())


def test_unknown_scene() -> None:
    with pytest.raises(UnknownNameError) as caught:
        load_scene("elastic-pendulm")
    parameters = {
        "name": "elastic-pendulm",
        "suggestion": "elastic-pendulum",
        "known": ", ".join(scene_ids()),
    }
    assert caught.value.problems == (Problem("unknown-scene", parameters=parameters),)
