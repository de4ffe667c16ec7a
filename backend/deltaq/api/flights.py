"""One computation for all who ask for the same at once."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from dataclasses import dataclass

GRACE = 0.5  # seconds for which a computation goes on when nobody waits: pages that are reloaded ask again

Hear = Callable[[bytes], object]
Compute = Callable[[Hear], Awaitable[bytes]]


def ignore(_part: bytes) -> None:
    """Hear nothing of what comes before the answer."""


class Audience:
    """Those who wait for a computation, and hear the parts of its answer.

    Each part says all that those before it said, so who comes late hears the newest one and has missed nothing.
    """

    def __init__(self) -> None:
        self._members: list[Hear] = []
        self._newest: bytes | None = None

    def __len__(self) -> int:
        return len(self._members)

    def enter(self, hear: Hear) -> None:
        """Somebody waits, too."""
        if self._newest is not None:
            hear(self._newest)
        self._members.append(hear)

    def leave(self, hear: Hear) -> None:
        """Somebody waits no more."""
        self._members.remove(hear)

    def tell(self, part: bytes) -> None:
        """Let all hear a part."""
        self._newest = part
        for hear in self._members:
            hear(part)


@dataclass(frozen=True)
class Flight:
    """A computation under way, and who waits for it."""

    task: asyncio.Task[bytes]
    audience: Audience

    def give_up(self) -> None:
        """End it if still nobody waits."""
        if not self.audience:
            self.task.cancel()


class Flights:
    """The computations under way, by key. Used from one event loop."""

    def __init__(self) -> None:
        self._flights: dict[str, Flight] = {}

    async def join(self, key: str, compute: Compute, hear: Hear = ignore) -> bytes:
        """What `compute` gives; errors reach all who wait. Whoever asked first may go away; the others still wait."""
        flight = self._flights.get(key) or self._begin(key, compute)
        flight.audience.enter(hear)
        try:
            return await asyncio.shield(flight.task)
        finally:
            flight.audience.leave(hear)
            if not flight.audience and not flight.task.done():
                asyncio.get_running_loop().call_later(GRACE, flight.give_up)

    def _begin(self, key: str, compute: Compute) -> Flight:
        audience = Audience()
        flight = self._flights[key] = Flight(asyncio.ensure_future(_awaited(compute, audience.tell)), audience)
        flight.task.add_done_callback(lambda task: self._end(key, task))
        return flight

    def _end(self, key: str, task: asyncio.Task[bytes]) -> None:
        self._flights.pop(key, None)
        if not task.cancelled():
            task.exception()  # mark as seen: those who waited may all be gone


async def _awaited(compute: Compute, tell: Hear) -> bytes:
    return await compute(tell)
