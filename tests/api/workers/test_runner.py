"""The loop of a worker, in this process: whatever a job does, there is a reply."""

from __future__ import annotations

import json
import resource
from collections.abc import Iterator

import pytest

from deltaq.api.workers.message import encode_request
from deltaq.api.workers.runner import failure_of, replies_to

from .jobs import Unpicklable


@pytest.fixture(autouse=True)
def processor_time() -> Iterator[None]:
    """A job bounds the processor time of its process, which here is that of the tests."""
    before = resource.getrlimit(resource.RLIMIT_CPU)
    yield
    resource.setrlimit(resource.RLIMIT_CPU, before)


def replies(job: str, document: object = None) -> list[bytes]:
    return list(replies_to(encode_request(f"tests.api.workers.jobs:{job}", 1e6, document)))


def test_answer() -> None:
    assert replies("echo", {"a": 1}) == [b'+{"a":1}']


def test_parts_come_before_the_answer() -> None:
    assert replies("count", {"parts": 3}) == [b'*{"number":0}', b'*{"number":1}', b'+{"number":2}']


@pytest.mark.parametrize(
    ("job", "kind", "summary", "problems"),
    [
        pytest.param("divide_by_zero", "ZeroDivisionError", "ZeroDivisionError: division by zero", 0, id="our bug"),
        pytest.param("wrong_scene", "SceneError", "", 2, id="wrong input"),
        pytest.param("leave", "SystemExit", "SystemExit: 3", 0, id="the end of the program"),
        pytest.param("unpicklable", "Unpicklable", "Unpicklable", 0, id="exception without a text"),
    ],
)
def test_failure(job: str, kind: str, summary: str, problems: int) -> None:
    (reply,) = replies(job)
    failure = json.loads(reply[1:])
    assert reply[:1] == b"-"
    assert (failure["kind"], failure["summary"], len(failure["problems"])) == (kind, summary, problems)


def test_failure_after_the_first_parts() -> None:
    *parts, last = replies("count", {"parts": 4, "fails_at": 2})
    assert parts == [b'*{"number":0}', b'*{"number":1}']
    assert json.loads(last[1:])["summary"] == "ValueError: no further"


def test_request_that_is_none() -> None:
    (reply,) = replies_to(b"[1")
    assert json.loads(reply[1:])["kind"] == "JSONDecodeError"


def test_long_texts_are_cut() -> None:
    assert len(failure_of(ValueError("x" * 5000)).summary) == 1000
    assert failure_of(Unpicklable(1, 2)).trace == ""
