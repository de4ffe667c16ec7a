"""What goes through the pipe comes out as it went in."""

from __future__ import annotations

import json
from typing import Any

import pytest

from deltaq.api.workers.job import JobFailed, MemoryExceeded
from deltaq.api.workers.message import (
    ANSWER,
    PART,
    Failure,
    decode_reply,
    encode_answer,
    encode_error,
    encode_request,
    problem_data,
)
from deltaq.errors import DeltaqError, Problem, SceneError

PROBLEM = Problem("missing-field", "/title", 2, 3, {"field": "title", "count": 1}, severity="warning")


def test_request() -> None:
    assert json.loads(encode_request("module:job", 2.5, {"φ": [1]})) == ["module:job", 2.5, {"φ": [1]}]
    with pytest.raises(ValueError, match="not JSON compliant"):
        encode_request("module:job", 2.5, float("nan"))


@pytest.mark.parametrize(
    "document",
    [
        pytest.param({"t": [0.1, 1e300, -0.0], "n": None}, id="numbers"),
        pytest.param({"text": "neither NaN nor -Infinity is a number"}, id="words that look like numbers"),
        pytest.param("δq\n", id="text"),
    ],
)
def test_answer(document: Any) -> None:
    reply = encode_answer(document)
    assert reply[:1] == ANSWER
    found = decode_reply(reply)
    assert isinstance(found, bytes)
    assert json.loads(found) == document


@pytest.mark.parametrize("number", [float("nan"), float("inf"), float("-inf")])
def test_numbers_without_json_are_refused(number: float) -> None:
    with pytest.raises(ValueError, match="not JSON compliant"):
        encode_answer({"x": [1.0, number]}, PART)


@pytest.mark.parametrize(
    ("failure", "kind", "text"),
    [
        pytest.param(Failure("ValueError", "ValueError: x", "line 1"), JobFailed, "ValueError: x", id="our bug"),
        pytest.param(Failure("MemoryError", "MemoryError: "), MemoryExceeded, "MemoryError: ", id="memory"),
        pytest.param(Failure("RecursionError", "deep"), MemoryExceeded, "deep", id="recursion"),
        pytest.param(
            Failure("SceneError", problems=(problem_data(PROBLEM),)),
            SceneError,
            str(SceneError(PROBLEM)),
            id="the client's mistake",
        ),
    ],
)
def test_failure(failure: Failure, kind: type[DeltaqError], text: str) -> None:
    found = decode_reply(encode_error(failure))
    assert type(found) is kind
    assert str(found) == text
    assert getattr(found, "trace", failure.trace) == failure.trace
    assert getattr(found, "problems", ()) == ((PROBLEM,) if failure.problems else ())
