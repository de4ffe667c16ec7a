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


def test_a_step_that_tells_of_every_coordinate_asks_for_all_of_them() -> None:
    """Seed: Q₁ = m g − k q₁ − F₀ sin q₂, Q₂ = F₀ ℓ − m g ℓ sin q₂; each choice differs from it in what is named."""
    choices = poll_request({"scene": "elastic-pendulum", "step": "generalized-forces", "lang": "en"})["choices"]
    (right,) = [choice["latex"] for choice in choices if choice["right"]]
    assert right == (
        r"\begin{aligned}Q_{1} ={}&m g - k q_1 - F_0 \sin q_2 \\ Q_{2} ={}&F_0 \ell - m g \ell \sin q_2\end{aligned}"
    )
    assert 2 <= len(choices) <= 4
    for choice in choices:
        rows = choice["latex"].removeprefix(r"\begin{aligned}").removesuffix(r"\end{aligned}").split(r" \\ ")
        verdicts = [
            check_request({"scene": "elastic-pendulum", "task": f"generalized-force:{q}", "answer": answer})["outcome"]
            for q, row in zip(("y", "phi"), rows, strict=True)
            for answer in [{"syntax": "latex", "value": row.split("&")[1]}]
        ]
        assert (verdicts == ["correct", "correct"]) == choice["right"], choice
        assert set(verdicts) <= {"correct", "wrong"}
        assert bool(choice["title"] and choice["hint"]) != choice["right"]


def test_an_impact_asks_for_the_energy_that_it_takes() -> None:
    """It ends with E⁻ − E⁺, which is said of each choice; the wrong ones forget something that has a name."""
    asked = {"scene": "bouncing-ball", "step": "impact-law:impact", "lang": "en"}
    choices = poll_request(asked)["choices"]
    assert 2 <= len(choices) <= 4
    assert all(choice["latex"].startswith("E^{-} - E^{+} ={}") for choice in choices)
    for choice in choices:
        answer = {"syntax": "latex", "value": choice["latex"].split("={}")[1]}
        task = {"scene": "bouncing-ball", "task": "impact-loss:impact", "answer": answer}
        assert check_request(task)["outcome"] == ("correct" if choice["right"] else "wrong"), choice
    names = {choice["title"] for choice in choices if not choice["right"]}
    assert len(names) == len(choices) - 1


@pytest.mark.parametrize("step", ["curl-test:weight", "symmetry-search", "no-such-step"])
def test_where_nothing_single_is_asked_there_is_no_poll(step: str) -> None:
    assert poll_request({"scene": "elastic-pendulum", "step": step})["choices"] == []


def test_the_order_does_not_tell_which_is_right() -> None:
    places = set()
    for scene, step in ASKED:
        choices = poll_request({"scene": scene, "step": step})["choices"]
        places.add([choice["right"] for choice in choices].index(True))
    assert len(places) > 1
