"""One computation for all who ask for the same at once."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from typing import Literal

GRACE = 0.5  # seconds for which a computation goes on when nobody waits: pages that are reloaded ask again


@dataclass(frozen=True)
class Said:
    """What is said of a computation before its answer is there: `waiting` with its place, or `part` of the answer."""

    kind: Literal["waiting", "part"]
    data: bytes  # JSON


Hear = Callable[[Said], object]
Compute = Callable[[Hear], Awaitable[bytes]]


def ignore(_said: object) -> None:
    """Hear nothing of what comes before the answer."""


class Subscribers:
    """Those who wait for a computation, and hear what is said of it.

    Whatever is said replaces what was said before, so who comes late hears the newest and has missed nothing.
    """

    def __init__(self) -> None:
        self._subscribed: list[Hear] = []
        self._newest: Said | None = None

    def __len__(self) -> int:
        return len(self._subscribed)

    def add(self, hear: Hear) -> None:
        """Somebody waits, too."""
        if self._newest is not None:
            hear(self._newest)
        self._subscribed.append(hear)

    def remove(self, hear: Hear) -> None:
        """Somebody waits no more."""
        self._subscribed.remove(hear)

    def tell(self, said: Said) -> None:
        """Let all hear it."""
        self._newest = said
        for hear in self._subscribed:
            hear(said)


@dataclass(frozen=True)
class Flight:
    """A computation under way, and who waits for it."""

    task: asyncio.Task[bytes]
    subscribers: Subscribers


class Flights:
    """The computations under way, by key. Used from one event loop."""

    def __init__(self) -> None:
        self._flights: dict[str, Flight] = {}

    async def join(self, key: str, compute: Compute, hear: Hear = ignore) -> bytes:
        """What `compute` gives; errors reach all who wait. Whoever asked first may go away; the others still wait.

        How long each of them waits is not decided here: see `Pool.asked`.
        """
        flight = self._flights.get(key) or self._begin(key, compute)
        flight.subscribers.add(hear)
        try:
            return await asyncio.shield(flight.task)
        finally:
            flight.subscribers.remove(hear)
            if not flight.subscribers and not flight.task.done():
                asyncio.get_running_loop().call_later(GRACE, self._give_up, key, flight)

    def _begin(self, key: str, compute: Compute) -> Flight:
        subscribers = Subscribers()
        flight = self._flights[key] = Flight(asyncio.ensure_future(_awaited(compute, subscribers.tell)), subscribers)
        flight.task.add_done_callback(lambda _: self._end(key, flight))
        return flight

    def _give_up(self, key: str, flight: Flight) -> None:
        """End it if still nobody waits. It takes a moment to end, and who asks meanwhile must get another one."""
        if not flight.subscribers:
            self._forget(key, flight)
            flight.task.cancel()

    def _end(self, key: str, flight: Flight) -> None:
        self._forget(key, flight)
        if not flight.task.cancelled():
            flight.task.exception()  # mark as seen: those who waited may all be gone

    def _forget(self, key: str, flight: Flight) -> None:
        """The next who asks begins another; one that has begun already stays."""
        if self._flights.get(key) is flight:
            del self._flights[key]


async def _awaited(compute: Compute, tell: Hear) -> bytes:
    return await compute(tell)
