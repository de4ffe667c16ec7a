from __future__ import annotations

from typing import Any

import httpx
import pytest
from fastapi import FastAPI

from deltaq.contract.check import CheckRequest
from deltaq.contract.task import TaskList
from deltaq.contract.verdict import VerdictAnswer

pytestmark = pytest.mark.anyio
API = "/api/v1"
EXAMPLES = CheckRequest.model_config["json_schema_extra"]["examples"]  # type: ignore[index, call-overload]


async def test_tasks_of_a_built_in_scene(client: httpx.AsyncClient) -> None:
    response = await client.get(f"{API}/scenes/elastic-pendulum/tasks", params={"lang": "de", "seed": "ada"})
    assert response.status_code == 200, response.text
    found = TaskList.model_validate(response.json())
    ids = {task.id for task in found.tasks}
    assert {"position:bob", "virtual-work", "generalized-force:y", "equations"} <= ids
    assert found.tasks[0].title == "Ort: Masse"
    assert found.scene["drawing"]["elements"]


async def test_tasks_of_a_changed_scene(client: httpx.AsyncClient) -> None:
    guides = [{"coordinate": "y", "value": "0.1*sin(3*t)"}]
    response = await client.post(f"{API}/tasks", json={"scene": "base-pendulum", "guides": guides})
    assert response.status_code == 200, response.text
    assert "equation:y" not in {task["id"] for task in response.json()["tasks"]}


@pytest.mark.parametrize("number", range(len(EXAMPLES)))
async def test_examples_of_the_documentation_work(client: httpx.AsyncClient, number: int) -> None:
    response = await client.post(f"{API}/checks", json=EXAMPLES[number])
    assert response.status_code == 200, response.text
    verdict = VerdictAnswer.model_validate(response.json())
    assert verdict.outcome == ("wrong" if number == 1 else "correct")
    assert verdict.misconception == ("half-in-kinetic-energy" if number == 1 else None)


BASE: dict[str, Any] = {"scene": "pendulum", "task": "equation:phi", "answer": {"value": "ddot(phi) = 0"}}


async def test_wrong_answer_has_feedback_and_a_counterexample(client: httpx.AsyncClient) -> None:
    response = await client.post(f"{API}/checks", json=BASE | {"lang": "en"})
    verdict = response.json()
    assert (verdict["outcome"], verdict["understood_as"]) == ("wrong", r"\ddot{\varphi} = 0")
    assert verdict["counterexample"]["yours"] != verdict["counterexample"]["right"]
    assert verdict["feedback"].startswith("Not right yet. ")


async def test_unreadable_answer_is_a_verdict_with_an_offset(client: httpx.AsyncClient) -> None:
    response = await client.post(f"{API}/checks", json=BASE | {"answer": {"value": "ddot(phi) = foo"}, "lang": "de"})
    verdict = response.json()
    assert (response.status_code, verdict["outcome"], verdict["offset"]) == (200, "invalid", 12)
    assert "foo" in verdict["problems"][0]["message"]


@pytest.mark.parametrize(
    ("change", "status", "pointer", "code"),
    [
        pytest.param({"task": "equation:psi"}, 404, "/task", "unknown-task", id="task"),
        pytest.param({"scene": "pendulun"}, 404, "/scene", "unknown-scene", id="scene"),
        pytest.param({"answer": {"value": 3}}, 422, "/answer/value", "request-not-text", id="not text"),
        pytest.param({"answer": {"value": "x" * 2001}}, 422, "/answer/value", "request-text-too-long", id="long"),
        pytest.param({"extra": 1}, 422, "/extra", "unknown-field", id="unknown field"),
    ],
)
async def test_wrong_question(
    client: httpx.AsyncClient, change: dict[str, Any], status: int, pointer: str, code: str
) -> None:
    response = await client.post(f"{API}/checks", json=BASE | change)
    assert response.status_code == status, response.text
    assert (pointer, code) in [(one["pointer"], one["code"]) for one in response.json()["problems"]]


async def test_batch_answers_in_order(client: httpx.AsyncClient) -> None:
    checks = [BASE, BASE | {"answer": {"value": "ddot(phi) = -g/l*sin(phi)"}}]
    response = await client.post(f"{API}/checks/batch", json={"checks": checks})
    assert [verdict["outcome"] for verdict in response.json()["verdicts"]] == ["wrong", "correct"]


async def test_checks_of_a_batch_are_those_that_are_asked_one_by_one(client: httpx.AsyncClient, app: FastAPI) -> None:
    one = BASE | {"answer": {"value": "l*ddot(phi) = -2*g*sin(phi)"}}
    alone = (await client.post(f"{API}/checks", json=one)).json()
    misses = app.state.service.cache.misses
    together = (await client.post(f"{API}/checks/batch", json={"checks": [one, one]})).json()
    assert together == {"verdicts": [alone, alone]}
    assert app.state.service.cache.misses == misses


@pytest.mark.parametrize("change", [{"task": "equation:psi"}, {"scene": "pendulun"}], ids=["task", "scene"])
async def test_wrong_question_in_a_batch(client: httpx.AsyncClient, change: dict[str, Any]) -> None:
    response = await client.post(f"{API}/checks/batch", json={"checks": [BASE, BASE | change]})
    assert response.status_code == 404
    assert [one["pointer"] for one in response.json()["problems"]] == [f"/checks/1/{next(iter(change))}"]


async def test_batch_is_bounded(client: httpx.AsyncClient) -> None:
    response = await client.post(f"{API}/checks/batch", json={"checks": [BASE] * 65})
    assert (response.status_code, response.json()["problems"][0]["code"]) == (422, "request-too-many")


WORKING = [
    {"task": "kinetic-energy", "answer": {"value": "m*l^2*dot(phi)^2"}},
    {"task": "equation:phi", "answer": {"value": "2*m*l^2*ddot(phi) + m*g*l*sin(phi) = 0"}},
]


async def test_previous_lines_make_a_consequence(client: httpx.AsyncClient) -> None:
    alone = await client.post(f"{API}/checks", json={"scene": "pendulum", **WORKING[1]})
    after = await client.post(f"{API}/checks", json={"scene": "pendulum", **WORKING[1], "previous": WORKING[:1]})
    assert [alone.json()["outcome"], after.json()["outcome"]] == ["wrong", "follow_through"]


async def test_a_working_is_marked(client: httpx.AsyncClient) -> None:
    scheme = {"points": {"equation:phi": 4.0}, "follow_through": 0.25}
    response = await client.post(f"{API}/checks/lines", json={"scene": "pendulum", "lines": WORKING, "scheme": scheme})
    assert response.status_code == 200, response.text
    answer = response.json()
    assert [line["outcome"] for line in answer["lines"]] == ["wrong", "follow_through"]
    assert (answer["first_wrong"], answer["points"], answer["of"]) == (0, 1.0, 6.0)


async def test_export_for_stack(client: httpx.AsyncClient) -> None:
    response = await client.post(f"{API}/tasks/stack", json={"scene": "pendulum", "tasks": ["equation:phi"]})
    assert (response.status_code, response.headers["content-type"]) == (200, "application/xml")
    assert response.text.count('<question type="stack">') == 1


SHEET: dict[str, Any] = {
    "format": 1,
    "individual": True,
    "tasks": [{"scene": "pendulum", "task": "equation:phi", "points": 5}, {"scene": "atwood", "task": "lagrangian"}],
}


async def test_an_assignment_is_opened_with_each_students_values(client: httpx.AsyncClient) -> None:
    sheets = [
        (await client.post(f"{API}/assignments", json={"assignment": SHEET, "seed": seed})).json()
        for seed in ("ada", "emmy")
    ]
    assert [[entry["task"]["points"] for entry in sheet["tasks"]] for sheet in sheets] == [[5, 1], [5, 1]]
    assert sheets[0]["tasks"][1]["scene"]["parameters"] != sheets[1]["tasks"][1]["scene"]["parameters"]


async def test_a_wrong_assignment_points_at_its_field(client: httpx.AsyncClient) -> None:
    sheet = {"format": 1, "tasks": [{"scene": "pendulum", "task": "equation:psi"}]}
    response = await client.post(f"{API}/assignments", json={"assignment": sheet})
    found = [(one["pointer"], one["code"]) for one in response.json()["problems"]]
    assert (response.status_code, found) == (404, [("/assignment/tasks/0/task", "unknown-task")])


async def test_an_answer_is_read_without_a_verdict(client: httpx.AsyncClient) -> None:
    answers = ["T = m*l^2*phi'^2", "m*l^2*foo"]
    read = [
        (
            await client.post(
                f"{API}/checks/reading", json={"scene": "pendulum", "task": "kinetic-energy", "answer": {"value": one}}
            )
        ).json()
        for one in answers
    ]
    assert (read[0]["plain"], read[0]["problems"]) == ("m*l^2*dot(phi)^2", [])
    assert (read[1]["latex"], read[1]["problems"][0]["offset"]) == ("", 6)


async def test_solution_and_the_step_that_shows_it(client: httpx.AsyncClient) -> None:
    question = {"scene": "guided-pendulum", "lang": "en"}
    listed = (await client.post(f"{API}/tasks", json=question)).json()["tasks"]
    chapters = (await client.post(f"{API}/derivations", json=question)).json()["chapters"]
    steps = {chapter["id"]: [step["id"] for step in chapter["steps"]] for chapter in chapters}
    shown = {task["id"]: set(task["solution"]["steps"]) & set(steps[task["solution"]["chapter"]]) for task in listed}
    assert shown["position:bob"] == {"guided-position:bob", "position:bob"}
    assert [task for task, found in shown.items() if not found] == ["kinetic-energy"]  # of one body: its own step
    solution = await client.post(f"{API}/tasks/solution", json=question | {"task": "generalized-force:phi"})
    assert solution.json()["plain"] == ["-m*g*l*sin(phi)"]


async def test_the_motion_of_an_answer_can_be_simulated(client: httpx.AsyncClient) -> None:
    question = BASE | {"answer": {"value": "l*ddot(phi) = g*sin(phi)"}}
    moved = (await client.post(f"{API}/checks/motion", json=question)).json()["scene"]
    run = (await client.post(f"{API}/simulations", json={"scene": moved, "t_end": 1.0, "samples": 3})).json()
    assert run["status"] == "ok"
    assert run["coordinates"]["phi"][1] > run["coordinates"]["phi"][0]


async def test_an_answer_without_a_motion(client: httpx.AsyncClient) -> None:
    response = await client.post(f"{API}/checks/motion", json=BASE | {"answer": {"value": "phi = 0"}, "lang": "de"})
    found = [(one["pointer"], one["code"]) for one in response.json()["problems"]]
    assert (response.status_code, found) == (422, [("/answer/value", "motion-not-solvable")])


HALF_ANGLE: dict[str, Any] = {
    "scene": "pendulum",
    "task": "potential-energy",
    "answer": {"value": "2 m g l sin^2 phi/2"},
}


@pytest.mark.parametrize("lang", ["de", "en"])
async def test_the_reading_taken_is_told_beside_the_others(client: httpx.AsyncClient, lang: str) -> None:
    verdict = VerdictAnswer.model_validate(
        (await client.post(f"{API}/checks", json=HALF_ANGLE | {"lang": lang})).json()
    )
    assert verdict.outcome == "correct"
    assert [(one.plain, one.taken) for one in verdict.readings] == [
        ("m*g*l*sin(phi)^2", False),
        ("2*m*g*l*sin(phi/2)^2", True),
    ]
    read = (await client.post(f"{API}/checks/reading", json=HALF_ANGLE | {"lang": lang})).json()
    assert [one["plain"] for one in read["readings"]] == [one.plain for one in verdict.readings]
    checks = [{name: HALF_ANGLE[name] for name in ("scene", "task", "answer")}]
    batch = (await client.post(f"{API}/checks/batch", json={"checks": checks, "lang": lang})).json()
    assert batch["verdicts"][0]["readings"] == [one.model_dump() for one in verdict.readings]


@pytest.mark.parametrize(
    ("answer", "outcome"),
    [("2T = m*l^2*phi'^2", "correct"), ("2T = 1/2*m*l^2*phi'^2", "wrong"), ("0,5*m*l^2*phi'^2", "correct")],
)
async def test_habits_are_read_over_http(client: httpx.AsyncClient, answer: str, outcome: str) -> None:
    asked = {"scene": "pendulum", "task": "kinetic-energy", "answer": {"value": answer}, "lang": "de"}
    verdict = (await client.post(f"{API}/checks", json=asked)).json()
    assert (verdict["outcome"], verdict["readings"]) == (outcome, [])


@pytest.mark.parametrize(("lang", "member"), [("de", "dieses Glied"), ("en", "this member")])
async def test_a_broken_chain_is_told(client: httpx.AsyncClient, lang: str, member: str) -> None:
    value = "T = m*l^2*phi'^2 = 1/2*m*l^2*phi'^2"
    asked = {"scene": "pendulum", "task": "kinetic-energy", "answer": {"value": value}, "lang": lang}
    verdict = (await client.post(f"{API}/checks", json=asked)).json()
    assert (verdict["outcome"], verdict["remark"]) == ("wrong", "chain")
    assert member in verdict["feedback"]
    assert r"m \ell^{2} \dot{\varphi}^{2}" in verdict["feedback"]
