"""Tasks of every scene, and that every model answer is right in both syntaxes."""

from __future__ import annotations

import pytest

from deltaq.errors import UnknownNameError
from deltaq.homework.checking import check
from deltaq.homework.quantities import QUANTITIES
from deltaq.homework.service import tasks_request
from deltaq.homework.statement import model_answer, task_document
from deltaq.homework.workbook import workbook_of
from deltaq.mechanics.library import scene_ids
from deltaq.mechanics.writing import write_scene

QUICK = [scene for scene in scene_ids() if scene != "chain-pendulum"]


def written(values: list[str], form: str, syntax: str) -> str:
    """The parts of a model answer as a student would write them."""
    if form == "vector" and syntax == "latex":
        return r"\begin{bmatrix}" + r"\\".join(values) + r"\end{bmatrix}"
    return f"[{', '.join(values)}]" if form == "vector" else "; ".join(values)


@pytest.mark.one_in(10)
@pytest.mark.parametrize("scene", QUICK)
def test_model_answers_are_right_in_both_syntaxes(scene: str) -> None:
    workbook = workbook_of({"scene": scene})
    outcomes = {}
    for task in workbook.tasks:
        for syntax, values in model_answer(task, workbook).items():
            text = written(values, task.quantity.form, syntax)
            outcomes[task.id, syntax] = check(workbook, task, text, syntax).outcome
    assert {key: outcome for key, outcome in outcomes.items() if outcome != "correct"} == {}


def test_every_kind_of_task_is_asked_somewhere() -> None:
    kinds = {task.quantity.kind for scene in QUICK for task in workbook_of({"scene": scene}).tasks}
    assert kinds == {quantity.kind for quantity in QUANTITIES}


@pytest.mark.one_in(2)
@pytest.mark.parametrize("language", ["de", "en"])
def test_tasks_are_stated(language: str) -> None:
    for scene in QUICK:
        answer = tasks_request({"scene": scene, "lang": language})
        for task in answer["tasks"]:
            assert task["statement"].endswith("."), task["id"]
            assert len(set(task["hints"])) == 3
            assert "{" not in task["title"]


def test_tasks_of_an_inline_scene_are_those_of_the_built_in_one() -> None:
    workbook = workbook_of({"scene": "cart-pendulum"})
    inline = tasks_request({"scene": write_scene(workbook.scene)})
    assert [task["id"] for task in inline["tasks"]] == [task.id for task in workbook.tasks]


def test_guides_change_the_tasks() -> None:
    guided = workbook_of({"scene": "base-pendulum", "guides": [{"coordinate": "y", "value": "0.1*sin(3*t)"}]})
    ids = [task.id for task in guided.tasks]
    assert "equation:phi" in ids
    assert "equation:y" not in ids


def test_unknown_task_names_the_nearest() -> None:
    with pytest.raises(UnknownNameError) as caught:
        workbook_of({"scene": "pendulum"}).task("equations:phi")
    (problem,) = caught.value.problems
    assert (problem.code, problem.pointer, problem.parameters["suggestion"]) == (
        "unknown-task",
        "/task",
        "equation:phi",
    )


def test_a_seed_draws_the_same_values_every_time_and_leaves_gravity() -> None:
    values = [
        {p.name: p.value for p in workbook_of({"scene": "double-pendulum", "seed": seed}).scene.parameters}
        for seed in ("ada", "ada", "emmy")
    ]
    assert values[0] == values[1] != values[2]
    assert {each["g"] for each in values} == {9.81}


@pytest.mark.parametrize(
    ("scene", "language", "axes"),
    [
        ("pendulum", "en", "In the drawing $x$ points to the right, $y$ downwards; the origin is: pivot."),
        ("pendulum", "de", "In der Zeichnung zeigt $x$ nach rechts, $y$ nach unten; der Bezugspunkt ist: Aufhängung."),
        ("foucault", "en", "In the drawing $x$ points to the right, $y$ upwards; the origin is: "),
        ("two-mass-oscillator", "en", "In the drawing $x$ points to the right, $y$ upwards."),
        ("spherical-pendulum", "en", "In the drawing $z$ points downwards; the origin is: pivot."),
        ("heavy-top", "en", "In the drawing $z$ points upwards; the origin is: "),
    ],
)
@pytest.mark.parametrize("kind", ["position", "virtual-displacement"])
def test_a_vector_is_asked_for_in_axes_that_are_told(scene: str, language: str, axes: str, kind: str) -> None:
    workbook = workbook_of({"scene": scene})
    task = next(each for each in workbook.tasks if each.quantity.kind == kind)
    assert axes in str(task_document(task, workbook, language)["statement"])
