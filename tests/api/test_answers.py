"""Answers hold what the OpenAPI document describes, and nothing that it is silent about."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import httpx
import pytest
from fastapi import FastAPI

pytestmark = pytest.mark.anyio

Json = dict[str, Any]
RIGHT = {"syntax": "plain", "value": "m*l^2*dot(phi)^2/2"}
WRONG = {"syntax": "plain", "value": "m*l^2*dot(phi)^2"}
TASK = {"scene": "pendulum", "task": "kinetic-energy"}


def resolved(schema: Json, models: dict[str, Json]) -> Json:
    """What a reference refers to."""
    return models[schema["$ref"].rpartition("/")[2]] if "$ref" in schema else schema


def allows(schema: Json, kind: str, models: dict[str, Json]) -> bool:
    """Whether a schema is one of arrays, or of objects, or has one among its choices; who names no type has objects."""
    schema = resolved(schema, models)
    choices = schema.get("anyOf")
    return any(allows(one, kind, models) for one in choices) if choices else schema.get("type", "object") == kind


def silent(answer: object, schema: Json, models: dict[str, Json], where: str = "") -> Iterator[str]:
    """Pointers to members of an answer of which its description says nothing; a list stands for all its entries."""
    schema = resolved(schema, models)
    if "anyOf" in schema and isinstance(answer, dict | list):
        kind = "array" if isinstance(answer, list) else "object"
        yield from silent(answer, next(one for one in schema["anyOf"] if allows(one, kind, models)), models, where)
    elif isinstance(answer, dict):
        described, others = schema.get("properties", {}), schema.get("additionalProperties")
        for name, member in answer.items():
            if name in described or isinstance(others, dict):
                yield from silent(member, described.get(name, others), models, f"{where}/{name}")
            elif described:
                yield f"{where}/{name}"
    elif isinstance(answer, list):
        for entry in answer:
            yield from silent(entry, schema.get("items", {}), models, where)


@pytest.mark.parametrize(
    ("path", "body"),
    [
        pytest.param("derivations", {"scene": "elastic-pendulum"}, id="modes"),
        pytest.param("derivations", {"scene": "spherical-pendulum"}, id="a cyclic coordinate"),
        pytest.param("derivations", {"scene": "quarter-car", "formulation": "hamilton"}, id="complex modes"),
        pytest.param("simulations", {"scene": "elastic-pendulum", "t_end": 1, "samples": 3}, id="motion"),
        pytest.param("simulations", {"scene": "pendulum", "t_end": 1, "samples": 3, "step": 0.1}, id="fixed steps"),
        pytest.param("tasks", {"scene": "pendulum"}, id="tasks"),
        pytest.param("tasks/solution", TASK, id="solution"),
        pytest.param("checks", TASK | {"answer": RIGHT}, id="right"),
        pytest.param("checks", TASK | {"answer": WRONG}, id="wrong"),
        pytest.param("checks/reading", TASK | {"answer": WRONG}, id="reading"),
        pytest.param("checks/motion", TASK | {"answer": WRONG}, id="motion of an answer"),
        pytest.param(
            "checks/lines", {"scene": "pendulum", "lines": [{"task": TASK["task"], "answer": WRONG}]}, id="lines"
        ),
        pytest.param("variations", {"expression": "x^2", "functions": ["x"]}, id="variation"),
        pytest.param(
            "variations",
            {"expression": "x", "functions": ["x"], "parameters": ["a"], "functional": {"kind": "value", "at": "a"}},
            id="variation of a value",
        ),
        pytest.param(
            "variations",
            {
                "expression": "ddot(x)^2 + dot(y)^2",
                "functions": ["x", "y"],
                "functional": {"kind": "integral", "from": "0", "to": "1", "ends": "free"},
            },
            id="variation of an integral",
        ),
        pytest.param("expressions", {"scene": "pendulum", "expression": "m*g"}, id="expression"),
        pytest.param("scenes/validate", {"format": 1}, id="problems"),
    ],
)
async def test_every_member_is_described(client: httpx.AsyncClient, app: FastAPI, path: str, body: Json) -> None:
    answer = await client.post(f"/api/v1/{path}", json=body)
    assert answer.status_code == 200, answer.text
    document = app.openapi()
    described = document["paths"][f"/api/v1/{path}"]["post"]["responses"]["200"]["content"]["application/json"]
    assert sorted(set(silent(answer.json(), described["schema"], document["components"]["schemas"]))) == []


def test_what_is_not_described_is_noticed() -> None:
    models: dict[str, Json] = {"A": {"properties": {"x": {"type": "string"}}}}
    schema = {"properties": {"a": {"anyOf": [{"$ref": "A"}, {"type": "null"}]}, "b": {"items": {"$ref": "A"}}}}
    assert list(silent({"a": {"x": 1, "y": 2}, "b": [{"z": 1}], "c": 1}, schema, models)) == ["/a/y", "/b/z", "/c"]
