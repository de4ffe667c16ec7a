"""Requests are read by their declarations, whoever asks: each bound is held, and told with the field it belongs to."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from pydantic import TypeAdapter

import deltaq
from deltaq.contract.base import Request
from deltaq.contract.check import LinesRequest
from deltaq.contract.experiments.stability_map import StabilityMapRequest
from deltaq.contract.reading import read, validated
from deltaq.contract.variation import VariationRequest
from deltaq.errors import Problem, RequestError
from deltaq.narration.catalog import LANGUAGES, message
from deltaq.packages import modules_of

SIDES = {
    "minimum": ("ge", "request-too-small", -1),
    "maximum": ("le", "request-too-large", 1),
    "exclusiveMinimum": ("gt", "request-not-above", 0),
    "exclusiveMaximum": ("lt", "request-not-below", 0),
}


def requests() -> Iterator[type[Request]]:
    """All bodies that the API takes: requests with an example."""
    for package in ("deltaq.contract", "deltaq.contract.experiments"):
        for module in modules_of(package):
            kinds = [kind for kind in vars(module).values() if isinstance(kind, type) and issubclass(kind, Request)]
            yield from (kind for kind in kinds if kind.__module__ == module.__name__ and examples(kind))


def examples(kind: type[Request]) -> list[dict[str, Any]]:
    return (kind.model_config.get("json_schema_extra") or {}).get("examples", [])  # type: ignore[union-attr,return-value]


Bound = tuple[str, str, float, dict[str, Any]]


def bounds(kind: type[Request]) -> Iterator[Bound]:
    """Each bound of each number of a request: field, keyword of JSON Schema, bound, and the schema that has it."""
    for name, field in kind.model_json_schema()["properties"].items():
        for schema in (field, *field.get("anyOf", ())):
            yield from ((name, side, schema[side], schema) for side in SIDES if side in schema)


@pytest.fixture
def bounded(kind: type[Request]) -> list[Bound]:
    """The bounds of a request, made when a test runs: whoever only collects the tests makes no schemas."""
    return list(bounds(kind))


EACH = pytest.mark.parametrize("kind", list(requests()), ids=lambda kind: kind.__name__)


def beyond(side: str, bound: float, schema: dict[str, Any]) -> float:
    """The least number that is out of bounds, or one close to it."""
    step = SIDES[side][2]
    return bound + step if schema["type"] == "integer" or not bound else bound + step * 1e-3 * abs(bound)


def told(kind: type[Request], document: dict[str, Any]) -> tuple[Problem, Problem]:
    """What Python is told of a document, and what a call of the API is."""
    found = []
    for reading in (lambda: read(kind, document), lambda: validated(document, TypeAdapter(kind))):
        with pytest.raises(RequestError) as caught:
            reading()
        found += caught.value.problems
    return tuple(found)  # type: ignore[return-value]


@EACH
def test_a_number_out_of_bounds_is_told_with_both_of_them_or_with_the_one_that_was_passed(
    kind: type[Request], bounded: list[Bound]
) -> None:
    for field, side, bound, schema in bounded:
        short, code, _ = SIDES[side]
        value = beyond(side, bound, schema)
        own, called = told(kind, examples(kind)[0] | {field: value})
        assert (own.code, own.pointer) == ("request-outside", f"/{field}")
        assert float(own.parameters["value"]) == value
        limits = {own.parameters["min"], own.parameters["max"]}
        assert limits >= {schema[one] for one in SIDES if one in schema}
        assert own.parameters["min"] < own.parameters["max"]
        assert (called.code, called.pointer, called.parameters[short]) == (code, f"/{field}", bound)
        for problem in (own, called):
            assert all("{" not in message(language, problem) for language in LANGUAGES)


def test_there_are_bounds_to_be_held() -> None:
    assert sum(len(list(bounds(kind))) for kind in requests()) > 40


AXIS = {"parameter": "omega", "from": 1.0, "to": 2.0}


@pytest.mark.parametrize(
    ("kind", "fields", "problem"),
    [
        pytest.param(
            StabilityMapRequest,
            {"x": {**AXIS, "count": 401}},
            Problem("request-outside", "/x/count", parameters={"value": "401", "min": 8, "max": 400}),
            id="both bounds of a part",
        ),
        pytest.param(
            StabilityMapRequest,
            {"x": {**AXIS, "to": 0.5}},
            Problem("request-outside", "/x/to", parameters={"value": 0.5, "min": 1.0, "max": 1e9}),
            id="a bound by another field",
        ),
        pytest.param(
            LinesRequest,
            {"scheme": {"points": {"lagrangian": 2000.0}}},
            Problem("request-too-large", "/scheme/points/lagrangian", parameters={"le": 1000.0}),
            id="a value of a table, whose bounds no field has",
        ),
    ],
)
def test_what_is_wrong_further_inside(kind: type[Request], fields: dict[str, Any], problem: Problem) -> None:
    own, _ = told(kind, examples(kind)[0] | fields)
    assert own == problem


@EACH
def test_a_closed_bound_itself_may_be_asked_for(kind: type[Request], bounded: list[Bound]) -> None:
    for field, side, bound, _ in bounded:
        if side in ("minimum", "maximum"):
            assert getattr(read(kind, examples(kind)[0] | {"tolerance": None} | {field: bound}), field) == bound


@EACH
def test_every_example_is_a_request_and_a_field_that_is_null_was_not_given(kind: type[Request]) -> None:
    for document in examples(kind):
        empty = dict.fromkeys(kind.model_fields.keys() - document.keys())
        assert read(kind, {**empty, **document}) == read(kind, document)


TAKEN_APART = re.compile(r"\b(document|question|request|asked)(\.get\(|\[\")")
ANSWERING = ("narration", "simulation", "lab", "homework", "handout")
OWN = {"homework/motion.py"}  # a scene that it has written itself


def test_whoever_answers_reads_a_request_by_its_declaration_alone() -> None:
    package = Path(deltaq.__file__).parent
    files = [file for name in ANSWERING for file in (package / name).rglob("*.py")]
    found = {str(file.relative_to(package)) for file in files if TAKEN_APART.search(file.read_text(encoding="utf-8"))}
    assert found == OWN


@pytest.mark.parametrize("kind", list(requests()), ids=lambda kind: kind.__name__)
def test_an_unknown_field_is_refused(kind: type[Request]) -> None:
    for problem in told(kind, examples(kind)[0] | {"speed": 1}):
        assert problem == Problem("unknown-field", "/speed", parameters={"field": "speed"})


ODD: list[Any] = [0, -1, 1e308, "", "x" * 3000, True, None, [], [0], {}, {"kind": "other"}, {"name": 0}, {"unknown": 0}]
Keys = tuple[str | int, ...]


def places(value: object, at: Keys = ()) -> Iterator[Keys]:
    """All places in a document but the document itself."""
    inside = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, part in inside:
        yield (*at, key)
        yield from places(part, (*at, key))


def replaced(value: Any, at: Keys, new: object) -> Any:
    """A document with another value at a place."""
    if not at:
        return new
    changed = value.copy()
    changed[at[0]] = replaced(value[at[0]], at[1:], new)
    return changed


def is_place(document: Any, pointer: str) -> bool:
    """Whether a pointer leads to a value of a document, or to a field that is missing from an object in it."""
    parts = [part.replace("~1", "/").replace("~0", "~") for part in pointer.split("/")[1:]]
    for number, part in enumerate(parts):
        if isinstance(document, list) and part.isdecimal() and int(part) < len(document):
            document = document[int(part)]
        elif isinstance(document, dict) and part in document:
            document = document[part]
        else:
            return isinstance(document, dict) and number == len(parts) - 1
    return True


def refusals(kind: type[Request], document: dict[str, Any]) -> Iterator[Problem]:
    """What Python and what a call of the API is told of a document."""
    for reading in (lambda: read(kind, document), lambda: validated(document, TypeAdapter(kind))):
        try:
            reading()
        except RequestError as error:
            yield from error.problems


@EACH
def test_a_pointer_leads_to_a_place_in_what_was_sent(kind: type[Request]) -> None:
    """With an odd value at each place of each example. The names that Pydantic gives to alternatives are no places."""
    documents = [replaced(one, at, odd) for one in examples(kind) for at in places(one) for odd in ODD]
    found = [(problem.pointer, document) for document in documents for problem in refusals(kind, document)]
    assert len(found) > len(documents) / 2
    assert [(pointer, document) for pointer, document in found if not is_place(document, pointer)] == []


NO_KIND = ("request-not-one-of", "/functional/kind", {"expected": "value, integral"})


@pytest.mark.parametrize(
    ("functional", "problem"),
    [
        pytest.param({"at": "t0"}, NO_KIND, id="of no kind"),
        pytest.param({"kind": "mean", "at": "t0"}, NO_KIND, id="of a kind that there is not"),
        pytest.param({"kind": ["value"], "at": "t0"}, NO_KIND, id="a kind that is no text"),
        pytest.param(
            {"kind": "value"}, ("missing-field", "/functional/at", {"field": "at"}), id="of one kind, without its field"
        ),
        pytest.param(
            {"kind": "value", "at": "0", "value": "1"},
            ("unknown-field", "/functional/value", {"field": "value"}),
            id="with a field that is called like its kind",
        ),
        pytest.param("value", ("request-not-object", "/functional", {}), id="no object"),
    ],
)
def test_of_alternatives_that_one_is_told_that_was_meant(functional: object, problem: tuple[str, str, Any]) -> None:
    document = {"expression": "x", "functions": ["x"], "functional": functional}
    found = {(one.code, one.pointer, str(dict(one.parameters))) for one in refusals(VariationRequest, document)}
    assert found == {(*problem[:2], str(problem[2]))}
