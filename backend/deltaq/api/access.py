"""What is told of each request: an identifier, a line in the log, and its latency. Never what the user wrote."""

from __future__ import annotations

import logging
import re
from contextvars import ContextVar
from time import perf_counter
from uuid import uuid4

from starlette.datastructures import Headers, MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from .metrics import Metrics

LOGGER = logging.getLogger("deltaq.access")
REQUEST_ID: ContextVar[str] = ContextVar("request_id", default="")

_HEADER = "X-Request-ID"
_GIVEN_ID = re.compile(r"[A-Za-z0-9._-]{1,64}")
_METHODS = frozenset({"GET", "HEAD", "POST", "OPTIONS", "PUT", "PATCH", "DELETE"})


class Access:
    """The outermost layer: it sees every request, also those that the others refuse."""

    def __init__(self, app: ASGIApp, metrics: Metrics) -> None:
        self.app = app
        self.metrics = metrics

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return
        identifier = request_id(Headers(scope=scope))
        named = REQUEST_ID.set(identifier)
        start, status, size = perf_counter(), 500, 0

        async def watched(message: Message) -> None:
            nonlocal status, size
            if message["type"] == "http.response.start":
                status = message["status"]
                if scope["path"].startswith("/api/"):  # on each of the page's files it would be dead weight
                    MutableHeaders(scope=message)[_HEADER] = identifier
            size += len(message.get("body", b""))
            await send(message)

        try:
            await self.app(scope, receive, watched)
        finally:
            seconds = perf_counter() - start
            facts = {"method": method_of(scope), "route": route_of(scope), "status": str(status)}
            self.metrics.latencies.labels(**facts).observe(seconds)
            if LOGGER.isEnabledFor(logging.INFO):
                LOGGER.info("answered", extra={"facts": facts | {"bytes": size, "ms": round(1000 * seconds, 1)}})
            REQUEST_ID.reset(named)


def request_id(headers: Headers) -> str:
    """The identifier that a proxy gave, if it is one, else a new one."""
    given = headers.get(_HEADER, "")
    return given if _GIVEN_ID.fullmatch(given) else uuid4().hex


def method_of(scope: Scope) -> str:
    """The method; one that clients make up has no name of its own, for there are as many as they like."""
    return scope["method"] if scope["method"] in _METHODS else "other"


def route_of(scope: Scope) -> str:
    """The pattern of the address, as the routes have it: never the address itself, which the user wrote."""
    return getattr(scope.get("route"), "path", "none")
