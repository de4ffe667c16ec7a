"""Exercises drawn at random, and their answers checked with the document that came with them."""

from __future__ import annotations

import httpx
import pytest

from deltaq.contract.task import PracticeAnswer

pytestmark = pytest.mark.anyio
PRACTICE = "/api/v1/practice"


async def test_an_exercise_is_answered_with_its_document(client: httpx.AsyncClient) -> None:
    response = await client.post(PRACTICE, json={"seed": "ada", "level": 2, "number": 3, "lang": "de"})
    assert response.status_code == 200, response.text
    found = PracticeAnswer.model_validate(response.json())
    assert (found.level, found.recalled) == (2, None)
    question = {"scene": found.scene, "task": found.task.id}
    right = (await client.post("/api/v1/tasks/solution", json=question)).json()["plain"]
    checked = await client.post("/api/v1/checks", json={**question, "answer": {"value": "; ".join(right)}})
    assert checked.json()["outcome"] == "correct", checked.text


async def test_the_same_exercise_in_either_language(client: httpx.AsyncClient) -> None:
    answers = [
        (await client.post(PRACTICE, json={"seed": "ada", "level": 3, "number": 2, "lang": lang})).json()
        for lang in ("de", "en", "de")
    ]
    assert answers[0] == answers[2]
    assert answers[0]["scene"] == answers[1]["scene"]
    assert answers[0]["task"]["id"] == answers[1]["task"]["id"]
    assert answers[0]["task"]["statement"] != answers[1]["task"]["statement"]


@pytest.mark.parametrize(
    ("body", "status", "pointer"),
    [
        pytest.param({}, 422, "/seed", id="no seed"),
        pytest.param({"seed": "ada", "level": 7}, 422, "/level", id="level"),
        pytest.param({"seed": "ada", "number": 0}, 422, "/number", id="number"),
        pytest.param({"seed": "ada", "recall": "gravity-sing"}, 404, "/recall", id="misconception"),
    ],
)
async def test_wrong_question(client: httpx.AsyncClient, body: dict[str, object], status: int, pointer: str) -> None:
    response = await client.post(PRACTICE, json=body)
    assert response.status_code == status, response.text
    assert [one["pointer"] for one in response.json()["problems"]] == [pointer]
