"""Ensembles over HTTP: streamed in blocks they are what they are in one answer; what came before a failure stays."""

from __future__ import annotations

import asyncio
import contextlib
import json
import os
import signal
from base64 import b64decode
from collections.abc import AsyncIterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import pytest
from fastapi import FastAPI
from pydantic import BaseModel
from tests.serving import PATIENCE, PATIENT, served

from deltaq.api import blocks as streaming
from deltaq.api import kernels, streams
from deltaq.api.blocks import Blocks
from deltaq.api.routes import ensembles
from deltaq.api.service import Service
from deltaq.contract.ensemble import EnsembleAnswer, EnsembleBlock, EnsembleRequest, EnsembleTotals
from deltaq.simulation.kernels.marks import declared
from deltaq.simulation.library import kernel_groups

pytestmark = pytest.mark.anyio
ADDRESS, STREAM = "/api/v1/ensembles", {"Accept": "text/event-stream"}
OF_BLOCKS = {"first", "runs", "of"}
Event = tuple[str, Any]

ANGLE, MANY = "initial.phi.value", {"normal": [1.0, 0.3], "count": 150, "seed": 2}
PENDULUMS = {"scene": "pendulum", "t_end": 3.0, "samples": 4, "vary": {ANGLE: MANY}, "lang": "en"}


def under(force: str) -> dict[str, Any]:
    """A particle on a line."""
    return {
        "format": 1,
        "id": "line",
        "title": {"en": "Line"},
        "dimension": 2,
        "coordinates": [{"name": "x", "value": 0.1}],
        "parameters": [{"name": "m", "value": 1.0}],
        "points": [{"name": "o", "position": ["0", "0"]}],
        "bodies": [{"name": "p", "kind": "particle", "mass": "m", "position": ["x", "0"]}],
        "loads": [{"kind": "force", "at": "p", "force": [force, "0"]}],
    }


RUNAWAY = {"scene": under("m*x^3"), "vary": {"initial.x.value": {"from": 0.0, "to": 3.0, "count": 200}}}
JUMPS = {"scene": under("-m*sign(x)"), "vary": {"initial.x.value": {"from": 0.5, "to": 2.0, "count": 20_000}}}  # singly
BALL = {"scene": "bouncing-ball", "t_end": 0.5, "samples": 3, "vary": {"initial.z.value": [0.5, 0.6, 0.7]}}


async def events_of(response: httpx.Response) -> AsyncIterator[Event]:
    kind = ""
    async for line in response.aiter_lines():
        if line.startswith("event: "):
            kind = line.removeprefix("event: ")
        elif line.startswith("data: "):
            yield kind, json.loads(line.removeprefix("data: "))


async def streamed(client: httpx.AsyncClient, question: dict[str, Any]) -> list[Event]:
    """All events but those of waiting."""
    async with client.stream("POST", ADDRESS, json=question, headers=STREAM) as response:
        assert response.status_code == 200
        assert response.headers["content-type"].startswith("text/event-stream")
        assert response.headers["cache-control"] == "no-store"
        return [event async for event in events_of(response) if event[0] != "waiting"]


def put_together(parts: list[Any], columns: str) -> Any:
    """One column of all blocks, in their order; packed ones as bytes."""
    if isinstance(parts[0], dict):
        return {name: put_together([part[name] for part in parts], columns) for name in parts[0]}
    if isinstance(parts[0], str):
        return b"".join(doubles(part, columns) for part in parts)
    return [entry for part in parts for entry in part]


def doubles(column: str, columns: str) -> bytes:
    raw = b64decode(column)
    return np.frombuffer(raw, np.uint8).reshape(8, -1).T.tobytes() if columns == "planes" else raw


def unpacked(member: Any, columns: str) -> Any:
    if isinstance(member, dict):
        return {name: unpacked(one, columns) for name, one in member.items()}
    return doubles(member, columns) if isinstance(member, str) else member


def undeclared(document: dict[str, Any], kind: type[BaseModel]) -> set[str]:
    return set(kind.model_validate_json(json.dumps(document)).model_extra or ())


ASKED = [
    pytest.param(PENDULUMS, id="numbers"),
    pytest.param(PENDULUMS | {"columns": "base64"}, id="base64"),
    pytest.param(PENDULUMS | {"columns": "planes"}, id="planes"),
    pytest.param(PENDULUMS | {"statistics": ["mean", "quantiles", "density"], "runs": False}, id="statistics alone"),
    pytest.param(
        PENDULUMS | RUNAWAY | {"statistics": ["mean"], "lang": "de"},
        id="some run away",
    ),
    pytest.param(BALL, id="one by one"),
    pytest.param(PENDULUMS | {"section": {"value": "phi", "points": 2}}, id="section"),
    pytest.param(
        PENDULUMS | RUNAWAY | {"section": {"value": "x - 2", "direction": "both"}, "columns": "base64", "runs": False},
        id="section that some never meet",
    ),
    pytest.param(PENDULUMS | {"vary": {ANGLE: [1.0]}}, id="a single one"),
]


@pytest.mark.parametrize("question", ASKED)
async def test_blocks_put_together_are_the_answer(client: httpx.AsyncClient, question: dict[str, Any]) -> None:
    events, columns = await streamed(client, question), question.get("columns", "numbers")
    blocks = sorted((data for kind, data in events if kind == "block"), key=lambda block: block["first"])
    assert [kind for kind, _ in events] == ["block"] * len(blocks) + ["result"]
    answer, result = (await client.post(ADDRESS, json=question)).json(), events[-1][1]
    assert [block["first"] for block in blocks] == [sum(one["runs"] for one in blocks[:n]) for n in range(len(blocks))]
    assert sum(block["runs"] for block in blocks) == answer["runs"]
    assert {block["of"] for block in blocks} == {answer["runs"]}
    assert all(undeclared(block, EnsembleBlock) == set() for block in blocks)
    assert undeclared(result, EnsembleTotals) == undeclared(answer, EnsembleAnswer) == set()
    for name in blocks[0].keys() - OF_BLOCKS - {"reasons", "columns"}:
        assert put_together([block[name] for block in blocks], columns) == unpacked(answer[name], columns), name
    assert {name: result[name] for name in result if name != "wall_time"} == {
        name: answer[name] for name in answer if name in result and name != "wall_time"
    }
    assert answer.keys() == (result.keys() | blocks[0].keys()) - (OF_BLOCKS - {"runs"})
    for block in blocks:
        assert block["reasons"].keys() == {*block["status"], *block.get("section", {"status": ()})["status"]}
    again = await streamed(client, question)  # from the cache, with the time that it took
    assert again == events


async def test_long_streams_are_not_kept(client: httpx.AsyncClient, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(streaming, "MOST_KEPT", 2000)
    question = PENDULUMS | {"t_end": 3.5}
    first, second = [await streamed(client, question) for _ in range(2)]
    assert first[-1][1]["wall_time"] != second[-1][1]["wall_time"]
    assert sorted(data["first"] for kind, data in second if kind == "block") == [0, 64, 128]


LINE = under("-m*sign(x)")
ROD = {"scene": "cartesian-pendulum", "vary": {"parameters.m": [1.0, 2.0]}}
# What is wrong with a request, and the field and code that say so.
WRONG = [
    pytest.param({"scene": "pendulums"}, "unknown-scene", "/scene", id="scene"),
    pytest.param({"scene": under("m*")}, "unexpected-end", "/scene/loads/0/force/0", id="force"),
    pytest.param({"sections": 1}, "unknown-field", "/sections", id="field"),
    pytest.param({"t_end": 1e300}, "request-too-large", "/t_end", id="without end"),
    pytest.param({"t_end": -1.0}, "request-not-above", "/t_end", id="backwards"),
    pytest.param({"samples": 1}, "request-too-small", "/samples", id="a single sample"),
    pytest.param({"tolerance": 1e-20}, "request-too-small", "/tolerance", id="tolerance"),
    pytest.param({"statistics": ["median"]}, "request-not-one-of", "/statistics/0", id="statistic"),
    pytest.param({"vary": {}}, "request-too-few", "/vary", id="nothing varies"),
    pytest.param(
        {"vary": {ANGLE: MANY | {"count": 10**9}}}, "request-too-large", f"/vary/{ANGLE}/count", id="too many"
    ),
    pytest.param(
        {"vary": {ANGLE: MANY, "parameters.l": MANY}, "t_end": 40.0}, "ensemble-too-large", "/vary", id="grid"
    ),
    pytest.param(
        {"vary": {ANGLE: [1.0, 2.0], "parameters.l": [1.0]}, "combine": "together"},
        "ensemble-unlike",
        "/vary",
        id="unlike numbers",
    ),
    pytest.param({"vary": {ANGLE: ["NaN"]}}, "request-not-number", f"/vary/{ANGLE}/0", id="NaN as a text"),
    pytest.param({"vary": {"parameters.q": [1.0]}}, "ensemble-quantity", "/vary/parameters.q", id="quantity"),
    pytest.param({"vary": {"parameters.l": [1.0, -1.0]}}, "not-positive", "/vary/parameters.l/1", id="negative"),
    pytest.param({"vary": {ANGLE: [1e17]}}, "initial-too-large", f"/vary/{ANGLE}/0", id="value"),
    pytest.param(
        {"vary": {ANGLE: {"from": 0.0, "to": 1e17, "count": 3}}}, "initial-too-large", f"/vary/{ANGLE}/to", id="range"
    ),
    pytest.param(
        {"vary": {ANGLE: MANY | {"normal": [1.0, -1.0]}}},
        "request-too-small",
        f"/vary/{ANGLE}/normal/1",
        id="deviation",
    ),
    pytest.param({"section": {"value": "phi +"}}, "unexpected-end", "/section/value", id="section that breaks off"),
    pytest.param({"section": {"value": "psi"}}, "unknown-name", "/section/value", id="section of something else"),
    pytest.param({"section": {"value": "l - 2"}}, "section-plane-constant", "/section/value", id="section nowhere"),
    pytest.param(
        {"section": {"value": "phi", "direction": "up"}}, "request-not-one-of", "/section/direction", id="direction"
    ),
    pytest.param(
        {"section": {"value": "phi", "points": 20_000}},
        "ensemble-section-too-large",
        "/section/points",
        id="section of very many points",
    ),
    pytest.param(BALL | {"section": {"value": "z"}}, "ensemble-section-events", "/section", id="section behind events"),
    pytest.param(
        {"scene": LINE, "vary": {"initial.x.value": [1.0]}, "section": {"value": "x"}},
        "ensemble-section-events",
        "/section",
        id="section of forces that jump",
    ),
    pytest.param(BALL | {"vary": {"initial.z.value": [0.5, -0.6]}}, "event-at-start", "/vary", id="behind an event"),
    pytest.param(ROD, "method-constraints", "/scene", id="constraints"),
]


@pytest.mark.parametrize("lang", ["en", "de"])
@pytest.mark.parametrize(("change", "code", "pointer"), WRONG)
async def test_a_stream_refuses_what_the_answer_refuses_and_alike(
    client: httpx.AsyncClient, change: dict[str, Any], code: str, pointer: str, lang: str
) -> None:
    plain, stream = [
        await client.post(ADDRESS, json=PENDULUMS | change | {"lang": lang}, headers=headers)
        for headers in ({}, STREAM)
    ]
    assert stream.status_code == plain.status_code == (404 if code == "unknown-scene" else 422), plain.text
    assert stream.headers["content-type"] == plain.headers["content-type"] == "application/problem+json"
    assert stream.json() == plain.json()
    assert (code, pointer) in [(one["code"], one["pointer"]) for one in plain.json()["problems"]]


@pytest.mark.parametrize("lang", ["en", "de"])
@pytest.mark.parametrize("body", [b"", b"{", b"[]", b'{"t_end": NaN}'])
async def test_a_stream_refuses_what_is_no_request_alike(client: httpx.AsyncClient, body: bytes, lang: str) -> None:
    headers = {"Content-Type": "application/json", "Accept-Language": lang}
    plain, stream = [await client.post(ADDRESS, content=body, headers=headers | more) for more in ({}, STREAM)]
    assert stream.status_code == plain.status_code >= 400
    assert stream.json() == plain.json()


def compiling_on(app: FastAPI, monkeypatch: pytest.MonkeyPatch) -> list[asyncio.Event]:
    """As if no kernels were compiled; what is set then tells that they are."""
    service: Service = app.state.service
    groups = {group: asyncio.Event() for group in kernel_groups()}
    for group, compiled in groups.items():
        monkeypatch.setitem(service.kernels._compiled, group, compiled)
    return list(groups.values())


async def test_nobody_waits_for_kernels_to_be_refused(
    app: FastAPI, client: httpx.AsyncClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    compiling_on(app, monkeypatch)
    for headers in ({}, STREAM):
        response = await client.post(ADDRESS, json=PENDULUMS | {"vary": {ANGLE: [1e17]}}, headers=headers)
        assert response.status_code == 422


async def test_a_stream_says_that_it_waits_for_kernels(
    app: FastAPI, client: httpx.AsyncClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As a service does on a new machine: a client hears at once, and every second, how many there are."""
    compiling = compiling_on(app, monkeypatch)
    monkeypatch.setattr(kernels, "PAUSE", 0.1)
    question = PENDULUMS | {"t_end": 3.25}
    for one in compiling:
        asyncio.get_running_loop().call_later(1.0, one.set)
    events = await streamed(client, question)
    told = [data for kind, data in events if kind == "preparing"]
    others = [kind for kind, _ in events[len(told) :]]
    assert len(told) > 2
    assert others == ["block"] * (len(others) - 1) + ["result"]
    assert all(one == {"kernels": one["of"], "of": len(list(declared()))} for one in told)  # those of the tests
    for one in compiling:
        one.clear()
    assert await streamed(client, question) == events[len(told) :]  # what is known waits for nothing


def test_a_client_of_a_new_machine_hears_that_kernels_are_compiled(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for variable in ("NUMBA_CACHE_DIR", "XDG_CACHE_HOME"):
        monkeypatch.setenv(variable, str(tmp_path / variable))
    address = ADDRESS.removeprefix("/")
    with served(workers=1, **PATIENT) as one, httpx.Client(base_url=one.address, timeout=PATIENCE) as client:
        refused = client.post(address, json=PENDULUMS | {"vary": {ANGLE: [1e17]}}, headers=STREAM)
        assert refused.status_code == 422
        with client.stream("POST", address, json=PENDULUMS, headers=STREAM) as response:
            lines = [line for line, _ in zip(response.iter_lines(), range(5), strict=False)]
    assert lines[::3] == ["event: preparing"] * 2
    first, second = (json.loads(line.removeprefix("data: ")) for line in lines[1::3])
    assert first["kernels"] <= second["kernels"] < first["of"] == second["of"] == len(list(declared()))


async def test_a_silent_stream_is_kept_alive(client: httpx.AsyncClient, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(streams, "LONGEST_SILENCE", 0.002)
    few = {"vary": {"initial.x.value": {"from": 0.5, "to": 2.0, "count": 40}}, "t_end": 20.0}
    async with client.stream("POST", ADDRESS, json=PENDULUMS | JUMPS | few, headers=STREAM) as response:
        text = b"".join([part async for part in response.aiter_raw()]).decode()
    events = text.split("\n\n")
    assert ":" in events  # lines that begin so are comments
    assert events[-1] == ""
    assert all(one == ":" or one.startswith("event: ") for one in events[:-1])
    assert [one.split("\n")[0] for one in events[:-1] if one != ":" and "waiting" not in one] == [
        *["event: block"] * 40,
        "event: result",
    ]


async def test_what_is_done_within_the_time_limit_stays_and_the_rest_is_named(
    client: httpx.AsyncClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Forces that jump are followed one by one: of so many there is no end within the time."""
    events = list[Event]()
    for deadline in (5.0, 20.0, 60.0):  # a worker that has only begun may need the first for itself
        monkeypatch.setattr(ensembles, "IN_BLOCKS", replace(ensembles.IN_BLOCKS, deadline=deadline))
        events = await streamed(client, PENDULUMS | JUMPS | {"t_end": 20.0, "lang": "de"})
        if len(events) > 1:
            break
    *blocks, (kind, problem) = events
    assert (kind, problem["status"], problem["type"]) == ("problem", 504, "/problems/computation-too-large")
    assert problem["title"] == "Die Rechnung ist zu groß"
    spans = [(data["first"], data["runs"]) for _, data in blocks]
    assert 0 < sum(runs for _, runs in spans) < 20_000
    missing = [(one["first"], one["runs"]) for one in problem["missing"]]
    told = [run for first, runs in [*spans, *missing] for run in range(first, first + runs)]
    assert sorted(told) == list(range(20_000))
    assert {status for _, data in blocks for status in data["status"]} == {"ok"}


async def test_our_own_mistake_is_told_after_what_is_good(
    client: httpx.AsyncClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(ensembles, "IN_BLOCKS", replace(ensembles.IN_BLOCKS, target="tests.api.slow:broken_ensemble"))
    blocks, problem = (await streamed(client, PENDULUMS))[:-1], (await streamed(client, PENDULUMS))[-1]
    assert {data["first"]: data["runs"] for _, data in blocks} == {0: 64, 128: 22}  # whichever is done first
    assert (problem[0], problem[1]["status"]) == ("problem", 500)
    assert problem[1]["missing"] == [{"first": 64, "runs": 64}]


async def test_no_block_comes_twice_when_its_worker_is_killed(app: FastAPI) -> None:
    """The job is begun again, and tells what it told before."""
    service: Service = app.state.service
    few = {"vary": {"initial.x.value": {"from": 0.5, "to": 2.0, "count": 100}}}
    asked = EnsembleRequest.model_validate(PENDULUMS | JUMPS | few)
    question, blocks = {"request": asked.model_dump() | {"lang": "en"}}, Blocks(asked.count)
    found, has_killed = list[tuple[str, Any]](), False

    async def work() -> bytes:
        return await service.blocks("of a killed worker", ensembles.IN_BLOCKS, question, blocks)

    async for event in blocks.events(work, lambda error: {"error": repr(error)}):
        kind, _, data = event.decode().removeprefix("event: ").partition("\ndata: ")
        found.append((kind, json.loads(data)))
        if kind == "block" and not has_killed:
            has_killed = True
            for pid in service.pool.pids:
                with contextlib.suppress(ProcessLookupError):  # one that has just been replaced
                    os.kill(pid, signal.SIGKILL)
    assert found[-1][0] == "result", found[-1]
    assert sorted(data["first"] for kind, data in found if kind == "block") == list(range(100))
