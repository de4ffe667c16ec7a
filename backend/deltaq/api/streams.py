"""Server-sent events (WHATWG HTML §9.2): what a long computation says while it runs."""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator, Awaitable, Callable
from typing import Any

MEDIA_TYPE = "text/event-stream"


def event(kind: str, data: bytes) -> bytes:
    """One event; JSON has no line breaks of its own."""
    return b"event: %b\ndata: %b\n\n" % (kind.encode(), data)


async def events(
    work: Callable[[Callable[[bytes], object]], Awaitable[bytes]], failure: Callable[[Exception], dict[str, Any]]
) -> AsyncIterator[bytes]:
    """`part` for each part that the work lets hear, then `result`, or `problem` with a problem document.

    A part says all that those before it said, so a client that reads slowly gets the newest one only. When the client
    goes away, the work is cancelled.
    """
    parts: asyncio.Queue[bytes | None] = asyncio.Queue()

    def hear(part: bytes) -> None:
        if not parts.empty():
            parts.get_nowait()
        parts.put_nowait(part)

    task = asyncio.ensure_future(work(hear))
    task.add_done_callback(lambda _: parts.put_nowait(None))
    try:
        while (part := await parts.get()) is not None:
            yield event("part", part)
        yield event("result", task.result())
    except Exception as error:  # noqa: BLE001  the head has been sent, so a failure is an event
        yield event("problem", json.dumps(failure(error), ensure_ascii=False).encode())
    finally:
        task.cancel()
