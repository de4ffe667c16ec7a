"""What goes through the pipe between supervisor and worker: bytes that are JSON, never pickles.

An answer begins with the tag ANSWER, what comes before it with the tag PART, an error with the tag ERROR; so an
answer travels from the worker to the client without being read in between, and an error can always be read, whatever
was raised.
"""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from typing import Any

from pydantic_core import to_json

from ... import errors
from ...errors import DeltaqError, InputError, Problem
from .job import DeadlineExceeded, JobFailed, MemoryExceeded

READY = b"ready"
ANSWER = b"+"
PART = b"*"
ERROR = b"-"

_INPUT_ERRORS = {
    kind.__name__: kind for kind in vars(errors).values() if isinstance(kind, type) and issubclass(kind, InputError)
}


@dataclass(frozen=True)
class Failure:
    """An exception as plain data."""

    kind: str
    summary: str = ""
    trace: str = ""
    problems: tuple[dict[str, Any], ...] = ()


def encode_request(target: str, seconds: float, document: Any) -> bytes:
    """The request as bytes; `seconds` bounds its processor time."""
    return json.dumps([target, seconds, document], allow_nan=False).encode()


def encode_answer(document: Any, tag: bytes = ANSWER) -> bytes:
    """The answer as bytes; numbers that are not finite have no JSON and raise ValueError."""
    written = to_json(document, inf_nan_mode="constants")  # many numbers: seven times as fast as json
    if b"NaN" in written or b"Infinity" in written:  # perhaps in a text
        written = json.dumps(document, allow_nan=False, ensure_ascii=False, separators=(",", ":")).encode()
    return tag + written


def encode_error(failure: Failure) -> bytes:
    """The failure as bytes."""
    return ERROR + json.dumps(asdict(failure)).encode()


def problem_data(problem: Problem) -> dict[str, Any]:
    """A problem as plain data."""
    return {
        "code": problem.code,
        "pointer": problem.pointer,
        "offset": problem.offset,
        "length": problem.length,
        "parameters": dict(problem.parameters),
        "severity": problem.severity,
    }


def decode_reply(reply: bytes) -> bytes | DeltaqError:
    """The JSON of the answer, or the error that the worker reported."""
    if reply[:1] == ANSWER:
        return reply[1:]
    failure = Failure(**json.loads(reply[1:]))
    if failure.kind in _INPUT_ERRORS:
        return _INPUT_ERRORS[failure.kind](*(Problem(**problem) for problem in failure.problems))
    if failure.kind == "TimeIsUp":
        return DeadlineExceeded("what came before lacks what there was no time for")
    if failure.kind in {"MemoryError", "RecursionError"}:
        return MemoryExceeded(failure.summary)
    return JobFailed(failure.summary, failure.trace)
