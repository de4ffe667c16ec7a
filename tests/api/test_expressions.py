from __future__ import annotations

from dataclasses import replace
from typing import Any

import httpx
import pytest

from deltaq.api.routes import expressions

pytestmark = pytest.mark.anyio
EXPRESSIONS = "/api/v1/expressions"
FAULTY = {"coordinates": [{"name": "s"}, {"name": 3}], "parameters": [{"name": "k", "latex": "\\kappa"}], "bodies": 7}


@pytest.mark.parametrize(
    ("body", "latex", "plain", "spoken"),
    [
        pytest.param(
            {"scene": "pendulum", "expression": "l*sin(phi)"},
            "\\ell \\sin\\varphi",
            "l*sin(phi)",
            "l times sine of phi",
            id="plain",
        ),
        pytest.param(
            {"scene": "pendulum", "expression": "\\ell\\dot\\varphi", "syntax": "latex"},
            "\\ell \\dot{\\varphi}",
            "l*dot(phi)",
            "l phi dot",
            id="LaTeX",
        ),
        pytest.param({"scene": FAULTY, "expression": "k*s"}, "\\kappa s", "k*s", "kappa s", id="faulty document"),
        pytest.param(
            {"scene": "pendulum", "expression": "l*s", "material": ["s"]},
            "\\ell s",
            "l*s",
            "l s",
            id="material coordinate",
        ),
    ],
)
async def test_expression_is_typeset(
    client: httpx.AsyncClient, body: dict[str, Any], latex: str, plain: str, spoken: str
) -> None:
    response = await client.post(EXPRESSIONS, json=body)
    assert (response.status_code, response.json()) == (200, {"latex": latex, "plain": plain, "spoken": spoken})


async def test_mistake_has_its_place(client: httpx.AsyncClient) -> None:
    body = {"scene": "pendulum", "expression": "2*mas", "lang": "en"}
    response = await client.post(EXPRESSIONS, json=body)
    assert response.status_code == 422
    (problem,) = response.json()["problems"]
    assert (problem["pointer"], problem["offset"], problem["length"]) == ("/expression", 2, 3)
    assert problem["code"] == "unknown-name"


async def test_batch_answers_each_text(client: httpx.AsyncClient) -> None:
    texts = [{"expression": "m*g"}, {"expression": "m*"}, {"expression": "cos(phi)^2"}]
    response = await client.post(f"{EXPRESSIONS}/batch", json={"scene": "pendulum", "expressions": texts, "lang": "en"})
    assert response.status_code == 200
    first, second, third = response.json()["expressions"]
    assert first == {"latex": "m g", "plain": "m*g", "spoken": "m g", "problems": []}
    assert second["latex"] == ""
    assert [(one["code"], one["offset"]) for one in second["problems"]] == [("unexpected-end", 2)]
    assert third["latex"] == "\\cos^{2}\\varphi"


async def test_unknown_scene(client: httpx.AsyncClient) -> None:
    response = await client.post(EXPRESSIONS, json={"scene": "nowhere", "expression": "1"})
    assert (response.status_code, response.json()["problems"][0]["pointer"]) == (404, "/scene")


async def test_text_that_costs_too_much_is_refused(client: httpx.AsyncClient, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(expressions, "ONE", replace(expressions.ONE, processor=0.0))
    response = await client.post(EXPRESSIONS, json={"scene": "pendulum", "expression": "l*sin(phi)^7"})
    assert (response.status_code, response.json()["type"]) == (504, "/problems/computation-too-large")


async def test_each_text_of_many_has_its_time(client: httpx.AsyncClient, monkeypatch: pytest.MonkeyPatch) -> None:
    texts = [{"expression": f"atan2(phi, {n} + m) * sqrt(m + {n})"} for n in range(100)]
    body = {"scene": "pendulum", "expressions": texts}
    monkeypatch.setattr(expressions, "READING", 0.0)
    assert (await client.post(f"{EXPRESSIONS}/batch", json=body)).status_code == 504
    monkeypatch.setattr(expressions, "READING", 0.2)
    assert (await client.post(f"{EXPRESSIONS}/batch", json=body)).status_code == 200


async def test_no_texts_are_read_too(client: httpx.AsyncClient) -> None:
    response = await client.post(f"{EXPRESSIONS}/batch", json={"scene": "pendulum", "expressions": []})
    assert (response.status_code, response.json()) == (200, {"expressions": []})
