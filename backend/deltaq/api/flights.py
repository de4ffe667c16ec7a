"""One computation for all who ask for the same at once."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from dataclasses import dataclass

GRACE = 0.5  # seconds for which a computation goes on when nobody waits: pages that are reloaded ask again


@dataclass
class Flight:
    """A computation under way, and how many wait for it."""

    task: asyncio.Task[bytes]
    waiting: int = 0

    def give_up(self) -> None:
        """End it if still nobody waits."""
        if not self.waiting:
            self.task.cancel()


class Flights:
    """The computations under way, by key. Used from one event loop."""

    def __init__(self) -> None:
        self._flights: dict[str, Flight] = {}

    async def join(self, key: str, compute: Callable[[], Awaitable[bytes]]) -> bytes:
        """What `compute` gives; errors reach all who wait. Whoever asked first may go away; the others still wait."""
        flight = self._flights.get(key) or self._begin(key, compute)
        flight.waiting += 1
        try:
            return await asyncio.shield(flight.task)
        finally:
            flight.waiting -= 1
            if not flight.waiting and not flight.task.done():
                asyncio.get_running_loop().call_later(GRACE, flight.give_up)

    def _begin(self, key: str, compute: Callable[[], Awaitable[bytes]]) -> Flight:
        flight = self._flights[key] = Flight(asyncio.ensure_future(_awaited(compute)))
        flight.task.add_done_callback(lambda task: self._end(key, task))
        return flight

    def _end(self, key: str, task: asyncio.Task[bytes]) -> None:
        self._flights.pop(key, None)
        if not task.cancelled():
            task.exception()  # mark as seen: those who waited may all be gone


async def _awaited(compute: Callable[[], Awaitable[bytes]]) -> bytes:
    return await compute()
