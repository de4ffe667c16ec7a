"""Tasks on impacts: answers as textbooks have them, and what is got wrong about them, in the shell's own words."""

from __future__ import annotations

from typing import Any

import pytest

from deltaq.homework.service import check_request, solution_request, tasks_request

# A rod of length 2 l strikes the floor with its lower end: Λ = −(1 + e) ġ/(1/m + l² cos² φ/J).
ROD: dict[str, Any] = {
    "format": 1,
    "id": "falling-rod",
    "title": "falling rod",
    "dimension": 2,
    "coordinates": [
        {"name": "x", "unit": "m"},
        {"name": "y", "unit": "m", "value": 2.0},
        {"name": "phi", "unit": "rad", "value": 0.5},
    ],
    "parameters": [
        {"name": "m", "unit": "kg", "value": 1.2},
        {"name": "J", "unit": "kg m^2", "value": 0.3},
        {"name": "l", "unit": "m", "value": 0.8},
        {"name": "g", "unit": "m/s^2", "value": 9.81},
        {"name": "e", "value": 0.6, "positive": False},
    ],
    "bodies": [{"name": "rod", "kind": "rigid", "mass": "m", "position": ["x", "y"], "inertia": "J", "angle": "phi"}],
    "loads": [{"kind": "gravity", "name": "weight", "acceleration": ["0", "-g"]}],
    "events": [{"name": "floor", "value": "y - l*sin(phi)", "then": "bounce", "restitution": "e"}],
}
RATE, MASS = "(dot(y) - l*cos(phi)*dot(phi))", "(m*J/(J + m*l^2*cos(phi)^2))"

ANSWERS = [
    pytest.param("impulse:floor", f"-(1 + e)*{RATE}*{MASS}", "correct", None),
    pytest.param("impulse:floor", f"Lambda = -(1 + e)*{RATE}/(1/m + l^2*cos(phi)^2/J)", "correct", None),
    pytest.param("impulse:floor", f"-{RATE}*{MASS}", "wrong", "restitution-forgotten"),
    pytest.param("impulse:floor", f"-(1 - e)*{RATE}*{MASS}", "wrong", "restitution-subtracted"),
    pytest.param("impulse:floor", f"(1 + e)*{RATE}*{MASS}", "wrong", "impulse-sign"),
    pytest.param("momentum-behind:y", f"m*dot(y) - (1 + e)*{RATE}*{MASS}", "correct", None),
    pytest.param("momentum-behind:phi", f"J*dot(phi) + (1 + e)*l*cos(phi)*{RATE}*{MASS}", "correct", None),
    pytest.param("momentum-behind:y", "-e*m*dot(y)", "wrong", "restitution-on-whole-velocity"),
    pytest.param("momentum-behind:phi", "-e*J*dot(phi)", "wrong", "restitution-on-whole-velocity"),
    pytest.param("momentum-behind:phi", f"J*dot(phi) - (1 + e)*{RATE}*{MASS}", "wrong", "impulse-without-gradient"),
    pytest.param("momentum-behind:y", f"m*dot(y) + (1 + e)*{RATE}*{MASS}", "wrong", "impulse-sign"),
    pytest.param("impact-loss:floor", f"(1 - e^2)*{MASS}*{RATE}^2/2", "correct", None),
    pytest.param("impact-loss:floor", f"{MASS}*{RATE}^2/2", "wrong", "restitution-forgotten"),
    pytest.param("impact-loss:floor", f"(1 - e)*{MASS}*{RATE}^2/2", "wrong", "restitution-not-squared"),
    pytest.param("impact-loss:floor", f"e^2*{MASS}*{RATE}^2/2", "wrong", "restitution-energy-left"),
    pytest.param(
        "impact-loss:floor",
        "(1 - e^2)*(m*dot(x)^2 + m*dot(y)^2 + J*dot(phi)^2)/2",
        "wrong",
        "restitution-on-whole-velocity",
    ),
]


def checked(scene: object, task: str, value: str) -> dict[str, Any]:
    return check_request({"scene": scene, "task": task, "answer": {"syntax": "plain", "value": value}, "lang": "en"})


@pytest.mark.one_in(3)
@pytest.mark.parametrize(("task", "value", "outcome", "misconception"), ANSWERS)
def test_answers_are_judged_and_mistakes_named(task: str, value: str, outcome: str, misconception: str | None) -> None:
    verdict = checked(ROD, task, value)
    assert (verdict["outcome"], verdict["misconception"]) == (outcome, misconception), verdict["feedback"]


@pytest.mark.parametrize(
    ("value", "outcome", "misconception"),
    [
        # A ball on a table z = a sin ωt: −e of the rate at which they approach, on top of the table's own.
        ("m*(a*omega*cos(omega*t) - e*(dot(z) - a*omega*cos(omega*t)))", "correct", None),
        ("-e*m*dot(z)", "wrong", "restitution-on-whole-velocity"),
    ],
)
def test_a_table_that_moves_counts(value: str, outcome: str, misconception: str | None) -> None:
    verdict = checked("bouncing-ball", "momentum-behind:z", value)
    assert (verdict["outcome"], verdict["misconception"]) == (outcome, misconception)


@pytest.mark.parametrize("language", ["de", "en"])
def test_tasks_tell_the_contact_and_their_answers_are_right(language: str) -> None:
    told: Any = tasks_request({"scene": ROD, "lang": language})["tasks"]
    tasks = {task["id"]: task for task in told if task["kind"] in ("impulse", "momentum-behind", "impact-loss")}
    assert set(tasks) == {"impulse:floor", "momentum-behind:y", "momentum-behind:phi", "impact-loss:floor"}
    for name, task in tasks.items():
        assert "$g_N = y - l" in task["statement"]
        assert task["solution"] == {"chapter": "contact", "steps": ["impact-law:floor"]}
        right: Any = solution_request({"scene": ROD, "task": name, "lang": language})
        assert checked(ROD, name, right["plain"][0])["outcome"] == "correct"
    assert "momentum-behind:x" not in tasks  # which the floor leaves alone
