"""Polls: the right result among wrong ones that misconceptions lead to."""

from __future__ import annotations

import pytest

from deltaq.homework.service import check_request, poll_request

ASKED = [
    ("pendulum", "equation:phi"),
    ("elastic-pendulum", "lagrangian"),
    ("elastic-pendulum", "virtual-work"),
    ("elastic-pendulum", "kinetic-energy-of-particle:bob"),
]
TASKS = {"kinetic-energy-of-particle:bob": "kinetic-energy"}


@pytest.mark.parametrize(("scene", "step"), ASKED)
def test_one_choice_is_right_and_the_others_are_named(scene: str, step: str) -> None:
    choices = poll_request({"scene": scene, "step": step, "lang": "en"})["choices"]
    assert 2 <= len(choices) <= 4
    assert len({choice["latex"] for choice in choices}) == len(choices)
    for choice in choices:
        answer = {"syntax": "latex", "value": choice["latex"]}
        verdict = check_request({"scene": scene, "task": TASKS.get(step, step), "answer": answer, "lang": "en"})
        assert verdict["outcome"] == ("correct" if choice["right"] else "wrong"), choice
        assert bool(choice["title"] and choice["hint"]) != choice["right"]
    assert sum(choice["right"] for choice in choices) == 1


@pytest.mark.parametrize("step", ["curl-test:weight", "generalized-forces", "no-such-step"])
def test_where_nothing_single_is_asked_there_is_no_poll(step: str) -> None:
    assert poll_request({"scene": "elastic-pendulum", "step": step})["choices"] == []


def test_the_order_does_not_tell_which_is_right() -> None:
    places = set()
    for scene, step in ASKED:
        choices = poll_request({"scene": scene, "step": step})["choices"]
        places.add([choice["right"] for choice in choices].index(True))
    assert len(places) > 1
