"""Under which names the service answers.

A page of an attacker may let its own name point here (DNS rebinding); the browser then believes that both are one. What
gives it away is the name in the Host header.
"""

from __future__ import annotations

from urllib.parse import urlsplit

from fastapi import Request
from starlette.types import ASGIApp, Receive, Scope, Send

from .languages import language_of
from .problems import UNKNOWN_HOST, Report

LOOPBACK = ("localhost", "127.0.0.1", "::1")  # always trusted: no attacker can let them point elsewhere


class TrustedHosts:
    """Refuses requests for other names; a leading `*.` stands for any subdomain, and no names for all."""

    def __init__(self, app: ASGIApp, names: tuple[str, ...]) -> None:
        self.app = app
        self.names = names

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        request = Request(scope) if scope["type"] == "http" and self.names else None
        if request is None or is_trusted(request.headers.get("host", ""), self.names):
            await self.app(scope, receive, send)
            return
        response = Report(UNKNOWN_HOST).response(language_of(request))
        await response(scope, receive, send)


def is_trusted(host: str, names: tuple[str, ...]) -> bool:
    """Whether a Host header, with or without a port, has one of the names."""
    try:
        name = urlsplit(f"//{host}").hostname or ""
    except ValueError:  # brackets that do not match
        return False
    return name in LOOPBACK or any(_fits(name, pattern.lower()) for pattern in names)


def _fits(name: str, pattern: str) -> bool:
    return name == pattern or (pattern.startswith("*.") and name.endswith(pattern[1:]))
