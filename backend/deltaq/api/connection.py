"""Connections that have to get on: who sends or reads too slowly is cut off, and holds no socket for long."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol

SLOWEST = 1024.0  # bytes per second that a client must read at least


@dataclass(frozen=True)
class Patience:
    """Seconds for the head of a request, and between two looks at whether a client reads its answer."""

    head: float
    reading: float


class Alarm:
    """Rings once after some seconds, unless it is stopped before."""

    def __init__(self) -> None:
        self._handle: asyncio.TimerHandle | None = None

    def start(self, loop: asyncio.AbstractEventLoop, seconds: float, ring: Callable[[], object]) -> None:
        """Begin to wait; an alarm that waits already goes on."""
        if self._handle is None:
            self._handle = loop.call_later(seconds, ring)

    def stop(self) -> None:
        """Ring no more."""
        if self._handle is not None:
            self._handle.cancel()
            self._handle = None


class Connection(H11Protocol):
    """HTTP/1.1 with deadlines. The body of a request has its own (see body), and so has an idle connection."""

    def __init__(self, *arguments: Any, patience: Patience, **options: Any) -> None:
        super().__init__(*arguments, **options)
        self.patience = patience
        self._head = Alarm()
        self._reading = Alarm()

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]  # as H11Protocol has it
        super().connection_made(transport)
        self._watch_head()

    def data_received(self, data: bytes) -> None:
        super().data_received(data)
        self._watch_head()

    def on_response_complete(self) -> None:
        super().on_response_complete()
        received, _ = self.conn.trailing_data
        if received or self.conn.their_state is not h11.IDLE:  # else it is idle, and uvicorn sees to that
            self._watch_head()

    def connection_lost(self, exc: Exception | None) -> None:
        self._head.stop()
        self._reading.stop()
        super().connection_lost(exc)

    def pause_writing(self) -> None:
        super().pause_writing()
        self._watch_reading(self.transport.get_write_buffer_size())

    def resume_writing(self) -> None:
        super().resume_writing()
        self._reading.stop()

    def _watch_head(self) -> None:
        """The clock runs while the next head is to come, or the rest of a body that nobody waited for."""
        if self.conn.their_state is not h11.IDLE and self.conn.our_state is not h11.DONE:
            self._head.stop()
        elif not self.transport.is_closing():
            self._head.start(self.loop, self.patience.head, self.transport.abort)

    def _watch_reading(self, size: int) -> None:
        self._reading.start(self.loop, self.patience.reading, partial(self._look_at_reading, size))

    def _look_at_reading(self, before: int) -> None:
        self._reading.stop()
        size = self.transport.get_write_buffer_size()
        if before - size < SLOWEST * self.patience.reading:
            self.transport.abort()
        else:
            self._watch_reading(size)


def connections(patience: Patience) -> Callable[..., Connection]:
    """What uvicorn makes a protocol with."""
    return partial(Connection, patience=patience)
