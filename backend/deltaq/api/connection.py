"""Connections that have to get on: who sends or reads too slowly is cut off, and holds no socket for long.

Nor does anybody hold all of them: there are as many as there are descriptors, no client has more than half, and where
there is no room for another, one that is idle has to go.
"""

from __future__ import annotations

import asyncio
import json
import resource
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from typing import Any

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol, RequestResponseCycle

from .clients import Proxies, client_of
from .languages import DEFAULT
from .problems import MEDIA_TYPE, OVERLOADED, RETRY_AFTER, Report

SLOWEST = 1024.0  # bytes per second that a client must read at least
DESCRIPTORS = 16_384  # more are not asked of the system
RESERVED = 96  # descriptors that are not for connections: files of the page, pipes to the workers, those just accepted
SEEN_OFF = 32  # refused connections at a time that may still read why; they have to fit into the reserve, too
FAREWELL = 1.0  # seconds that they get
ACCEPTED = 16  # connections at a time; they have to fit into the reserve, for they are counted afterwards


@dataclass(frozen=True)
class Timeouts:
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


def most_connections() -> int:
    """As many as there are descriptors for, after the process has been given as many as it may have, within reason."""
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    wanted = DESCRIPTORS if hard == resource.RLIM_INFINITY else min(DESCRIPTORS, hard)
    if soft != resource.RLIM_INFINITY and soft < wanted:
        with suppress(OSError, ValueError):  # some systems have another limit besides
            resource.setrlimit(resource.RLIMIT_NOFILE, (wanted, hard))
    soft, _ = resource.getrlimit(resource.RLIMIT_NOFILE)
    have = DESCRIPTORS if soft == resource.RLIM_INFINITY else min(DESCRIPTORS, soft)
    return max(ACCEPTED, have - RESERVED)


class Crowd:
    """The connections that are open, by client: at most `most`, of one client half of them."""

    def __init__(self, most: int) -> None:
        self.most = most
        self._by_address: dict[str, dict[Connection, None]] = {}  # the oldest first
        self._count = 0
        self._leaving: set[Connection] = set()

    def __len__(self) -> int:
        return self._count

    def enter(self, connection: Connection) -> bool:
        """Whether there is room, if need be in the place of one that is idle."""
        own = self._by_address.get(connection.address, {})
        if 2 * (len(own) + 1) > self.most and not self._make_room(own):
            return False
        if self._count >= self.most:
            greediest_first = sorted(self._by_address.values(), key=len, reverse=True)
            if not any(map(self._make_room, greediest_first)):
                return False
        self._by_address.setdefault(connection.address, {})[connection] = None
        self._count += 1
        return True

    def see_off(self, connection: Connection) -> bool:
        """Whether one that did not enter may stay until its client has read why."""
        if len(self._leaving) >= SEEN_OFF:
            return False
        self._leaving.add(connection)
        return True

    def leave(self, connection: Connection) -> None:
        """It is closed; one that never entered may leave, too."""
        self._leaving.discard(connection)
        own = self._by_address.get(connection.address, {})
        if connection in own:
            del own[connection]
            self._count -= 1
        if not own:
            self._by_address.pop(connection.address, None)

    def _make_room(self, own: dict[Connection, None]) -> bool:
        """Close the oldest that is idle; False if none is."""
        idle = next((one for one in own if one.is_idle), None)
        if idle is None:
            return False
        self.leave(idle)
        idle.transport.abort()
        return True


def refusal() -> bytes:
    """What is told where there is no room: a problem document, before anything is read."""
    report = Report(OVERLOADED, parameters={"seconds": RETRY_AFTER})
    body = json.dumps(report.document(DEFAULT), ensure_ascii=False).encode()
    head = f"HTTP/1.1 503 Service Unavailable\r\nContent-Type: {MEDIA_TYPE}\r\nContent-Length: {len(body)}\r\n"
    return f"{head}Retry-After: {RETRY_AFTER}\r\nConnection: close\r\n\r\n".encode() + body


class Connection(H11Protocol):
    """HTTP/1.1 with deadlines. The body of a request has its own (see body), and so has an idle connection."""

    address = ""  # of the client
    is_refused = False

    def __init__(self, *arguments: Any, timeouts: Timeouts, crowd: Crowd, **options: Any) -> None:
        super().__init__(*arguments, **options)
        self.timeouts = timeouts
        self.crowd = crowd
        self._head = Alarm()
        self._reading = Alarm()

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]  # as H11Protocol has it
        """Enters the crowd, or is refused."""
        super().connection_made(transport)
        self.address = client_of({"client": self.client, "headers": []}, Proxies())  # who is connected, not for whom
        if self.crowd.enter(self):
            self._watch_head()
        else:
            self._refuse(transport)

    def _refuse(self, transport: asyncio.Transport) -> None:
        """Tell that there is no room, and let what the client sends come in unread until it has gone.

        Closed at once, with the request still to come, the system would answer that with a reset, and a reset takes
        from the client what it has not read yet (RFC 9112 §9.6).
        """
        transport.write(refusal())
        if self.crowd.see_off(self):
            self.is_refused = True
            transport.write_eof()
            self._head.start(self.loop, FAREWELL, transport.abort)
        else:
            transport.close()

    @property
    def is_idle(self) -> bool:
        """Whether no request is being read or answered."""
        cycle: RequestResponseCycle | None = self.cycle
        return cycle is None or cycle.response_complete

    def data_received(self, data: bytes) -> None:
        """Parses the data; a request's head has a deadline."""
        if self.is_refused:
            return
        super().data_received(data)
        self._watch_head()

    def on_response_complete(self) -> None:
        """A further request that has begun has its own deadline."""
        super().on_response_complete()
        received, _ = self.conn.trailing_data
        if received or self.conn.their_state is not h11.IDLE:  # else it is idle, and uvicorn sees to that
            self._watch_head()

    def connection_lost(self, exc: Exception | None) -> None:
        """Leaves the crowd."""
        self.crowd.leave(self)
        self._head.stop()
        self._reading.stop()
        super().connection_lost(exc)

    def pause_writing(self) -> None:
        """The client reads slowly: from now on it is watched."""
        super().pause_writing()
        self._watch_reading(self.transport.get_write_buffer_size())

    def resume_writing(self) -> None:
        """The client has caught up."""
        super().resume_writing()
        self._reading.stop()

    def _watch_head(self) -> None:
        """The clock runs while the next head is to come, or the rest of a body that nobody waited for."""
        if self.conn.their_state is not h11.IDLE and self.conn.our_state is not h11.DONE:
            self._head.stop()
        elif not self.transport.is_closing():
            self._head.start(self.loop, self.timeouts.head, self.transport.abort)

    def _watch_reading(self, size: int) -> None:
        self._reading.start(self.loop, self.timeouts.reading, partial(self._look_at_reading, size))

    def _look_at_reading(self, before: int) -> None:
        self._reading.stop()
        size = self.transport.get_write_buffer_size()
        if before - size < SLOWEST * self.timeouts.reading:
            self.transport.abort()
        else:
            self._watch_reading(size)


def connections(timeouts: Timeouts, most: int) -> Callable[..., Connection]:
    """What uvicorn makes a protocol with; at most so many are open."""
    return partial(Connection, timeouts=timeouts, crowd=Crowd(most))
