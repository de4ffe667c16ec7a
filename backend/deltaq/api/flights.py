"""Coalescing: one computation for all who ask for the same at once (in Go, singleflight)."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from typing import Literal

GRACE = 0.5  # seconds for which a computation goes on when nobody waits: pages that are reloaded ask again


@dataclass(frozen=True)
class Update:
    """News of a computation before its answer.

    `preparing` while what it needs is compiled, `waiting` with its place in the queue, or a `part` of the answer.
    """

    kind: Literal["preparing", "waiting", "part"]
    data: bytes  # JSON


OnUpdate = Callable[[Update], object]
Compute = Callable[[OnUpdate], Awaitable[bytes]]


def ignore(_said: object) -> None:
    """Does nothing with what comes before the answer."""


class Subscribers:
    """Those who wait for a computation, and receive its updates.

    An update replaces the one before, so whoever subscribes late receives the newest and has missed nothing.
    """

    def __init__(self) -> None:
        self._subscribed: list[OnUpdate] = []
        self._newest: Update | None = None

    def __len__(self) -> int:
        return len(self._subscribed)

    def add(self, on_update: OnUpdate) -> None:
        """Somebody else waits."""
        if self._newest is not None:
            on_update(self._newest)
        self._subscribed.append(on_update)

    def remove(self, on_update: OnUpdate) -> None:
        """Somebody no longer waits."""
        self._subscribed.remove(on_update)

    def publish(self, update: Update) -> None:
        """Sends an update to all."""
        self._newest = update
        for on_update in self._subscribed:
            on_update(update)


@dataclass(frozen=True)
class Flight:
    """A computation under way, and who waits for it."""

    task: asyncio.Task[bytes]
    subscribers: Subscribers


class Flights:
    """The computations under way, by key. Used from one event loop."""

    def __init__(self) -> None:
        self._flights: dict[str, Flight] = {}

    async def join(self, key: str, compute: Compute, on_update: OnUpdate = ignore) -> bytes:
        """The result of `compute`; its errors reach all who wait. Whoever asked first may leave; the others still wait.

        How long each of them waits is not decided here: see `Pool.asked`.
        """
        flight = self._flights.get(key) or self._begin(key, compute)
        flight.subscribers.add(on_update)
        try:
            return await asyncio.shield(flight.task)
        finally:
            flight.subscribers.remove(on_update)
            if not flight.subscribers and not flight.task.done():
                asyncio.get_running_loop().call_later(GRACE, self._give_up, key, flight)

    def _begin(self, key: str, compute: Compute) -> Flight:
        subscribers = Subscribers()
        flight = self._flights[key] = Flight(asyncio.ensure_future(_awaited(compute, subscribers.publish)), subscribers)
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


async def _awaited(compute: Compute, publish: OnUpdate) -> bytes:
    return await compute(publish)
