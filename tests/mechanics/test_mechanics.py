"""What scenes have the same equations."""

from __future__ import annotations

import pickle
from dataclasses import replace

import pytest

from deltaq.mechanics.library import load_scene
from deltaq.mechanics.scene import Scene

BALL = load_scene("bouncing-ball")
SLOWER = tuple(replace(each, value=0.5 * each.value) for each in BALL.parameters)
RENAMED = tuple(replace(each, name="table") for each in BALL.events)
OF_ANY_SIGN = tuple(replace(each, positive=False) for each in BALL.parameters)


@pytest.mark.parametrize(
    ("other", "is_same"),
    [
        pytest.param(replace(BALL, title={"de": "Ball", "en": "ball"}), True, id="title"),
        pytest.param(replace(BALL, parameters=SLOWER), True, id="values"),
        pytest.param(replace(BALL, events=RENAMED), False, id="name of an event"),
        pytest.param(replace(BALL, parameters=OF_ANY_SIGN), False, id="parameters that may be negative"),
        pytest.param(load_scene("pendulum"), False, id="another scene"),
    ],
)
def test_what_the_equations_depend_on(other: Scene, is_same: bool) -> None:
    assert (other.mechanics == BALL.mechanics) is is_same
    assert (hash(other.mechanics) == hash(BALL.mechanics)) is is_same


def test_a_hash_is_not_taken_along_to_another_process() -> None:
    hash(BALL.mechanics)
    copy = pickle.loads(pickle.dumps(BALL.mechanics))
    assert vars(copy) == {"content": BALL.mechanics.content}
