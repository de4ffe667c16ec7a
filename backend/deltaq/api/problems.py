"""The one map from errors to problem documents (application/problem+json, RFC 9457), in the client's language."""

from __future__ import annotations

import json
import logging
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import accumulate
from typing import Any
from uuid import uuid4

from fastapi import FastAPI, Request, Response
from fastapi.exceptions import RequestValidationError
from starlette.exceptions import HTTPException
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from ..contract.reading import problems_of
from ..errors import MOST_PROBLEMS, DeltaqError, InputError, Problem, UnknownNameError
from ..narration.catalog import text
from ..narration.problems import described
from ..vocabulary import Language
from .languages import language_of
from .strict_json import JsonError
from .workers.account import QuotaExceeded
from .workers.job import DeadlineExceeded, JobError, JobFailed, MemoryExceeded, Overloaded, Preparing, WorkerKilled

LOGGER = logging.getLogger("deltaq.api")
MEDIA_TYPE = "application/problem+json"
RETRY_AFTER = 2
LONGEST_TEXT = 16_000  # characters of all pointers and of what fills the sentences


@dataclass(frozen=True)
class ProblemType:
    """A kind of failed request: the last part of its `type` address, and its HTTP status."""

    name: str
    status: int

    @property
    def address(self) -> str:
        """Where a page explains it."""
        return f"/problems/{self.name}"


INVALID_REQUEST = ProblemType("invalid-request", 422)
INVALID_JSON = ProblemType("invalid-json", 400)
UNKNOWN_NAME = ProblemType("unknown-name", 404)
NOT_FOUND = ProblemType("not-found", 404)
METHOD_NOT_ALLOWED = ProblemType("method-not-allowed", 405)
BODY_TOO_SLOW = ProblemType("body-too-slow", 408)
BODY_TOO_LARGE = ProblemType("body-too-large", 413)
BODY_NOT_CALLED_JSON = ProblemType("body-not-called-json", 415)
UNKNOWN_HOST = ProblemType("unknown-host", 421)
HEAD_TOO_LARGE = ProblemType("head-too-large", 431)
QUOTA_EXCEEDED = ProblemType("quota-exceeded", 429)
INTERNAL_ERROR = ProblemType("internal-error", 500)
INTERRUPTED = ProblemType("interrupted", 503)
OVERLOADED = ProblemType("overloaded", 503)
PREPARING = ProblemType("preparing", 503)
COMPUTATION_TOO_LARGE = ProblemType("computation-too-large", 504)
HTTP_ERROR = ProblemType("http-error", 400)  # of any status that has no type of its own

# All of them, as GET /problems lists them: what the client can mend, then what passes, then what we have to mend.
TYPES: tuple[ProblemType, ...] = (
    INVALID_REQUEST,
    INVALID_JSON,
    UNKNOWN_NAME,
    NOT_FOUND,
    METHOD_NOT_ALLOWED,
    BODY_NOT_CALLED_JSON,
    BODY_TOO_LARGE,
    BODY_TOO_SLOW,
    HEAD_TOO_LARGE,
    UNKNOWN_HOST,
    HTTP_ERROR,
    COMPUTATION_TOO_LARGE,
    QUOTA_EXCEEDED,
    OVERLOADED,
    PREPARING,
    INTERRUPTED,
    INTERNAL_ERROR,
)

# The most special class first; an error is of the first type whose class it is.
_TYPES: tuple[tuple[type[Exception], ProblemType], ...] = (
    (JsonError, INVALID_JSON),
    (UnknownNameError, UNKNOWN_NAME),
    (InputError, INVALID_REQUEST),
    (RequestValidationError, INVALID_REQUEST),
    (QuotaExceeded, QUOTA_EXCEEDED),
    (Preparing, PREPARING),
    (Overloaded, OVERLOADED),
    (WorkerKilled, INTERRUPTED),
    (DeadlineExceeded, COMPUTATION_TOO_LARGE),
    (MemoryExceeded, COMPUTATION_TOO_LARGE),
    (Exception, INTERNAL_ERROR),
)
_TEMPORARY = frozenset({QUOTA_EXCEEDED, OVERLOADED, PREPARING, INTERRUPTED})
_HTTP_TYPES = {
    404: NOT_FOUND,
    405: METHOD_NOT_ALLOWED,
    408: BODY_TOO_SLOW,
    413: BODY_TOO_LARGE,
    415: BODY_NOT_CALLED_JSON,
}


@dataclass(frozen=True)
class Report:
    """A problem document before it is put into words."""

    type: ProblemType
    problems: tuple[Problem, ...] = ()
    parameters: Mapping[str, Any] = field(default_factory=dict)
    headers: Mapping[str, str] = field(default_factory=dict)

    def document(self, language: Language) -> dict[str, Any]:
        """The members of RFC 9457, and `problems` with pointer, offset, length, code and message."""
        told = described(first(self.problems), language)
        detail = _text(language, self.type, "detail", **self.parameters)
        return {
            "type": self.type.address,
            "title": _text(language, self.type, "title", **self.parameters),
            "status": self.type.status,
            "detail": detail or " ".join(one["message"] for one in told[:3]),
            "problems": told,
        }

    def response(self, language: Language) -> Response:
        """The document as an HTTP response."""
        body = json.dumps(self.document(language), ensure_ascii=False).encode("utf-8", "backslashreplace")
        headers = {"Content-Language": language, "Cache-Control": "no-store", **self.headers}
        return Response(body, self.type.status, headers, MEDIA_TYPE)


def first(problems: Sequence[Problem]) -> list[Problem]:
    """As many as are told; of more it is said that there are more."""
    sizes = accumulate(
        len(problem.pointer) + sum(len(str(one)) for one in problem.parameters.values()) for problem in problems
    )
    some = [problem for problem, size in zip(problems[:MOST_PROBLEMS], sizes, strict=False) if size <= LONGEST_TEXT]
    return some if len(some) == len(problems) else [*some, Problem("more-problems")]


def _text(language: Language, kind: ProblemType, part: str, **parameters: Any) -> str:
    """Title or detail of a problem type; a type without a detail of its own is described by its problems."""
    try:
        return text(language, f"errors.type.{kind.name}.{part}", **parameters)
    except KeyError:
        return ""


def report_of(error: Exception) -> Report:
    """What went wrong, as data for the client; our own mistakes are logged and say nothing but where to look."""
    if isinstance(error, HTTPException):
        # FastAPI wraps what goes wrong while it reads the body.
        return report_of(error.__cause__) if isinstance(error.__cause__, DeltaqError) else _http_report(error)
    kind = next(kind for cause, kind in _TYPES if isinstance(error, cause))
    if kind is INTERNAL_ERROR:
        return _incident(error)
    if kind in _TEMPORARY:
        seconds = max(RETRY_AFTER, math.ceil(getattr(error, "seconds", 0.0)))
        return Report(kind, parameters={"seconds": seconds}, headers={"Retry-After": str(seconds)})
    problems = _findings(error) if isinstance(error, RequestValidationError) else getattr(error, "problems", ())
    return Report(kind, tuple(problems))


def _findings(error: RequestValidationError) -> Iterator[Problem]:
    """What FastAPI found wrong; it says first whether with body, query or path."""
    return problems_of({**finding, "loc": finding["loc"][1:]} for finding in error.errors())


def _http_report(error: HTTPException) -> Report:
    headers = dict(error.headers or {})
    if "Allow" in headers:  # Starlette writes a set, which each process orders in its own way
        headers["Allow"] = ", ".join(sorted(headers["Allow"].split(", ")))
    kind = _HTTP_TYPES.get(error.status_code) or replace(HTTP_ERROR, status=error.status_code)
    parameters = {"allowed": headers.get("Allow", ""), **getattr(error, "parameters", {})}
    return Report(kind, parameters=parameters, headers=headers)


def _incident(error: Exception) -> Report:
    incident = uuid4().hex[:12]
    if isinstance(error, JobFailed):
        LOGGER.error("incident %s in a worker: %s", incident, error.trace)
        LOGGER.debug("incident %s: %s", incident, error)  # it may quote the user
    elif isinstance(error, JobError):
        LOGGER.error("incident %s: %s", incident, error)
    else:
        LOGGER.error("incident %s", incident, exc_info=error)
    return Report(INTERNAL_ERROR, parameters={"incident": incident})


class Guard:
    """Answers what nobody foresaw, inside the other middleware, so that such an answer has their headers too."""

    def __init__(self, app: ASGIApp) -> None:
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        started = False

        async def watched(message: Message) -> None:
            nonlocal started
            started = True
            await send(message)

        try:
            await self.app(scope, receive, watched)
        except Exception as error:
            if started or scope["type"] != "http":
                raise
            response = await handle(Request(scope), error)
            await response(scope, receive, send)


async def handle(request: Request, error: Exception) -> Response:
    """The exception handler of the application."""
    return report_of(error).response(language_of(request))


def install(app: FastAPI) -> None:
    """Make every error of the application a problem document."""
    for kind in (HTTPException, RequestValidationError, InputError, JobError):
        app.add_exception_handler(kind, handle)
    app.add_middleware(Guard)
