"""The end of the service: who still waits shortly before it is told so, as long as there is time to tell."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable
from typing import TypeVar

from .workers.job import WorkerKilled

T = TypeVar("T")
PART = 0.75  # of the time that requests under way get; in the rest they are told that it is over


class Ending:
    """Whether the service is about to end. Used from one thread."""

    def __init__(self) -> None:
        self._begun = False
        self._waiting: set[asyncio.Future[None]] = set()

    def begin(self) -> None:
        """All that is waited for ends now."""
        self._begun = True
        for over in self._waiting:
            over.set_result(None)
        self._waiting.clear()

    async def unless(self, work: Awaitable[T]) -> T:
        """What the work gives; WorkerKilled if the service ends before, and the work is cancelled."""
        working = asyncio.ensure_future(work)
        over = asyncio.get_running_loop().create_future()
        self._waiting.add(over)
        if self._begun:
            self.begin()
        try:
            await asyncio.wait({working, over}, return_when=asyncio.FIRST_COMPLETED)
            if working.done():
                return working.result()
            raise WorkerKilled("the service ends")
        finally:
            working.cancel()
            self._waiting.discard(over)
