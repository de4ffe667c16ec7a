"""Server-sent events (WHATWG HTML §9.2): what a long computation says while it runs."""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncGenerator, AsyncIterator, Awaitable, Callable
from typing import Any

from .flights import OnUpdate, Update

MEDIA_TYPE = "text/event-stream"
COMMENT = b":\n\n"  # which clients leave out
LONGEST_SILENCE = 15.0  # seconds (WHATWG HTML §9.2.7): a proxy takes a connection for dead that is silent for longer


def event(kind: str, data: bytes) -> bytes:
    """One event; JSON has no line breaks of its own."""
    return b"event: %b\ndata: %b\n\n" % (kind.encode(), data)


async def kept_alive(told: AsyncGenerator[bytes]) -> AsyncIterator[bytes]:
    """Events as they come, with a comment wherever none has come for a while. It ends them when it ends."""
    coming: asyncio.Future[bytes | None] | None = None
    try:
        while True:
            coming = coming or asyncio.ensure_future(_next(told))
            await asyncio.wait({coming}, timeout=LONGEST_SILENCE)
            if not coming.done():
                yield COMMENT
                continue
            if (one := coming.result()) is None:
                return
            coming = None
            yield one
    finally:
        if coming is None:
            await told.aclose()
        else:
            coming.cancel()  # which ends what it waits in


async def _next(told: AsyncGenerator[bytes]) -> bytes | None:
    async for one in told:
        return one
    return None


async def events(
    work: Callable[[OnUpdate], Awaitable[bytes]], failure: Callable[[Exception], dict[str, Any]]
) -> AsyncGenerator[bytes]:
    """The updates of the work, `preparing`, `waiting` or `part`; then `result`, or `problem` with a problem document.

    Each event replaces those before it, so a client that reads slowly gets the newest one only. When the client goes
    away, the work is cancelled.
    """
    newest: asyncio.Queue[Update | None] = asyncio.Queue()

    def on_update(update: Update) -> None:
        if not newest.empty():
            newest.get_nowait()
        newest.put_nowait(update)

    task = asyncio.ensure_future(work(on_update))
    task.add_done_callback(lambda _: newest.put_nowait(None))
    try:
        while (update := await newest.get()) is not None:
            yield event(update.kind, update.data)
        yield event("result", task.result())
    except Exception as error:  # noqa: BLE001  the head has been sent, so a failure is an event
        yield event("problem", json.dumps(failure(error), ensure_ascii=False).encode())
    finally:
        task.cancel()
