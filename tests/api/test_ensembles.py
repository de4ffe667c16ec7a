"""Ensembles over HTTP: streamed in blocks they are what they are in one answer; what came before a failure stays."""

from __future__ import annotations

import json
import os
import signal
from base64 import b64decode
from collections.abc import AsyncIterator
from dataclasses import replace
from typing import Any

import httpx
import numpy as np
import pytest
from fastapi import FastAPI
from pydantic import BaseModel

from deltaq.api import blocks as streaming
from deltaq.api.blocks import Blocks
from deltaq.api.routes import ensembles
from deltaq.api.service import Service
from deltaq.contract.ensemble import EnsembleAnswer, EnsembleBlock, EnsembleRequest, EnsembleTotals

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


REFUSED = [
    pytest.param({"vary": {"parameters.q": [1.0]}}, 422, "ensemble-quantity", "/vary/parameters.q", id="unknown"),
    pytest.param({"vary": {"parameters.l": [1.0, -1.0]}}, 422, "not-positive", "/vary/parameters.l/1", id="negative"),
    pytest.param(
        {"vary": {ANGLE: [1.0]}, "section": {"value": "phi +"}}, 422, "unexpected-end", "/section/value", id="section"
    ),
    pytest.param({"vary": {ANGLE: [1e17]}}, 422, "initial-too-large", f"/vary/{ANGLE}/0", id="too large"),
]


@pytest.mark.parametrize(("change", "status", "code", "pointer"), REFUSED)
async def test_a_stream_that_is_refused_says_why(
    client: httpx.AsyncClient, change: dict[str, Any], status: int, code: str, pointer: str
) -> None:
    ((kind, problem),) = await streamed(client, PENDULUMS | change)
    assert (kind, problem["status"]) == ("problem", status)
    assert [(one["code"], one["pointer"]) for one in problem["problems"]] == [(code, pointer)]
    count = len(next(iter(change["vary"].values())))
    assert problem["missing"] == [{"first": 0, "runs": count}]


MISREAD = [
    pytest.param({"vary": {ANGLE: {"from": 0.0, "to": 1.0, "count": 10**9}}}, "request-too-large", id="too many"),
    pytest.param({"vary": {ANGLE: ["NaN"]}}, "request-not-number", id="NaN as a text"),
    pytest.param({"t_end": 1e300}, "request-too-large", id="without end"),
    pytest.param({"sections": 1}, "unknown-field", id="field"),
]


@pytest.mark.parametrize(("change", "code"), MISREAD)
async def test_what_cannot_be_read_is_refused_before_a_stream_begins(
    client: httpx.AsyncClient, change: dict[str, Any], code: str
) -> None:
    response = await client.post(ADDRESS, json=PENDULUMS | change, headers=STREAM)
    assert response.status_code == 422
    assert code in [one["code"] for one in response.json()["problems"]]


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
    assert [data["runs"] for _, data in blocks] == [64, 22]
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
                os.kill(pid, signal.SIGKILL)
    assert found[-1][0] == "result", found[-1]
    assert sorted(data["first"] for kind, data in found if kind == "block") == list(range(100))
