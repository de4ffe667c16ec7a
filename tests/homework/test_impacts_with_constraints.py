"""Tasks on impacts and on equilibria where constraints answer, by what the same motion is in an angle.

A weight on a rod is a pendulum: with x = l sin φ, y = l cos φ (y downwards) an upright wall turns φ̇ into −e φ̇.
"""

from __future__ import annotations

from typing import Any

import pytest
from tests.homework.test_impacts import checked

from deltaq.homework.service import solution_request, tasks_request
from deltaq.mechanics.library import load_scene
from deltaq.mechanics.writing import write_scene

Document = dict[str, Any]


def struck(scene: str, *gaps: str, **more: Any) -> Document:
    """A built-in scene with contacts, called c1, c2 …"""
    document: Document = write_scene(load_scene(scene))
    document["parameters"] += [{"name": "e", "value": 0.7, "positive": False}, {"name": "w", "value": 2.0, "unit": "m"}]
    bounce = {"then": "bounce", "restitution": "e"}
    return {**document, "events": [{"name": f"c{k}", "value": gap, **bounce} for k, gap in enumerate(gaps, 1)], **more}


WALLS = struck("cartesian-pendulum", "x + w", "w + l - y")
# A bead of mass m on a rod that turns with ω, y cos ωt = x sin ωt, before an upright wall: along the rod it has the
# speed u = ẋ cos + ẏ sin, and Λ cos ωt is what the wall does along it.
TURNING: Document = {
    "id": "turning",
    "coordinates": [{"name": "x", "unit": "m", "value": 1.0}, {"name": "y", "unit": "m"}],
    "parameters": [
        {"name": "m", "unit": "kg", "value": 1.3},
        {"name": "omega", "unit": "1/s", "value": 0.7},
        {"name": "w", "unit": "m", "value": 2.0},
        {"name": "e", "value": 0.6, "positive": False},
    ],
    "bodies": [{"name": "bead", "kind": "particle", "mass": "m", "position": ["x", "y"]}],
    "constraints": [{"kind": "equation", "name": "rod", "equation": "y*cos(omega*t) = x*sin(omega*t)"}],
    "events": [{"name": "wall", "value": "w - x", "then": "bounce", "restitution": "e"}],
}
C, S = "cos(omega*t)", "sin(omega*t)"
JUMP = f"(-(1 + e)*dot(x)/{C})"  # of the speed along the rod: ẋ⁺ = −e ẋ, the speed across it stays
ALONG = f"(dot(x)*{C} + dot(y)*{S})"

ANSWERS = [
    # p_φ jumps by −(1 + e) m l² φ̇ = Λ ∂x/∂φ = Λ y, and ẋ = y φ̇.
    pytest.param(WALLS, "impulse:c1", "-(1 + e)*m*dot(x)*l^2/y^2", "correct", None),
    pytest.param(WALLS, "impulse:c1", "-(1 + e)*m*dot(x)*(x^2 + y^2)/y^2", "correct", None, id="on the circle"),
    pytest.param(WALLS, "impulse:c1", "-(1 + e)*m*dot(x)", "wrong", "constraint-impulse-forgotten"),
    pytest.param(WALLS, "impulse:c1", "(1 + e)*m*dot(x)*l^2/y^2", "wrong", "impulse-sign"),
    pytest.param(WALLS, "impulse:c1", "-(1 + e)*m*dot(x)*l^2/x^2", "wrong", None, id="the other side"),
    pytest.param(WALLS, "impulse:c2", "(1 + e)*m*dot(y)*l^2/x^2", "correct", None),
    pytest.param(WALLS, "momentum-behind:y", "-e*m*dot(y)", "correct", None, id="all of the velocity turns"),
    pytest.param(WALLS, "momentum-behind:y", "m*dot(y)", "wrong", "constraint-impulse-forgotten"),
    pytest.param(WALLS, "momentum-behind:c2:x", "-e*m*dot(x)", "correct", None),
    pytest.param(WALLS, "momentum-behind:c2:x", "m*dot(x)", "wrong", "constraint-impulse-forgotten"),
    pytest.param(WALLS, "impact-loss:c2", "(1 - e^2)*m*(dot(x)^2 + dot(y)^2)/2", "correct", None),
    pytest.param(WALLS, "impact-loss:c2", "(1 - e)*m*(dot(x)^2 + dot(y)^2)/2", "wrong", "restitution-not-squared"),
    pytest.param(WALLS, "impact-loss:c2", "(1 - e^2)*m*dot(y)^2/2", "wrong", "constraint-impulse-forgotten"),
    pytest.param(TURNING, "impulse:wall", f"-m*{JUMP}/{C}", "correct", None),
    pytest.param(TURNING, "momentum-behind:y", f"m*(dot(y) + {JUMP}*{S})", "correct", None),
    pytest.param(TURNING, "impact-loss:wall", f"m*({ALONG}^2 - ({ALONG} + {JUMP})^2)/2", "correct", None),
    pytest.param(TURNING, "impact-loss:wall", f"m*(1 - e^2)*dot(x)^2/{C}^2/2", "wrong", "work-of-contact-forgotten"),
    pytest.param(WALLS, "equilibria", "x = 0, y = l; x = 0, y = -l", "correct", None),
    pytest.param(WALLS, "equilibria", "x = 0, y = ±l", "correct", None, id="both signs"),
    pytest.param(WALLS, "stability:1", "stable", "correct", None),
    pytest.param(WALLS, "stability:2", "stable", "wrong", None, id="upright"),
    pytest.param(WALLS, "rest-reaction:rod", "S = m*g", "correct", None),
    pytest.param(WALLS, "rest-reaction:rod", "-m*g", "wrong", "reaction-sign"),
    pytest.param("double-pendulum-by-rods", "rest-reaction:rod1", "g*(m1 + m2)", "correct", None),
    # The pin carries what the spring, pressed by r, pushes with.
    pytest.param("slider-crank", "rest-reaction:along", "k*r", "wrong", "reaction-sign"),
]


@pytest.mark.one_in(3)
@pytest.mark.parametrize(("scene", "task", "value", "outcome", "misconception"), ANSWERS)
def test_answers_are_judged_where_constraints_answer(
    scene: Document | str, task: str, value: str, outcome: str, misconception: str | None
) -> None:
    verdict = checked(scene, task, value)
    assert (verdict["outcome"], verdict["misconception"]) == (outcome, misconception), verdict["feedback"]


@pytest.mark.parametrize(
    ("value", "remark"),
    [
        ("x = 0, y = l", "equilibrium-missing"),
        ("x = 0, y = 0", "off-constraint"),
        ("x = l, y = 0; x = 0, y = ±l", "no-equilibrium"),
    ],
)
def test_what_is_wrong_with_a_position_is_told(value: str, remark: str) -> None:
    verdict = checked(WALLS, "equilibria", value)
    assert (verdict["outcome"], verdict["remark"]) == ("wrong", remark)


def test_an_answer_without_its_square_is_named_on_a_table_that_moves() -> None:
    """½ m (1 − e²) ġ² is lost to one who moves along with the table; to others its work comes to it."""
    rate, table = "(dot(z) - a*omega*cos(omega*t))", "a*omega*cos(omega*t)"
    named = {
        f"(1 - e)*m*{rate}^2/2": "restitution-not-squared",
        f"(1 - e)*m*{rate}^2/2 + (1 + e)*m*{rate}*{table}": "restitution-not-squared",
        "(1 - e)*m*dot(z)^2/2": "restitution-not-squared",
        f"(1 - e^2)*m*{rate}^2/2": "work-of-contact-forgotten",
        f"(1 - e^2)*m*{rate}^2/2 + (1 + e)*m*{rate}*{table}": None,
    }
    found = {value: checked("bouncing-ball", "impact-loss:impact", value) for value in named}
    assert {value: verdict["misconception"] for value, verdict in found.items()} == named
    assert [verdict["outcome"] for verdict in found.values()] == ["wrong"] * 4 + ["correct"]


@pytest.mark.parametrize("language", ["de", "en"])
def test_statements_and_hints_say_what_constraints_do(language: str) -> None:
    """M Δq̇ = Λ ∂g/∂q alone, or ∂V/∂q = Q, would be untrue."""
    tasks: Any = tasks_request({"scene": WALLS, "lang": language})["tasks"]
    told = {task["id"]: task for task in tasks}
    assert {"momentum-behind:x", "momentum-behind:c2:y", "impact-loss:c2", "equilibria", "stability:2"} <= told.keys()
    for name in ("impulse:c1", "momentum-behind:c2:y", "equilibria"):
        assert r"\sqrt{x^{2} + y^{2}} = 0" in told[name]["statement"]
        assert any(each in told[name]["hints"][1] for each in (r"\Lambda_c", r"\lambda_c"))
    assert {"de": "jeder Kontakt offen", "en": "every contact open"}[language] in told["equilibria"]["statement"]
    assert r"\Delta p_i" not in told["impulse:c1"]["statement"]
    assert told["momentum-behind:c2:y"]["title"] != told["momentum-behind:y"]["title"]
    assert told["momentum-behind:c2:y"]["solution"]["steps"][0] == "impact-law:c2"
    shown: Any = solution_request({"scene": WALLS, "task": "momentum-behind:c2:y", "lang": language})
    assert len(shown["plain"][0]) < 20  # −m e ẏ, common factors cancelled


def test_stack_is_not_asked_what_it_cannot_compare() -> None:
    """It draws x, y and l by themselves, so that l² and x² + y² would be two answers."""
    from deltaq.homework.stack.question import quiz
    from deltaq.homework.workbook import workbook_of

    workbook = workbook_of({"scene": WALLS})
    names = ("rest-reaction:rod", "impulse:c1", "constraint-force:rod", "equilibria")
    document = quiz(workbook, tuple(workbook.task(name) for name in names), "en")
    left, questions = document.split("-->", 1)
    assert all(name in left for name in names[1:])
    assert questions.count('<question type="stack">') == 1
