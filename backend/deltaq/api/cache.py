"""Answers by the hash of their question: kept in memory up to a size, and computed once for all who ask at once."""

from __future__ import annotations

import asyncio
import hashlib
import json
from collections import OrderedDict
from collections.abc import Awaitable, Callable
from typing import Any

OVERHEAD = 200  # bytes of bookkeeping for each entry, roughly


def content_hash(*parts: Any) -> str:
    """A name for a JSON value that depends on nothing but its content; the order of object members does not count."""
    text = json.dumps(parts, sort_keys=True, separators=(",", ":"), allow_nan=False)
    return hashlib.sha256(text.encode()).hexdigest()[:32]


class Cache:
    """Least recently used answers are dropped beyond `size` bytes. Used from one event loop."""

    def __init__(self, size: int) -> None:
        self.size = size
        self.used = 0
        self.hits = 0
        self.misses = 0
        self._entries: OrderedDict[str, bytes] = OrderedDict()
        self._running: dict[str, asyncio.Task[bytes]] = {}

    def __len__(self) -> int:
        return len(self._entries)

    def peek(self, key: str) -> bytes | None:
        """The answer of this key, if it is there."""
        return self._entries.get(key)

    async def get(self, key: str, compute: Callable[[], Awaitable[bytes]]) -> bytes:
        """The answer of this key, computed if need be. Errors reach all who wait, and are not kept."""
        if key in self._entries:
            self.hits += 1
            self._entries.move_to_end(key)
            return self._entries[key]
        self.misses += 1
        task = self._running.get(key) or self._begin(key, compute)
        # Whoever asked first may go away; the others still want the answer.
        return await asyncio.shield(task)

    def _begin(self, key: str, compute: Callable[[], Awaitable[bytes]]) -> asyncio.Task[bytes]:
        task = asyncio.ensure_future(self._compute(key, compute))
        self._running[key] = task
        task.add_done_callback(lambda done: self._end(key, done))
        return task

    async def _compute(self, key: str, compute: Callable[[], Awaitable[bytes]]) -> bytes:
        answer = await compute()
        self.keep(key, answer)
        return answer

    def _end(self, key: str, task: asyncio.Task[bytes]) -> None:
        self._running.pop(key, None)
        if not task.cancelled():
            task.exception()  # mark as seen: those who waited may all be gone

    def keep(self, key: str, answer: bytes) -> None:
        """Keep an answer; the least used ones make room."""
        cost = len(answer) + OVERHEAD
        if cost > self.size:
            return
        self._entries[key] = answer
        self.used += cost
        while self.used > self.size:
            _, dropped = self._entries.popitem(last=False)
            self.used -= len(dropped) + OVERHEAD
