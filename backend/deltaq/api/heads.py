"""How long the head of a request may be: its address and its headers."""

from __future__ import annotations

from fastapi import Request
from starlette.types import ASGIApp, Receive, Scope, Send

from .languages import language_of
from .problems import HEAD_TOO_LARGE, Report

LONGEST = 32768  # bytes


class Heads:
    """Refuses requests with a longer head. The server itself only looks while a head is not complete."""

    def __init__(self, app: ASGIApp) -> None:
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http" or length(scope) <= LONGEST:
            await self.app(scope, receive, send)
            return
        response = Report(HEAD_TOO_LARGE, parameters={"limit": LONGEST}).response(language_of(Request(scope)))
        await response(scope, receive, send)


def length(scope: Scope) -> int:
    """Bytes of the address and of all headers."""
    fields = sum(len(name) + len(value) for name, value in scope["headers"])
    return len(scope.get("raw_path") or b"") + len(scope["query_string"]) + fields
