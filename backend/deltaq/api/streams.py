"""Server-sent events (WHATWG HTML §9.2): what a long computation says while it runs."""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator, Awaitable, Callable
from typing import Any

from .flights import OnUpdate, Update

MEDIA_TYPE = "text/event-stream"


def event(kind: str, data: bytes) -> bytes:
    """One event; JSON has no line breaks of its own."""
    return b"event: %b\ndata: %b\n\n" % (kind.encode(), data)


async def events(
    work: Callable[[OnUpdate], Awaitable[bytes]], failure: Callable[[Exception], dict[str, Any]]
) -> AsyncIterator[bytes]:
    """The updates of the work, `waiting` or `part`; then `result`, or `problem` with a problem document.

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
