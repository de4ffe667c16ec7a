"""The log is made of lines of JSON, and keeps what users wrote to itself."""

from __future__ import annotations

import json
import logging
import sys
from collections.abc import Iterator
from typing import Any

import pytest

from deltaq.api.access import REQUEST_ID
from deltaq.api.logs import Line, Repeats, configure


def failed() -> logging.LogRecord:
    """A record of an exception whose text, and whose cause's text, came from a user."""
    try:
        try:
            raise ValueError("secret cause")
        except ValueError as error:
            raise KeyError("secret text") from error
    except KeyError:
        return logging.LogRecord("deltaq.api", logging.ERROR, __file__, 1, "incident %s", ("12",), sys.exc_info())


@pytest.fixture
def request_named() -> Iterator[str]:
    token = REQUEST_ID.set("abc")
    yield "abc"
    REQUEST_ID.reset(token)


def line_of(record: logging.LogRecord, **options: bool) -> dict[str, Any]:
    text = Line(**options).format(record)
    assert "\n" not in text
    line: dict[str, Any] = json.loads(text)
    return line


def test_line_names_the_request(request_named: str) -> None:
    line = line_of(logging.LogRecord("deltaq.api", logging.WARNING, __file__, 1, "δ is %s", ("small",), None))
    assert line.pop("time").endswith("+00:00")
    assert line == {"level": "warning", "logger": "deltaq.api", "message": "δ is small", "request": request_named}


def test_exception_is_told_by_kind_and_place_alone() -> None:
    told = line_of(failed())["exception"]
    assert "secret cause" in "".join(line_of(failed(), private=False)["exception"])
    assert [part.rpartition("\n")[2] for part in told.split("\n\n")] == ["ValueError", "KeyError"]
    assert "in failed" in told


def test_text_of_an_exception_is_for_debugging_only() -> None:
    without_code = [line for line in line_of(failed())["exception"].splitlines() if "raise" not in line]
    assert "secret" not in "".join(without_code)
    assert "KeyError: 'secret text'" in line_of(failed(), private=False)["exception"]


@pytest.fixture
def root_logger() -> Iterator[logging.Logger]:
    root = logging.getLogger()
    before = root.handlers[:], root.level
    yield root
    root.handlers[:], level = before
    root.setLevel(level)


@pytest.mark.parametrize(("level", "private"), [("info", True), ("debug", False)])
def test_level(root_logger: logging.Logger, level: str, private: bool) -> None:
    configure(level)
    (handler,) = root_logger.handlers
    assert root_logger.level == getattr(logging, level.upper())
    assert isinstance(handler.formatter, Line)
    assert handler.formatter.private is private


class Clock:
    """Shows what it is set to."""

    def __init__(self) -> None:
        self.now = 0.0

    def __call__(self) -> float:
        return self.now


def record(level: int, line: int, message: str = "x") -> logging.LogRecord:
    return logging.LogRecord("asyncio", level, __file__, line, message, (), None)


def test_warnings_from_one_place_are_told_a_few_times_and_then_counted() -> None:
    clock = Clock()
    repeats = Repeats(most=3, seconds=10.0, clock=clock)
    passed = [repeats.filter(record(logging.ERROR, 1, f"socket {n}")) for n in range(1000)]
    assert passed == [True] * 3 + [False] * 997
    assert repeats.filter(record(logging.ERROR, 2))
    clock.now = 10.0
    later = [record(logging.ERROR, 1) for _ in range(2)]
    assert [repeats.filter(one) for one in later] == [True, True]
    assert [json.loads(Line().format(one)).get("left_out") for one in later] == [997, None]


def test_lines_of_requests_are_all_told() -> None:
    repeats = Repeats(most=3, clock=Clock())
    assert all(repeats.filter(record(logging.INFO, 1)) for _ in range(1000))


def test_what_was_raised_in_different_places_is_told_apart() -> None:
    repeats, other = Repeats(most=1, clock=Clock()), failed()
    try:
        int("x")
    except ValueError:
        here = logging.LogRecord(
            other.name, other.levelno, other.pathname, other.lineno, "incident", (), sys.exc_info()
        )
    assert [repeats.filter(one) for one in (other, here, other, here)] == [True, True, False, False]


def test_the_log_of_the_service_has_the_filter(root_logger: logging.Logger) -> None:
    configure("warning")
    (handler,) = root_logger.handlers
    assert [type(one) for one in handler.filters] == [Repeats]
