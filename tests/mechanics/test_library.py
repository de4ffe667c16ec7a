"""The built-in scenes."""

from __future__ import annotations

import json
import math
import pickle
import random
from collections.abc import Iterator

import pytest

from deltaq.errors import Problem, UnknownNameError
from deltaq.language.floats import evaluate
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.mechanics.scene import Scene
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


def directions(scene: Scene, at: str, values: dict[str, float]) -> Iterator[float]:
    """Where every other place is seen from one, as an angle from the downward vertical of the drawing."""
    fields = {body.name: body.position for body in scene.bodies if body.material} | dict(scene.places)
    ends = {each.name: evaluate(each.upper.tree, values) for body in scene.bodies for each in body.material}
    x, y = (evaluate(part.tree, values) for part in scene.places[at][:2])
    for name, position in fields.items():
        across, up = (evaluate(part.tree, values | ends) for part in position[:2])
        if name != at and (across, up) != (x, y):
            yield math.atan2(across - x, (y - up) * (1 if scene.drawing.vertical == "up" else -1))


@pytest.mark.parametrize("identifier", scene_ids())
def test_an_angle_is_drawn_up_to_what_it_turns(identifier: str) -> None:
    """The arc of `angle` ends at the direction of a place that is seen from its own, at any state."""
    scene, source = load_scene(identifier), random.Random(3)
    names = [each.name for each in (*scene.coordinates, *scene.parameters)]
    drawn = [each.write() for each in scene.drawing.elements if each.kind == "angle" and scene.dimension == 2]
    for element in drawn:
        for _ in range(3):
            values = {name: source.uniform(0.2, 1.2) for name in names} | {"t": 0.3}
            sense = -1 if element.get("direction") == "clockwise" else 1
            wanted = float(str(element.get("offset", 0))) + sense * values[str(element["coordinate"])]
            seen = directions(scene, str(element["at"]), values)
            found = [abs(math.remainder(each - wanted, math.tau)) for each in seen]
            assert min(found, default=math.pi) < 1e-9, (element, found)
