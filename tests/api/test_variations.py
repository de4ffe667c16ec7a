from __future__ import annotations

from typing import Any

import httpx
import pytest

from deltaq.contract.variation import VariationAnswer, VariationRequest

pytestmark = pytest.mark.anyio
VARIATIONS = "/api/v1/variations"
EXAMPLES = VariationRequest.model_config["json_schema_extra"]["examples"]  # type: ignore[index, call-overload]


@pytest.mark.parametrize("number", range(len(EXAMPLES)))
async def test_examples_of_the_documentation_work(client: httpx.AsyncClient, number: int) -> None:
    schema = (await client.get("/api/v1/openapi.json")).json()["components"]["schemas"]["VariationRequest"]
    response = await client.post(VARIATIONS, json=schema["examples"][number])
    assert response.status_code == 200, response.text
    answer = VariationAnswer.model_validate(response.json())
    assert all(step.verified for chapter in answer.chapters for step in chapter.steps)
    assert response.headers["etag"] == f'"{answer.id}"'


async def test_language_of_the_answer(client: httpx.AsyncClient) -> None:
    question = {"expression": "x", "functions": ["x"]}
    german, english = [(await client.post(VARIATIONS, json=question | {"lang": lang})).json() for lang in ("de", "en")]
    assert german["result"] == english["result"]
    assert german["chapters"][0]["title"] != english["chapters"][0]["title"]


BASE = {"expression": "x", "functions": ["x"]}


@pytest.mark.parametrize(
    ("question", "pointer", "code"),
    [
        pytest.param({"functions": ["x"]}, "/expression", "missing-field", id="no expression"),
        pytest.param({**BASE, "functions": []}, "/functions", "request-too-few", id="no function"),
        pytest.param({**BASE, "functions": ["x"] * 9}, "/functions", "request-too-many", id="too many functions"),
        pytest.param({**BASE, "expression": "x" * 2001}, "/expression", "request-text-too-long", id="too long"),
        pytest.param({**BASE, "extra": 1}, "/extra", "unknown-field", id="unknown field"),
        pytest.param({**BASE, "expression": "x +"}, "/expression", "unexpected-end", id="syntax"),
        pytest.param({**BASE, "syntax": "python"}, "/syntax", "request-not-one-of", id="unknown syntax"),
        pytest.param({**BASE, "include": ["all"]}, "/include/0", "request-not-one-of", id="unknown part"),
        pytest.param({**BASE, "direction": ["t"]}, "/direction/0", "reserved-name", id="direction called t"),
        pytest.param(
            {**BASE, "functional": {"kind": "value", "at": "x"}}, "/functional/at", "instant-not-constant", id="instant"
        ),
    ],
)
async def test_wrong_question(client: httpx.AsyncClient, question: dict[str, Any], pointer: str, code: str) -> None:
    response = await client.post(VARIATIONS, json=question)
    assert response.headers["content-type"] == "application/problem+json"
    assert response.status_code == 422
    found = [(one["pointer"], one["code"]) for one in response.json()["problems"]]
    assert (pointer, code) in found


async def test_problem_has_an_offset_and_a_sentence(client: httpx.AsyncClient) -> None:
    response = await client.post(VARIATIONS, json={**BASE, "expression": "x + foo", "lang": "de"})
    (problem,) = response.json()["problems"]
    assert (problem["offset"], problem["length"]) == (4, 3)
    assert problem["message"].startswith("„foo“")


@pytest.mark.parametrize(
    "text",
    [
        pytest.param("__import__('os').system('id')", id="code"),
        pytest.param("10^10^10", id="tower"),
        pytest.param("((((x+1)^64)^64)^64)", id="powers"),
        pytest.param("(" * 900 + "x" + ")" * 900, id="brackets"),
    ],
)
@pytest.mark.parametrize("field", ["expression", "at"])
async def test_hostile_text_is_refused(client: httpx.AsyncClient, field: str, text: str) -> None:
    question = {**BASE, "functional": {"kind": "value", "at": text}} if field == "at" else {**BASE, "expression": text}
    response = await client.post(VARIATIONS, json=question)
    assert response.status_code == 422
