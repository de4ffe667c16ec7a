"""Reading the body of a request: bounded in size and time, strict in syntax."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Coroutine
from typing import Any

from fastapi import Request, Response
from fastapi.routing import APIRoute
from starlette.exceptions import HTTPException

from ..settings import Settings
from .presence import while_present
from .strict_json import loads


class BodyError(HTTPException):
    """The body is too large or too slow; `parameters` fill the sentence that says so."""

    def __init__(self, status: int, **parameters: float) -> None:
        super().__init__(status, headers={"Connection": "close"})
        self.parameters = parameters


class StrictRequest(Request):
    """A request whose body is read with bounds; `state.lang` is the language that the body asks for."""

    async def body(self) -> bytes:
        if not hasattr(self, "_body"):
            settings: Settings = self.app.state.service.settings
            try:
                self._body = await asyncio.wait_for(self._bounded(settings.largest_body), settings.body_timeout)
            except TimeoutError:
                raise BodyError(408, seconds=settings.body_timeout) from None
        return self._body

    async def _bounded(self, limit: int) -> bytes:
        """All chunks, counted as they come: a length that is announced may be a lie, or missing."""
        chunks, size = [], 0
        async for chunk in self.stream():
            size += len(chunk)
            if size > limit:
                raise BodyError(413, limit=limit)
            chunks.append(chunk)
        return b"".join(chunks)

    async def json(self) -> Any:
        document = loads(await self.body())
        if isinstance(document, dict):
            self.state.lang = document.get("lang")
        return document


def _is_json(request: Request) -> bool:
    """Whether the body is said to be JSON. A page of another origin can say so only if it may call the API."""
    kind = request.headers.get("content-type", "").partition(";")[0].strip().lower()
    return kind == "application/json" or kind.endswith("+json")


class StrictRoute(APIRoute):
    """A route that reads its body by StrictRequest, and works only while the client is there."""

    def get_route_handler(self) -> Callable[[Request], Coroutine[Any, Any, Response]]:
        handler = super().get_route_handler()

        async def handle(request: Request) -> Response:
            strict = StrictRequest(request.scope, request.receive)
            if await strict.body() and self.body_field is not None and not _is_json(strict):
                raise HTTPException(415)
            return await while_present(strict, handler(strict))

        return handle
