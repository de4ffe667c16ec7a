"""Bodies are bounded before they are looked at, refused with few words, and paid for by who sent them."""

from __future__ import annotations

import asyncio
import json
import logging
import random
import threading
from collections.abc import AsyncIterator, Callable
from typing import Any

import httpx
import pytest
from fastapi import FastAPI
from tests.api.worst_bodies import MEGABYTE, TOML, VALUES, WHOLES, Worst, worst_bodies

from deltaq.api.app import create_app
from deltaq.api.body import SMALL, LargeBodies
from deltaq.api.clients import StepMeter
from deltaq.api.strict_json import DEEPEST, LONGEST_NUMBER, LONGEST_TEXT, MOST_ENTRIES, MOST_MEMBERS, MOST_VALUES, loads
from deltaq.api.workers.account import FREE, Account
from deltaq.errors import MOST_PROBLEMS, RequestError
from deltaq.settings import Settings

pytestmark = pytest.mark.anyio
DERIVATIONS = "/api/v1/derivations"
JSON = {"Content-Type": "application/json"}
LARGEST_ANSWER = 64_000  # bytes


def drawn(draw: random.Random, depth: int) -> Any:
    """Any document."""
    kind = draw.choice(("list", "table") if depth else ("text", "float", "int", "word"))
    match kind:
        case "list":
            return [drawn(draw, draw.randrange(depth)) for _ in range(draw.randrange(5))]
        case "table":
            return {text(draw): drawn(draw, draw.randrange(depth)) for _ in range(draw.randrange(5))}
        case "text":
            return text(draw)
        case "float":
            return draw.choice((-1, 1)) * draw.random() * 10.0 ** draw.randrange(-320, 308)
        case "int":
            return draw.choice((-1, 1)) * draw.randrange(10 ** draw.randrange(1, LONGEST_NUMBER - 1))
        case _:
            return draw.choice((True, False, None))


def text(draw: random.Random) -> str:
    return "".join(draw.choice('aä"\\/[]{},: \n\t\x00\x7f€😀') for _ in range(draw.randrange(9)))


@pytest.mark.parametrize("written", [{}, {"ensure_ascii": False}, {"indent": 2}])
def test_documents_are_read_as_the_standard_library_reads_them(written: dict[str, Any]) -> None:
    draw = random.Random(5)
    for _ in range(300):
        body = json.dumps(drawn(draw, 6), **written).encode()
        assert loads(body) == json.loads(body)


def test_numbers_are_the_nearest_ones() -> None:
    draw = random.Random(6)
    for _ in range(2000):
        digits = "".join(draw.choice("0123456789") for _ in range(draw.randrange(1, 40)))
        number = f"{draw.randrange(1, 10)}.{digits}e{draw.randrange(-330, 308)}"
        assert loads(number.encode()) == float(number)


@pytest.mark.parametrize("cut", range(1, 60, 3))
def test_what_ends_early_is_said_to_end_there(cut: int) -> None:
    body = json.dumps({"ä": [1, {"b€": "😀 x"}], "c": [True, None, 2.5], "d": "äöü\n"}, ensure_ascii=False)[:cut]
    with pytest.raises(RequestError) as caught:
        loads(body.encode())
    assert [(one.code, one.offset) for one in caught.value.problems] == [("json-syntax", len(body))]


@pytest.mark.parametrize(
    ("body", "pointers"),
    [
        pytest.param(b'{"scene":"pendulum","scene":"atwood"}', ["/scene"], id="at the top"),
        pytest.param(b'{"a":[{"b":1,"c":2,"b":1}],"c":0}', ["/a/0/b"], id="within, of one value"),
        pytest.param(b'{"a":1,"a":2,"x/y":{"d":1,"d":2}}', ["/a", "/x~1y/d"], id="two of them"),
        pytest.param(rb'{"a":1,"\u0061":2}', ["/a"], id="written in two ways"),
        pytest.param(b'{"a":{"b":1},"a":{"b":{"c":1,"c":2}}}', ["/a"], id="one in the other"),
        pytest.param(b'{"a":":","b":{"c":"{:,:}"},"c":[":"]}', [], id="colons in texts"),
        pytest.param(rb'{"a\":1,\"a\\":1,"a":{"a":{"a":1}}}', [], id="escapes, and a name at each depth"),
    ],
)
def test_a_name_that_comes_twice_is_told(body: bytes, pointers: list[str]) -> None:
    """RFC 8259, §4: of such names receivers keep one or the other, so that what was sent would be lost in silence."""
    if not pointers:
        assert loads(body) == json.loads(body)
        return
    with pytest.raises(RequestError) as caught:
        loads(body)
    assert [(one.code, one.pointer) for one in caught.value.problems] == [("json-repeated-name", at) for at in pointers]


def nested(depth: int) -> bytes:
    """A number below so many lists, by turns with tables."""
    pairs = [(b"[", b"]"), (b'{"a":', b"}")]
    chosen = [pairs[n % 2] for n in range(depth)]
    return b"".join(begin for begin, _ in chosen) + b"1" + b"".join(end for _, end in reversed(chosen))


def values(count: int) -> bytes:
    """A document of so many values, in lists that are short."""
    rows, rest = divmod(count - 1, MOST_ENTRIES - 99)
    row = [0] * (MOST_ENTRIES - 100)
    return json.dumps([*([row] * rows), *([0] * rest)]).encode()


@pytest.mark.parametrize(
    ("body", "most", "code", "pointer"),
    [
        pytest.param(
            lambda n: b'{"a":[%b]}' % b",".join([b"1"] * n), MOST_ENTRIES, "request-too-many", "/a", id="list"
        ),
        pytest.param(
            lambda n: b"[{%b}]" % b",".join(b'"%d":1' % one for one in range(n)),
            MOST_MEMBERS,
            "request-too-many",
            "/0",
            id="table",
        ),
        pytest.param(lambda n: b'{"a":"%b"}' % (b"x" * n), LONGEST_TEXT, "request-text-too-long", "/a", id="text"),
        pytest.param(lambda n: b'{"%b":1}' % (b"x" * n), LONGEST_TEXT, "request-text-too-long", "", id="name"),
        pytest.param(lambda n: b'{"a":%b}' % (b"7" * n), LONGEST_NUMBER, "json-number-too-long", "", id="number"),
        pytest.param(nested, DEEPEST, "json-too-deep", "", id="depth"),
        pytest.param(values, MOST_VALUES, "request-too-many-values", "", id="values"),
    ],
)
def test_bound(body: Callable[[int], bytes], most: int, code: str, pointer: str) -> None:
    assert loads(body(most)) == json.loads(body(most))
    with pytest.raises(RequestError) as caught:
        loads(body(most + 1))
    assert [(one.code, one.pointer) for one in caught.value.problems] == [(code, pointer)]


def test_what_stands_in_texts_counts_as_no_value() -> None:
    body = json.dumps(['"[{,' * 2000 + "\\", "\\" * 3000, "x" * 9000, '\\"' * 2000] * 20).encode()
    assert loads(body) == json.loads(body)


# One of each kind of body for some call, and all kinds for one of them: the rest is in the long run, bench_refusals.
STEP = 149


def chosen(document: dict[str, Any]) -> list[Worst]:
    return list(worst_bodies(document))[::STEP]


async def refused(client: httpx.AsyncClient, worst: Worst) -> str:
    """What is wrong with the answer to a body, "" if nothing is."""
    answer = await client.post(worst.path, content=worst.make(), headers={"Content-Type": worst.media_type})
    problems = answer.json()["problems"] if answer.headers["content-type"] == "application/problem+json" else []
    wrong = {
        f"status {answer.status_code}": answer.status_code >= 500,
        f"{len(answer.content)} bytes": len(answer.content) > LARGEST_ANSWER and answer.status_code != 200,
        f"{len(problems)} problems": len(problems) > MOST_PROBLEMS + 1,
    }
    return ", ".join(what for what, true in wrong.items() if true)


async def test_worst_bodies_are_refused_in_few_words(app: FastAPI, client: httpx.AsyncClient) -> None:
    found = {str(worst): await refused(client, worst) for worst in chosen(app.openapi())}
    assert {name: wrong for name, wrong in found.items() if wrong} == {}
    assert len(found) > 80


@pytest.mark.parametrize("name", [*VALUES, *WHOLES])
async def test_worst_list_of_guides(client: httpx.AsyncClient, name: str) -> None:
    value = (VALUES | WHOLES)[name](MEGABYTE)
    worst = Worst(DERIVATIONS, JSON["Content-Type"], name, lambda: b'{"scene":"pendulum","guides":%b}' % value)
    assert await refused(client, worst) == ""


@pytest.mark.parametrize(
    ("body", "count", "last"),
    [
        pytest.param({"scene": "pendulum", "parameters": {f"p{n}": "x" for n in range(250)}}, 51, True, id="too many"),
        pytest.param({"scene": "pendulum", "parameters": {f"p{n}": "x" for n in range(50)}}, 50, False, id="as many"),
        pytest.param({"scene": "pendulum", **{f"p{n}": 1 for n in range(250)}}, 51, True, id="unknown members"),
        pytest.param({"scene": "pendulum", "guides": [1] * 900}, 1, False, id="of a list the first"),
        pytest.param({"scene": "pendulum", "freeze": [1] * 900}, 1, False, id="of names the first"),
        pytest.param({"scene": {"loads": [{"kind": "x" * 900}] * 64}}, 51, True, id="found by a worker"),
    ],
)
async def test_problems_that_are_told(client: httpx.AsyncClient, body: dict[str, Any], count: int, last: bool) -> None:
    answer = await client.post(DERIVATIONS, json=body)
    problems = answer.json()["problems"]
    assert (answer.status_code, len(problems)) == (422, count)
    assert (problems[-1]["code"] == "more-problems") is last
    assert all(one["pointer"] for one in problems[:50])


async def test_long_pointers_leave_less_room(client: httpx.AsyncClient) -> None:
    """Each of fifty may have sixty names of sixty letters."""
    inner: Any = {f"{n}": float("inf") for n in range(60)}
    for _ in range(50):
        inner = {"n" * 60: inner}
    body = json.dumps({"scene": inner}).encode()
    answer = await client.post(DERIVATIONS, content=body, headers=JSON)
    assert len(answer.content) < LARGEST_ANSWER
    assert 1 < len(answer.json()["problems"]) < MOST_PROBLEMS
    assert answer.json()["problems"][-1]["code"] == "more-problems"


@pytest.mark.parametrize("name", TOML)
async def test_worst_toml(client: httpx.AsyncClient, name: str) -> None:
    for size in (2**14, 2**16 - 2**5, MEGABYTE):
        worst = Worst("/api/v1/scenes/toml", "application/toml", name, lambda size=size: TOML[name](size))
        assert await refused(client, worst) == ""


# Who pays.


def poor_client(app: FastAPI, address: str) -> httpx.AsyncClient:
    transport = httpx.ASGITransport(app=app, client=(address, 1234), raise_app_exceptions=False)
    return httpx.AsyncClient(transport=transport, base_url="http://deltaq.test", timeout=60)


LARGE = b'{"scene": "pendulum", "guides": [%b]}' % b",".join([b"1"] * 10_000)
REFUSALS: dict[str, tuple[str, str, bytes]] = {
    "large": ("POST", DERIVATIONS, LARGE),
    "small": ("POST", DERIVATIONS, b'{"scene": "pendulum", "guides": [1]}'),
    "no JSON": ("POST", DERIVATIONS, b"{"),
    "too large": ("POST", DERIVATIONS, b" " * (2**20 + 1)),
    "no such scene": ("POST", DERIVATIONS, b'{"scene": "x"}'),
    "no such address": ("GET", "/api/v1/nothing", b""),
    "no such method": ("DELETE", DERIVATIONS, b""),
}


@pytest.mark.parametrize("refusal", REFUSALS)
async def test_refusals_are_charged_to_their_client(refusal: str) -> None:
    app = create_app(Settings(workers=1, client_share=1e-9, client_credit=1e-9))
    method, path, body = REFUSALS[refusal]
    async with poor_client(app, "192.0.2.1") as one, poor_client(app, "192.0.2.2") as other:
        assert (await one.request(method, path, content=body, headers=JSON)).status_code in {400, 404, 405, 413, 422}
        assert (await one.post(DERIVATIONS, content=LARGE, headers=JSON)).status_code == 429
        assert (await other.post(DERIVATIONS, content=LARGE, headers=JSON)).status_code == 422


async def test_large_bodies_are_read_beside_the_loop_and_clients_take_turns() -> None:
    large, order = LargeBodies(), []
    assert len(LARGE) > SMALL

    def work(name: str) -> Callable[[], None]:
        return lambda: order.append((name, threading.current_thread() is threading.main_thread()))

    one, other = Account("192.0.2.1"), Account("192.0.2.2")
    await asyncio.gather(*(large.read(work("one"), one) for _ in range(3)), large.read(work("other"), other))
    assert order == [("one", False), ("other", False), ("one", False), ("one", False)]
    assert await large.read(lambda: 7, FREE) == 7


async def test_meter_counts_the_steps_of_a_coroutine_and_not_its_waiting() -> None:
    meter = StepMeter()

    async def failing() -> int:
        try:
            await asyncio.sleep(0.2)
            raise KeyError
        except KeyError:
            return sum(range(300_000))

    assert await meter.measured(failing()) == sum(range(300_000))
    assert 0.0005 < meter.seconds < 0.15


async def test_metered_coroutine_is_cancelled_like_any() -> None:
    ended = []

    async def waiting() -> None:
        try:
            await asyncio.sleep(60)
        finally:
            ended.append("ended")

    task = asyncio.ensure_future(StepMeter().measured(waiting()))
    await asyncio.sleep(0.01)
    task.cancel()
    with pytest.raises(asyncio.CancelledError):
        await task
    assert ended == ["ended"]


# Who leaves.


async def half_a_body() -> AsyncIterator[dict[str, Any]]:
    yield {"type": "http.request", "body": b'{"scene": ', "more_body": True}
    yield {"type": "http.disconnect"}


async def test_client_that_leaves_in_the_middle_of_its_body_is_no_mistake(
    app: FastAPI, caplog: pytest.LogCaptureFixture
) -> None:
    messages, sent = half_a_body(), []
    scope = {
        "type": "http",
        "http_version": "1.1",
        "method": "POST",
        "scheme": "http",
        "path": DERIVATIONS,
        "raw_path": DERIVATIONS.encode(),
        "query_string": b"",
        "headers": [(b"content-type", b"application/json")],
        "client": ("192.0.2.1", 1),
        "server": ("deltaq.test", 80),
    }

    async def receive() -> Any:
        return await anext(messages)

    async def send(message: Any) -> None:
        sent.append(message)

    with caplog.at_level(logging.WARNING):
        await app(scope, receive, send)
    assert sent[0]["status"] == 499
    assert caplog.records == []
