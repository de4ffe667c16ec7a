"""How many connections there may be, and whose."""

from __future__ import annotations

import json
import random
import resource
from collections import Counter
from dataclasses import dataclass, field
from typing import Any, cast

import pytest

from deltaq.api.connection import DESCRIPTORS, RESERVED, Connection, Crowd, most_connections, refusal


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
