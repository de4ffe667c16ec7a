"""How many connections there may be, and whose."""

from __future__ import annotations

import asyncio
import json
import random
import resource
import select
import socket
import threading
import time
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing, contextmanager
from dataclasses import dataclass, field
from http.client import HTTPConnection
from typing import Any, cast

import httpx
import pytest
import uvicorn

from deltaq.api.connection import (
    DESCRIPTORS,
    FAREWELL,
    RESERVED,
    SEEN_OFF,
    Connection,
    Crowd,
    Timeouts,
    connections,
    most_connections,
    refusal,
)


@dataclass(eq=False)
class Fake:
    """A connection, as far as a crowd looks at it."""

    address: str
    is_idle: bool
    aborted: bool = False
    transport: Any = field(init=False)

    def __post_init__(self) -> None:
        self.transport = self

    def abort(self) -> None:
        self.aborted = True


def enter(crowd: Crowd, one: Fake) -> bool:
    return crowd.enter(cast("Connection", one))


def leave(crowd: Crowd, one: Fake) -> None:
    crowd.leave(cast("Connection", one))


def test_no_client_holds_more_than_half_and_only_idle_ones_have_to_go() -> None:
    draw, most = random.Random(3), 20
    crowd, present = Crowd(most), list[Fake]()
    for _ in range(5000):
        if present and draw.random() < 0.3:
            leave(crowd, present.pop(draw.randrange(len(present))))
        for one in present:
            one.is_idle = one.is_idle if draw.random() < 0.9 else not one.is_idle
        came = Fake(draw.choice("aaaaabcdef"), is_idle=draw.random() < 0.5)
        own = Counter(one.address for one in present)
        idle = {one.address for one in present if one.is_idle}
        own_room = 2 * (own[came.address] + 1) <= most or came.address in idle
        full = len(present) == most
        entered = enter(crowd, came)
        gone = [one for one in present if one.aborted]
        present = [one for one in present if not one.aborted] + [came] * entered
        assert all(one.is_idle for one in gone)
        assert len(gone) <= 2
        assert len(crowd) == len(present) <= most
        assert max(Counter(one.address for one in present).values()) <= most / 2
        assert entered is (own_room and (not full or bool(idle)))
        if not full and 2 * (own[came.address] + 1) <= most:
            assert not gone


def test_the_longest_idle_goes_first() -> None:
    crowd = Crowd(4)
    old, older_but_busy = Fake("a", is_idle=True), Fake("a", is_idle=False)
    assert enter(crowd, older_but_busy)
    assert enter(crowd, old)
    assert enter(crowd, Fake("a", is_idle=True))
    assert (old.aborted, older_but_busy.aborted) == (True, False)


def test_who_never_entered_may_leave() -> None:
    crowd = Crowd(2)
    one, other = Fake("a", is_idle=False), Fake("a", is_idle=False)
    assert enter(crowd, one)
    assert not enter(crowd, other)
    leave(crowd, other)
    assert len(crowd) == 1
    leave(crowd, one)
    leave(crowd, one)
    assert len(crowd) == 0


@contextmanager
def full(most: int) -> Iterator[str]:
    """The address of a server in which one client has all the connections that it may have, none of them idle."""
    over, begun = threading.Event(), threading.Semaphore(0)

    async def app(scope: Any, receive: Any, send: Any) -> None:
        begun.release()
        while not over.is_set():
            await asyncio.sleep(0.01)
        await send({"type": "http.response.start", "status": 200, "headers": []})
        await send({"type": "http.response.body", "body": b""})

    http: Any = connections(Timeouts(10.0, 10.0), most)
    server = uvicorn.Server(uvicorn.Config(app, http=http, port=0, lifespan="off", log_config=None))
    with socket.create_server(("127.0.0.1", 0)) as listener, ThreadPoolExecutor(1 + most) as others:
        serving = others.submit(server.run, [listener])
        address = f"http://127.0.0.1:{listener.getsockname()[1]}/"
        try:
            held = [others.submit(httpx.get, address, timeout=60) for _ in range(most // 2)]
            assert all(begun.acquire(timeout=20) for _ in held)
            yield address
            over.set()
            assert [one.result().status_code for one in held] == [200] * (most // 2)
        finally:
            over.set()
            server.should_exit = True
            serving.result(20)


@pytest.mark.parametrize("size", [0, 100, 400_000], ids=["no body", "a body", "a large body"])
def test_whom_there_is_no_room_for_is_told_so(size: int) -> None:
    """Whatever a client has still to send when it is refused, it reads the answer."""
    with full(4) as address:
        for _ in range(12):
            asking = HTTPConnection(httpx.URL(address).netloc.decode(), timeout=20)
            with closing(asking):  # a plain client, which sends all before it reads, and here after it was refused
                asking.connect()
                select.select([asking.sock], [], [], 20.0)
                asking.request("POST" if size else "GET", "/", body=b"x" * size or None)
                response = asking.getresponse()
                problem = json.loads(response.read())
            assert (response.status, response.getheader("content-type")) == (503, "application/problem+json")
            assert int(response.getheader("retry-after", "0")) > 0
            assert (problem["type"], problem["status"]) == ("/problems/overloaded", 503)


def test_who_is_refused_and_does_not_go_is_cut_off() -> None:
    with full(4) as address, socket.create_connection(("127.0.0.1", httpx.URL(address).port or 80), timeout=20) as one:
        while one.recv(2**16):
            pass
        end = time.monotonic() + 20.0 * FAREWELL
        while is_open(one):
            assert time.monotonic() < end


def is_open(connection: socket.socket) -> bool:
    """Whether the other end still takes what is sent."""
    time.sleep(0.05)
    try:
        connection.sendall(b"x")
    except OSError:
        return False
    return True


def test_few_of_those_refused_may_stay() -> None:
    crowd, many = Crowd(4), [Fake("a", is_idle=False) for _ in range(2 * SEEN_OFF)]
    assert [crowd.see_off(cast("Connection", one)) for one in many] == [True] * SEEN_OFF + [False] * SEEN_OFF
    leave(crowd, many[0])
    assert crowd.see_off(cast("Connection", many[-1]))


def test_refusal_is_a_problem_document() -> None:
    head, _, body = refusal().partition(b"\r\n\r\n")
    fields = dict(line.split(": ", 1) for line in head.decode().split("\r\n")[1:])
    assert head.startswith(b"HTTP/1.1 503 ")
    assert int(fields["Content-Length"]) == len(body)
    assert fields["Content-Type"] == "application/problem+json"
    assert json.loads(body)["type"] == "/problems/overloaded"


@pytest.mark.parametrize(
    ("soft", "hard", "raised"),
    [
        pytest.param(256, 4096, 4096, id="raised as far as it may be"),
        pytest.param(256, 256, 256, id="few"),
        pytest.param(1024, resource.RLIM_INFINITY, DESCRIPTORS, id="within reason"),
        pytest.param(2**20, 2**20, 2**20, id="enough"),
    ],
)
def test_soft_limit_is_raised(monkeypatch: pytest.MonkeyPatch, soft: int, hard: int, raised: int) -> None:
    limits = [soft, hard]
    monkeypatch.setattr(resource, "getrlimit", lambda kind: tuple(limits))
    monkeypatch.setattr(resource, "setrlimit", lambda kind, pair: limits.__setitem__(slice(None), pair))
    assert most_connections() == min(raised, DESCRIPTORS) - RESERVED
    assert limits == [raised, hard]
