"""The OpenAPI document as a client reads it: names, subjects, examples and failures."""

from __future__ import annotations

import asyncio
import re
from collections.abc import Iterator
from threading import Thread, current_thread
from typing import Any

import httpx
import pytest
from fastapi import FastAPI
from fastapi.openapi.utils import get_openapi
from tests.description import openapi

from deltaq.api.description import SUBJECTS
from deltaq.api.samples import SHOWN, literal

Json = dict[str, Any]
ADDRESS = "/api/v1/openapi.json"


@pytest.fixture(scope="module")
def document() -> Json:
    return openapi()


def operations(document: Json) -> Iterator[tuple[str, str, Json]]:
    for path, methods in document["paths"].items():
        for method, operation in methods.items():
            yield method, path, operation


@pytest.mark.anyio
async def test_nobody_waits_while_the_description_is_made(
    app: FastAPI, client: httpx.AsyncClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Who asks first has it made, in a thread; who asks again is told that nothing has changed."""
    threads = list[Thread]()

    def making(**given: Any) -> Json:
        threads.append(current_thread())
        return get_openapi(**given)

    monkeypatch.setattr(app, "openapi_schema", None)
    monkeypatch.setattr("fastapi.applications.get_openapi", making)
    answers = await asyncio.gather(*(client.get(ADDRESS) for _ in range(3)))
    assert len(threads) == 1
    assert threads != [current_thread()]
    assert {answer.json()["openapi"] for answer in answers} == {"3.1.0"}
    again = await client.get(ADDRESS, headers={"If-None-Match": answers[0].headers["ETag"]})
    assert (again.status_code, again.content) == (304, b"")


def test_operations_have_short_names_of_their_own(document: Json) -> None:
    names = [operation["operationId"] for _, _, operation in operations(document)]
    assert len(names) == len(set(names))
    assert [name for name in names if not re.fullmatch(r"[a-z]+(_[a-z]+){0,4}", name)] == []
    assert set(SHOWN) <= set(names)


def test_every_operation_belongs_to_one_subject_that_is_described(document: Json) -> None:
    assert [tag["name"] for tag in document["tags"]] == list(SUBJECTS)
    assert {subject for _, _, operation in operations(document) for subject in operation["tags"]} == set(SUBJECTS)
    assert {len(operation["tags"]) for _, _, operation in operations(document)} == {1}


def test_summaries_are_the_beginnings_of_the_descriptions(document: Json) -> None:
    for _, _, operation in operations(document):
        assert operation["description"].startswith(operation["summary"])
        assert 10 < len(operation["summary"]) < 110


def test_every_failure_is_a_problem_document_and_nothing_else(document: Json) -> None:
    expected = {"application/problem+json": {"schema": {"$ref": "#/components/schemas/ProblemDocument"}}}
    for _, path, operation in operations(document):
        failures = {status: answer for status, answer in operation["responses"].items() if status != "200"}
        assert "default" in failures, path
        assert [status for status, answer in failures.items() if answer["content"] != expected] == []


def test_bodies_may_be_faulty_and_computations_too_large(document: Json) -> None:
    for method, path, operation in operations(document):
        statuses = set(operation["responses"])
        if method == "post":
            assert {"400", "413", "422", "429", "503", "504"} <= statuses, path
        if operation.get("parameters", []) != [] and "{" not in path:
            assert "422" in statuses, path


def test_all_references_lead_somewhere(document: Json) -> None:
    models = set(re.findall(r"#/components/schemas/(\w+)", str(document)))
    assert models <= set(document["components"]["schemas"])


def test_samples_hold_no_gap(document: Json) -> None:
    for _, path, operation in operations(document):
        assert [sample["lang"] for sample in operation["x-codeSamples"]] == ["Shell", "Python"]
        shell, python = (sample["source"] for sample in operation["x-codeSamples"])
        assert "{identifier}" not in shell + python, path
        compile(python, path, "exec")


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        pytest.param({"a": [1, 2.5, None, True]}, '{"a": [1, 2.5, None, True]}', id="short"),
        pytest.param("\\ell φ\n", '"\\\\ell φ\\n"', id="text"),
        pytest.param({"a": "x" * 100}, '{\n    "a": "' + "x" * 100 + '",\n}', id="long"),
        pytest.param([], "[]", id="nothing"),
    ],
)
def test_values_as_python_writes_them(value: object, expected: str) -> None:
    assert literal(value) == expected


def test_everything_that_may_be_asked_is_described(document: Json) -> None:
    models, asked = document["components"]["schemas"], set[str]()
    for _, path, operation in operations(document):
        assert [one["name"] for one in operation.get("parameters", []) if not one.get("description")] == [], path
        asked |= models_in(operation.get("requestBody", {}), models)
    fields = {(name, field): one for name in asked for field, one in models[name].get("properties", {}).items()}
    assert [place for place, field in fields.items() if not field.get("description")] == []


def models_in(schema: object, models: Json) -> set[str]:
    """The models that a schema leads to."""
    found: set[str] = set()
    waiting = set(re.findall(r"#/components/schemas/(\w+)", str(schema)))
    while waiting:
        name = waiting.pop()
        found.add(name)
        waiting |= set(re.findall(r"#/components/schemas/(\w+)", str(models[name]))) - found
    return found


# Where anything may stand, and why.
ANYTHING = {
    "Draft/anyOf/2": "a scene that is being written may lack whatever a scene needs",
    "validate_scene/body/anyOf/1": "the same",
}
SAYING = {"type", "$ref", "anyOf", "oneOf", "allOf", "enum", "const"}


def anything(schema: Json, where: str) -> Iterator[str]:
    """The places of a schema where anything may stand: objects without members that are named, and what has no type."""
    others = schema.get("additionalProperties")
    if not SAYING & schema.keys() or (schema.get("type") == "object" and "properties" not in schema and not others):
        yield where
    if others is True and "properties" not in schema:
        yield where
    if schema.get("type") == "array" and not {"items", "prefixItems"} & schema.keys():
        yield where
    inside = {f"properties/{name}": one for name, one in schema.get("properties", {}).items()}
    inside |= {f"{kind}/{n}": one for kind in ("anyOf", "oneOf", "allOf") for n, one in enumerate(schema.get(kind, ()))}
    inside |= {f"prefixItems/{n}": one for n, one in enumerate(schema.get("prefixItems", ()))}
    inside |= {kind: schema[kind] for kind in ("items", "additionalProperties") if isinstance(schema.get(kind), dict)}
    for place, one in inside.items():
        yield from anything(one, f"{where}/{place}")


def test_nothing_is_an_open_object_but_what_is_named_here(document: Json) -> None:
    found = [place for name, one in document["components"]["schemas"].items() for place in anything(one, name)]
    for _, _, operation in operations(document):
        contents = {"answer": operation["responses"]["200"].get("content", {})}
        contents["body"] = operation.get("requestBody", {}).get("content", {})
        for side, content in contents.items():
            for one in content.values():
                found += anything(one["schema"], f"{operation['operationId']}/{side}")
    assert set(found) == set(ANYTHING)


@pytest.mark.parametrize(
    "schema",
    [
        {},
        {"title": "X"},
        {"type": "object"},
        {"type": "object", "additionalProperties": True},
        {"type": "object", "additionalProperties": {}},
        {"type": "array"},
        {"type": "array", "items": {"anyOf": [{"type": "object"}, {"type": "null"}]}},
        {"properties": {"a": {"prefixItems": [{}], "type": "array"}}, "type": "object"},
    ],
)
def test_an_open_object_is_noticed(schema: Json) -> None:
    assert list(anything(schema, "x"))
