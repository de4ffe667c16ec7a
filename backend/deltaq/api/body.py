"""Reading the body of a request: bounded in size and time, strict in syntax, and at the expense of who sent it."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Coroutine
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from time import thread_time
from typing import Any, TypeVar
from weakref import WeakValueDictionary

from fastapi import Request, Response
from fastapi.routing import APIRoute
from pydantic import TypeAdapter
from starlette.exceptions import HTTPException
from starlette.requests import ClientDisconnect
from starlette.routing import Match
from starlette.types import Receive, Scope, Send

from ..contract.reading import validated
from ..settings import Settings
from .clients import ACCOUNT, METER
from .ending import Ending
from .presence import CLIENT_GONE, while_present
from .strict_json import loads
from .workers.account import Account

T = TypeVar("T")
SMALL = 2**14  # bytes of a body that is read at once: the worst of them take 3 ms


class BodyError(HTTPException):
    """The body is too large, too slow or of another kind; `parameters` fill the sentence that says so."""

    def __init__(self, status: int, **parameters: float | str) -> None:
        super().__init__(status, headers={"Connection": "close"})
        self.parameters = parameters


class LargeBodies:
    """Reads large bodies beside the event loop: one at a time, and clients take turns."""

    def __init__(self) -> None:
        self._thread = ThreadPoolExecutor(1, "deltaq-bodies")
        self._turns: WeakValueDictionary[str, asyncio.Lock] = WeakValueDictionary()

    async def read(self, work: Callable[[], T], account: Account) -> T:
        """What the work gives, for which the account pays. QuotaExceeded if it cannot."""
        turn = self._turns.setdefault(account.client, asyncio.Lock())
        async with turn:
            account.admit()
            loop = asyncio.get_running_loop()
            return await loop.run_in_executor(self._thread, partial(_paid, work, account))


def _paid(work: Callable[[], T], account: Account) -> T:
    begin = thread_time()
    try:
        return work()
    finally:
        account.pay(thread_time() - begin)


class StrictRequest(Request):
    """A request whose body is read with bounds; `state.lang` is the language that the body asks for."""

    wanted: TypeAdapter[Any] | None = None  # what the body must be

    async def body(self) -> bytes:
        """The whole body, bounded in size and time. Raises BodyError with the status to answer."""
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
        """What the body says, as the model that is wanted of it."""
        document = await self._read(partial(loads, await self.body()))
        if isinstance(document, dict):
            self.state.lang = document.get("lang")
        return document if self.wanted is None else await self._read(partial(validated, document, self.wanted))

    async def _read(self, work: Callable[[], T]) -> T:
        if len(self._body) <= SMALL:
            return work()
        large: LargeBodies = self.app.state.service.large_bodies
        return await large.read(work, ACCOUNT.get())


def demand_kind(request: Request, kind: str, *others: str) -> None:
    """BodyError unless the body says it is JSON, or TOML. A page of another origin can say so only if it may call.

    `others` are media types that are as good: none that a form of another origin may send unasked (text/plain).
    """
    media = f"application/{kind.lower()}"
    told = request.headers.get("content-type", "").partition(";")[0].strip().lower()
    if told not in (media, *others) and not told.endswith(f"+{kind.lower()}"):
        raise BodyError(415, syntax=kind, media=media)


class HeadedRoute(APIRoute):
    """A route whose answers have a head, too, where they can be got (RFC 9110 §9.3.2).

    That is the same answer, whose body the server leaves out; it is no operation of its own in the description.
    """

    def matches(self, scope: Scope) -> tuple[Match, Scope]:
        """HEAD matches wherever GET does."""
        return super().matches({**scope, "method": "GET"} if self._is_head(scope) else scope)

    async def handle(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answers HEAD as GET; what sends the answer leaves its body out. HTTPException that names what is allowed."""
        known = self.methods or set()
        allowed = known | ({"HEAD"} if "GET" in known else set())
        if scope["method"] not in allowed:
            raise HTTPException(405, headers={"Allow": ", ".join(sorted(allowed))})
        await (self.app if self._is_head(scope) else super().handle)(scope, receive, send)

    def _is_head(self, scope: Scope) -> bool:
        return scope.get("method") == "HEAD" and "GET" in (self.methods or ())


class StrictRoute(HeadedRoute):
    """A route that reads its body by StrictRequest, and works only while client and service are there."""

    def get_route_handler(self) -> Callable[[Request], Coroutine[Any, Any, Response]]:
        """A handler that reads the body strictly before FastAPI's own sees it."""
        handler = super().get_route_handler()
        field = self.body_field
        wanted: TypeAdapter[Any] | None = TypeAdapter(field.field_info.annotation or Any) if field else None

        async def answer(strict: StrictRequest) -> Response:
            try:
                body = await strict.body()
            except ClientDisconnect:
                return Response(status_code=CLIENT_GONE)
            if body and wanted is not None:
                demand_kind(strict, "JSON")
            return await while_present(strict, METER.get().measured(handler(strict)))

        async def handle(request: Request) -> Response:
            strict = StrictRequest(request.scope, request.receive)
            strict.wanted = wanted
            ending: Ending = request.app.state.service.ending
            return await ending.unless(METER.get().measured(answer(strict)))

        return handle
