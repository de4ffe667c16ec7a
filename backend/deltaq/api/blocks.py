"""Streams whose blocks are all wanted: each is sent once, as it is done; then what is told of all.

They wait for the client: a worker whose blocks are not read does not go on, so that no more than a few are kept. The
time limit of its job goes on meanwhile. What came before a failure stays, and what is missing is named.
"""

from __future__ import annotations

import asyncio
import json
import re
from collections.abc import AsyncGenerator, Awaitable, Callable, Iterator, Mapping
from contextlib import suppress
from typing import Any

from .cache import Cache
from .flights import Update
from .packing import pack, unpack
from .streams import event

MOST_WAITING = 8  # blocks that a client has not read yet
MOST_KEPT = 2**23  # bytes of a stream that is kept for who asks for the same
_HEAD = re.compile(rb'\{"first":(\d+),"runs":(\d+),')  # of a block

Failure = Callable[[Exception], Mapping[str, Any]]


class Blocks:
    """A stream about `count` runs on its way to one client."""

    def __init__(self, count: int) -> None:
        self._count = count
        self._events: asyncio.Queue[bytes] = asyncio.Queue(MOST_WAITING)
        self._spans: dict[int, int] = {}  # how many runs, by the first
        self._kept: list[bytes] = []
        self._size = 0

    async def take(self, block: bytes) -> None:
        """A block is done. A job that is begun again, as its worker was killed, tells some that have been sent."""
        found = _HEAD.match(block)
        if found is None:
            raise ValueError("a block begins with its first run and their number")
        first, runs = map(int, found.groups())
        if first in self._spans:
            return
        self._spans[first] = runs
        self._size += len(block)
        self._kept.append(block)
        if self._size > MOST_KEPT:
            self._kept.clear()
        await self._events.put(event("block", block))

    def tell(self, update: Update) -> None:
        """News that the next ones replace: who does not read misses them."""
        with suppress(asyncio.QueueFull):
            self._events.put_nowait(event(update.kind, update.data))

    async def events(self, work: Callable[[], Awaitable[bytes]], failure: Failure) -> AsyncGenerator[bytes]:
        """What is taken and told while the work goes on; then its `result`, or `problem` with a problem document.

        Its `missing` are the runs that did not come. When the client goes away, the work is cancelled.
        """
        task = asyncio.ensure_future(work())
        try:
            while (next_one := await self._next(task)) is not None:
                yield next_one
            yield event("result", task.result())
        except Exception as error:  # noqa: BLE001  the head has been sent, so a failure is an event
            told = {**failure(error), "missing": list(self._missing())}
            yield event("problem", json.dumps(told, ensure_ascii=False).encode())
        finally:
            task.cancel()

    async def keep(self, cache: Cache, key: str, result: bytes) -> None:
        """Puts the whole stream into the cache, if it is short enough."""
        if self._size <= MOST_KEPT:
            lines = b"\n".join([*self._kept, result])  # JSON has no line breaks of its own
            await cache.keep(key, await asyncio.to_thread(pack, lines))

    async def known(self, cache: Cache, key: str) -> bytes | None:
        """The result of a stream that is in the cache, whose blocks are told; None if it is not there."""
        if (found := await cache.find(key)) is None:
            return None
        *blocks, result = (await asyncio.to_thread(unpack, found)).split(b"\n")
        for block in blocks:
            await self.take(block)
        return result

    async def _next(self, task: asyncio.Future[bytes]) -> bytes | None:
        """The next event; None when the work is done, and all is told."""
        getting = asyncio.ensure_future(self._events.get())
        try:
            await asyncio.wait({getting, task}, return_when=asyncio.FIRST_COMPLETED)
            return getting.result() if getting.done() else None
        finally:
            getting.cancel()

    def _missing(self) -> Iterator[dict[str, int]]:
        """The runs that did not come, those side by side together."""
        end = 0
        for first, runs in [*sorted(self._spans.items()), (self._count, 0)]:
            if first > end:
                yield {"first": end, "runs": first - end}
            end = first + runs
