"""Work for a client that has gone stops."""

from __future__ import annotations

import asyncio
from collections.abc import Coroutine
from typing import Any

from fastapi import Request, Response

CLIENT_GONE = 499  # nobody gets to see it but the log


async def while_present(request: Request, answering: Coroutine[Any, Any, Response]) -> Response:
    """The response; when the client goes before it is there, the work for it is cancelled.

    The request's body must have been read, for what comes next must be the news that the client has gone.
    """
    work = asyncio.ensure_future(answering)
    leaving = asyncio.ensure_future(_gone(request))
    try:
        await asyncio.wait({work, leaving}, return_when=asyncio.FIRST_COMPLETED)
        return work.result() if work.done() else Response(status_code=CLIENT_GONE)
    finally:
        work.cancel()
        leaving.cancel()


async def _gone(request: Request) -> None:
    while (await request.receive())["type"] != "http.disconnect":
        pass
