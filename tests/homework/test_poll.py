"""Polls: the right result among wrong ones that misconceptions lead to."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest

from deltaq.homework.service import check_request, poll_request
from deltaq.language.floats import evaluate
from deltaq.language.parser import parse
from deltaq.mechanics.library import load_scene
from deltaq.narration.derive import derive_request

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


# At a state that keeps the constraints: what the choices are worth, by the laws of textbooks.
TURN, WAY = math.cos(0.4), math.sin(0.4)
HALLS = [
    pytest.param(
        "rolling-disc-in-space",
        "constraint:rollx",
        {"x": 0.3, "y": 0.2, "psi": 0.4, "phi": 1.1, "R": 2.0, "dot(phi)": 1.5, "dot(x)": 3 * TURN, "dot(y)": 3 * WAY},
        0.0,
        id="rolling",
    ),
    *(
        pytest.param(
            scene,
            "constraint:edge",
            {"x": 0.3, "y": 0.2, "phi": 0.4, "dot(x)": 3 * TURN, "dot(y)": 3 * WAY, "dot(phi)": 0.7},
            0.0,
            id=f"blade of {scene}",
        )
        for scene in ("chaplygin-sleigh", "skate-on-incline")
    ),
    pytest.param("cartesian-pendulum", "constraint:rod", {"x": 1.2, "y": 1.6, "l": 2.0}, 0.0, id="rod"),
    pytest.param("double-pendulum-by-rods", "constraint:rod1", {"x1": 1.2, "y1": 1.6, "l1": 2.0}, 0.0, id="first rod"),
    pytest.param(
        "double-pendulum-by-rods",
        "constraint:rod2",
        {"x1": 1.2, "y1": 1.6, "x2": 2.4, "y2": 3.2, "l2": 2.0},
        0.0,
        id="second rod",
    ),
    *(
        pytest.param(
            "four-bar",
            f"constraint:{loop}",  # a rhombus whose lower side is the frame
            {"a": 2.0, "b": 3.0, "c": 2.0, "s": 3.0, "phi1": 0.4, "phi2": 0.0, "phi3": 0.4},
            0.0,
            id=loop,
        )
        for loop in ("loopx", "loopy")
    ),
    *(
        pytest.param(
            "slider-crank",
            f"constraint:{guide}",
            {"r": 1.0, "l": 2.0, "phi": 0.4, "psi": math.asin(WAY / 2), "x": TURN + math.sqrt(4 - WAY**2)},
            0.0,
            id=guide,
        )
        for guide in ("across", "along")
    ),
    pytest.param(
        "cartesian-pendulum",  # S = m (g cos φ + v²/ℓ)
        "multiplier:rod",
        {"x": 1.2, "y": 1.6, "l": 2.0, "m": 3.0, "g": 9.0, "dot(x)": 1.6, "dot(y)": -1.2},
        3.0 * (9.0 * 0.8 + 4.0 / 2.0),
        id="tension",
    ),
    pytest.param(
        "skate-on-incline",  # m times the acceleration across the blade, v φ̇, and the slope's pull across it
        "multiplier:edge",
        {"phi": 0.4, "dot(phi)": 0.7, "dot(x)": 3 * TURN, "dot(y)": 3 * WAY, "m": 2.0, "g": 9.0, "alpha": 0.5},
        2.0 * (3 * 0.7 + 9.0 * math.sin(0.5) * WAY),
        id="skate",
    ),
    pytest.param(
        "chaplygin-sleigh",  # the runner at v turns with φ̇; mass and inertia in series
        "multiplier:edge",
        {"phi": 0.4, "dot(phi)": 0.7, "dot(x)": 3 * TURN, "dot(y)": 3 * WAY, "m": 2.0, "J": 1.5, "a": 0.5},
        3 * 0.7 / (1 / 2.0 + 0.5**2 / 1.5),
        id="sleigh",
    ),
    pytest.param(
        "bouncing-ball",
        "contact-gap:impact",
        {"z": 0.5, "dot(z)": -2.0, "a": 0.2, "omega": 3.0, "t": 0.4},
        -2.0 - 0.6 * math.cos(1.2),
        id="gap over a table",
    ),
    pytest.param(
        "catching-pendulum",
        "contact-gap:taut",
        {"x": 0.5, "y": 0.8, "l": 1.0, "dot(x)": 0.3, "dot(y)": 0.4},
        -2 * (0.15 + 0.32),
        id="gap of a string",
    ),
    pytest.param(
        "stick-slip",
        "sticking-condition:friction",
        {"x": 0.03, "k": 20.0, "m": 1.0, "mu_s": 0.4, "mu": 0.2, "g": 9.0},
        0.6,
        id="held by friction",
    ),
]


@pytest.mark.parametrize(("scene", "step", "state", "value"), HALLS)
def test_what_a_hall_is_asked_besides_is_right_once(
    scene: str, step: str, state: dict[str, float], value: float
) -> None:
    """Each choice at a state, and the right one alone is worth what it should be."""
    names = load_scene(scene).names
    for language in ("de", "en"):
        choices = poll_request({"scene": scene, "step": step, "lang": language})["choices"]
        assert 2 <= len(choices) <= 4
        found = [
            evaluate(parse(choice["latex"].split("={}")[-1].removesuffix("= 0"), names, "latex").tree, state)
            for choice in choices
        ]
        assert [one == pytest.approx(value, abs=1e-12) for one in found] == [choice["right"] for choice in choices]
        assert not any(map(math.isnan, found))
        wrong = [choice for choice in choices if not choice["right"]]
        assert len({choice["title"] for choice in wrong}) == len(wrong)
        assert all(choice["hint"] for choice in wrong)


def test_the_augmented_system_is_asked_by_its_blocks() -> None:
    """A pendulum with the speed v, with q̈ and λ of its circle: only one of the systems holds for them."""
    m, g, length, x, y, v = 3.0, 9.0, 2.0, 1.2, 1.6, 2.0
    along, normal = np.array([y, -x]) / length, np.array([x, y]) / length
    acceleration = g * (along @ [0, 1]) * along - v**2 / length * normal
    tension = m * (g * y / length + v**2 / length)
    rows = -normal.reshape(1, 2)  # of Φ = ℓ − √(x² + y²)
    drift = -(v**2) / length
    blocks = {r"\mathbf A^T": rows.T, r"\mathbf 0": 0 * rows.T}
    ends = {r"\boldsymbol\gamma": drift, r"\mathbf 0": 0.0}
    choices = poll_request({"scene": "cartesian-pendulum", "step": "augmented-system", "lang": "en"})["choices"]
    assert len(choices) == 4
    for choice in choices:
        reaction, end = re.findall(r"(?:\\mathbf M &|\\mathbf f \\\\) (.*?) (?:\\\\|\\end)", choice["latex"])
        upper = np.concatenate([m * np.eye(2), _signed(reaction, blocks)], axis=1)
        matrix = np.concatenate([upper, np.concatenate([rows, [[0.0]]], axis=1)])
        left = matrix @ [*acceleration, -tension]
        holds = np.allclose(left, [0.0, m * g, _signed(end, ends)])
        assert holds == choice["right"], choice


def _signed(written: str, known: Mapping[str, Any]) -> Any:
    return -known[written[1:]] if written.startswith("-") else known[written]


def test_a_scene_asks_of_every_step_with_a_known_mistake() -> None:
    """All of these rules, wherever they are in the library: a choice is never missing, never the same twice."""
    rules = {"constraint", "multiplier", "augmented-system", "contact-gap", "sticking-condition"}
    seen = set()
    for scene in ("cartesian-pendulum", "bouncing-ball", "stick-slip", "skate-on-incline"):
        chapters: Any = derive_request({"scene": scene, "lang": "en"})["chapters"]
        for step in (step for chapter in chapters for step in chapter["steps"] if step["rule"] in rules):
            choices = poll_request({"scene": scene, "step": step["id"], "lang": "en"})["choices"]
            assert len({choice["latex"] for choice in choices}) == len(choices) >= 2, step["id"]
            seen.add(step["rule"])
    assert seen == rules


@pytest.mark.parametrize("step", ["work-of-reaction:rod", "constrained-variation:rod"])
def test_a_step_that_only_speaks_of_a_reaction_does_not_ask_for_it(step: str) -> None:
    assert poll_request({"scene": "cartesian-pendulum", "step": step})["choices"] == []


@pytest.mark.parametrize("step", ["curl-test:weight", "symmetry-search", "no-such-step"])
def test_where_nothing_single_is_asked_there_is_no_poll(step: str) -> None:
    assert poll_request({"scene": "elastic-pendulum", "step": step})["choices"] == []


def test_the_order_does_not_tell_which_is_right() -> None:
    places = set()
    for scene, step in ASKED:
        choices = poll_request({"scene": scene, "step": step})["choices"]
        places.add([choice["right"] for choice in choices].index(True))
    assert len(places) > 1
