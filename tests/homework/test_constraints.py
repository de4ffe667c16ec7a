"""Answers about scenes with constraints: multipliers in equations, reactions, and what is got wrong about them."""

from __future__ import annotations

from functools import cache
from typing import Any

import pytest
from tests.derivation.scenes import constrained

from deltaq.homework.service import check_request, solution_request, tasks_request
from deltaq.homework.variants import Variant, varied
from deltaq.language.floats import evaluate
from deltaq.mechanics.writing import write_scene

SCENES = {scene.id: scene for scene in constrained()}
SLEIGH = "m*ddot(x) - m*a*sin(phi)*ddot(phi) - m*a*cos(phi)*dot(phi)^2"

ANSWERS = [
    pytest.param("particle-on-a-rod", "equation:x", "m*ddot(x) + S*x/sqrt(x^2 + y^2) = 0", "correct", None),
    pytest.param("particle-on-a-rod", "equation:x", "m*l*ddot(x) = -S*x", "correct", None, id="l where it is kept"),
    pytest.param("particle-on-a-rod", "equation:x", "m*l*ddot(x) = -S*y", "wrong", None, id="the other component"),
    pytest.param("particle-on-a-rod", "equation:y", "m*ddot(y) = m*g", "wrong", "reaction-forgotten"),
    pytest.param("particle-on-a-rod", "equation:y", "m*ddot(y) = m*g + S*y/sqrt(x^2 + y^2)", "wrong", "reaction-sign"),
    pytest.param("particle-on-a-rod", "equations", "m*l*ddot(x) = -S*x; m*l*ddot(y) = m*g*l - S*y", "correct", None),
    pytest.param("particle-on-a-circle", "equation:x", "m*ddot(x) = 2*lambda*x", "correct", None),
    pytest.param("particle-on-a-rod", "constraint-force:rod", "m*(dot(x)^2 + dot(y)^2 + g*y)/l", "correct", None),
    pytest.param("particle-on-a-rod", "constraint-force:rod", "S = -m*l*ddot(x)/x", "correct", None),
    pytest.param("particle-on-a-rod", "constraint-force:rod", "m*g*y/l", "wrong", "drift-forgotten", id="at rest only"),
    pytest.param(
        "particle-on-a-rod", "constraint-force:rod", "-m*(dot(x)^2 + dot(y)^2 + g*y)/l", "wrong", "reaction-sign"
    ),
    pytest.param("sleigh", "equation:x", f"{SLEIGH} + lambda*sin(phi) = 0", "correct", None),
    pytest.param("sleigh", "equation:x", f"{SLEIGH} = 0", "wrong", "reaction-forgotten"),
    pytest.param(
        "sleigh",
        "equation:x",
        f"{SLEIGH} - dot(lambda)*sin(phi) - lambda*cos(phi)*dot(phi) = 0",
        "wrong",
        "rates-varied-along-the-motion",
    ),
    pytest.param(
        "sleigh",
        "constraint-force:blade",
        "m*J*dot(phi)*sqrt(dot(x)^2 + dot(y)^2)/(J + m*a^2)",
        "wrong",
        None,
        id="speed",
    ),
    pytest.param(
        "sleigh", "constraint-force:blade", "m*J*dot(phi)*dot(x)/(cos(phi)*(J + m*a^2))", "correct", None, id="along"
    ),
]


@pytest.mark.parametrize(("scene", "task", "value", "outcome", "misconception"), ANSWERS)
def test_answers_are_judged_where_the_constraint_is_kept(
    scene: str, task: str, value: str, outcome: str, misconception: str | None
) -> None:
    verdict = check_request(
        {"scene": _document(scene), "task": task, "answer": {"syntax": "plain", "value": value}, "lang": "en"}
    )
    assert (verdict["outcome"], verdict["misconception"]) == (outcome, misconception)


ONE_WAY = [
    pytest.param("2*m*omega*(dot(x)*cos(omega*t) + dot(y)*sin(omega*t))", "correct", id="rate along the line"),
    pytest.param("2*m*omega*sqrt(dot(x)^2 + dot(y)^2 - omega^2*(x^2 + y^2))", "wrong", id="root of its square"),
    pytest.param("2*m*omega*abs(dot(x)*cos(omega*t) + dot(y)*sin(omega*t))", "wrong", id="its modulus"),
]


@pytest.mark.parametrize("rate", [4.0, -4.0])
@pytest.mark.parametrize(("value", "outcome"), ONE_WAY)
def test_a_reaction_is_asked_for_both_ways(value: str, outcome: str, rate: float) -> None:
    """The force of a turning line, 2 m ω ṙ, presses on one side on the way out and on the other on the way back.

    A motion may begin so fast that all rates near its own are of one sign.
    """
    scene = {**_document("particle-on-a-turning-line"), "loads": []}
    scene["coordinates"] = [
        {**each, "value": at, "rate": fast}
        for each, at, fast in zip(scene["coordinates"], (1.0, 0.0), (rate, 1.0), strict=True)
    ]
    answer = {"syntax": "plain", "value": value}
    task = f"constraint-force:{scene['constraints'][0]['name']}"
    assert check_request({"scene": scene, "task": task, "answer": answer})["outcome"] == outcome


@cache
def _document(scene: str) -> Any:
    return write_scene(SCENES[scene])


def test_right_answers_are_right_and_tell_their_multipliers() -> None:
    told = tasks_request({"scene": _document("sleigh"), "lang": "en"})
    tasks = {task["id"]: task for task in told["tasks"]}  # type: ignore[attr-defined]
    assert "constraint-force:blade" in tasks
    assert not {"linearized:phi", "equilibria", "order-equation:x"} & tasks.keys()
    assert "times $\\sum\\partial\\Phi/\\partial\\dot q_i\\,\\delta q_i$" in tasks["equation:x"]["statement"]
    for name in ("equation:x", "equation:phi", "constraint-force:blade"):
        right = solution_request({"scene": _document("sleigh"), "task": name, "lang": "en"})
        (value,) = right["plain"]  # type: ignore[misc]
        answer = {"syntax": "plain", "value": value}
        assert check_request({"scene": _document("sleigh"), "task": name, "answer": answer})["outcome"] == "correct"


def test_reactions_too_long_to_be_read_are_not_asked_for() -> None:
    told = tasks_request({"scene": _document("two-rods"), "lang": "de"})
    kinds = {task["kind"] for task in told["tasks"]}  # type: ignore[attr-defined]
    assert "constraint-force" not in kinds
    assert "equation" in kinds


def test_a_scene_told_otherwise_keeps_its_constraints() -> None:
    """With the mass as 2 m and l as 3 l, the circle has three times the radius."""
    scene = SCENES["particle-on-a-circle"]
    told = varied(scene, Variant(factors=(("l", 3), ("m", 2))))  # type: ignore[arg-type]
    (condition,) = told.conditions
    assert evaluate(condition.value, {"x": 3.0, "y": 0.0, "l": 1.0}) == pytest.approx(0.0)
