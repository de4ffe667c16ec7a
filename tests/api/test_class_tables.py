"""The answers of a class over HTTP: row by row, bounded, given up; what is wrong with a table is told at its place."""

from __future__ import annotations

import asyncio
import base64
import json
from collections.abc import AsyncIterator, Awaitable, Callable
from typing import Any

import httpx
import pytest
from fastapi import FastAPI
from tests.homework.classes import class_archive

from deltaq.api.marking import BUSY_PAUSE, Marking
from deltaq.api.workers.account import QuotaExceeded
from deltaq.api.workers.job import DeadlineExceeded, JobFailed, MemoryExceeded, Overloaded
from deltaq.contract.base import SceneWithChanges
from deltaq.contract.check import RowQuestion
from deltaq.contract.verdict import RowVerdict, TableAnswer
from deltaq.errors import Problem, UnknownNameError
from deltaq.homework.gradebook import Plan, Row, Target, refusal

pytestmark = pytest.mark.anyio
TABLE = "/api/v1/checks/table"
STREAM = {"accept": "text/event-stream"}
T, DOUBLE_T = "m*l^2*dot(phi)^2/2", "m*l^2*dot(phi)^2"
HEAD = "student,scene,task,answer,line\n"
ROWS = f"ada,pendulum,kinetic-energy,{DOUBLE_T},1\nada,pendulum,kinetic-energy,{T},2\nbob,pendulum,none,1,1\n"


async def events_of(response: httpx.Response) -> AsyncIterator[tuple[str, Any]]:
    kind = ""
    async for line in response.aiter_lines():
        if line.startswith("event: "):
            kind = line.removeprefix("event: ")
        elif line.startswith("data: "):
            yield kind, json.loads(line.removeprefix("data: "))


async def test_rows_come_as_they_are_marked_and_totals_at_the_end(client: httpx.AsyncClient) -> None:
    question = {"table": [HEAD, ROWS], "lang": "en"}
    async with client.stream("POST", TABLE, json=question, headers=STREAM) as response:
        assert response.headers["content-type"].startswith("text/event-stream")
        assert response.headers["cache-control"] == "no-store"
        events = [event async for event in events_of(response) if event[0] != "totals"]
    assert [kind for kind, _ in events] == ["begun", "row", "row", "row", "result"]
    assert events[0][1] == {"rows": 3}
    rows = [(row["index"], row["row"], row["outcome"], row["points"], row["column"]) for _, row in events[1:4]]
    assert rows == [(0, 2, "wrong", 0.0, ""), (1, 3, "correct", 2.0, ""), (2, 4, "invalid", 0.0, "task")]
    result = events[-1][1]
    assert [(one["student"], one["points"], one["of"]) for one in result["students"]] == [
        ("ada", 2.0, 2.0),
        ("bob", 0.0, 0.0),
    ]
    answer = TableAnswer.model_validate((await client.post(TABLE, json=question)).json())
    assert [row.model_dump() for row in answer.rows] == [data for _, data in events[1:4]]
    assert answer.csv == result["csv"]
    file = await client.post(TABLE, json=question, headers={"accept": "text/csv"})
    assert file.headers["content-disposition"] == 'attachment; filename="results.csv"'
    assert file.text == result["csv"]


async def test_a_file_of_a_spreadsheet_comes_as_its_bytes_and_goes_back_alike(client: httpx.AsyncClient) -> None:
    data = f"student;scene;task;answer\r\nJürgen;pendulum;kinetic-energy;{T}\r\n".encode("cp1252")
    question = {"table": [base64.b64encode(data).decode()], "encoding": "base64", "lang": "de"}
    file = await client.post(TABLE, json=question, headers={"accept": "text/csv"})
    assert file.content.startswith(b"\xef\xbb\xbfstudent;scene;")
    assert "Jürgen;pendulum;kinetic-energy;correct;;2;2;" in file.text


async def test_files_that_cannot_be_taken_are_named_before_the_rows_come(client: httpx.AsyncClient) -> None:
    archive = class_archive(0)
    table = [base64.b64encode(archive.data).decode()]
    question = {"table": table, "encoding": "base64", "assignment": archive.assignment, "lang": "en"}
    async with client.stream("POST", TABLE, json=question, headers=STREAM) as response:
        events = [event async for event in events_of(response) if event[0] != "totals"]
    kinds = [kind for kind, _ in events]
    assert kinds[:2] == ["begun", "refused"]
    files, result = events[1][1]["files"], events[-1][1]
    assert files
    assert result["refused"] == files
    assert {row["file"] for kind, row in events if kind == "row"}.isdisjoint(one["file"] for one in files)
    assert result["canvas"].startswith("Student,ID,SIS User ID,SIS Login ID,Section,Blatt 3\n    Points Possible,")
    assert result["moodle"].startswith("Full name,ID number,Email address,Blatt (3),")


SHEET = {"format": 1, "tasks": [{"scene": "pendulum", "task": "kinetic-energy", "points": 3}]}
REFUSED = [
    pytest.param({"table": ["a,b\n"]}, 422, "/table", "answers-column", id="column"),
    pytest.param({"table": ['task,answer\n1,"2\n']}, 422, "/table", "answers-quote", id="quote"),
    pytest.param({"table": ["~"], "encoding": "base64"}, 422, "/table", "answers-encoding", id="base64"),
    pytest.param({"table": []}, 422, "/table", "request-too-few", id="nothing"),
    pytest.param({"table": ["x" * 10_001]}, 422, "/table/0", "request-text-too-long", id="piece"),
    pytest.param({"assignment": {"format": 1}}, 422, "/assignment/tasks", "assignment-no-task", id="assignment"),
    pytest.param({"scene": "pendulun"}, 404, "/scene", "unknown-scene", id="scene"),
    pytest.param({"rows": 1}, 422, "/rows", "unknown-field", id="field"),
]


@pytest.mark.parametrize(("change", "status", "pointer", "code"), REFUSED)
@pytest.mark.parametrize("accept", ["application/json", "text/event-stream"])
async def test_a_table_that_makes_no_sense_is_refused_at_its_place(
    client: httpx.AsyncClient, change: dict[str, Any], status: int, pointer: str, code: str, accept: str
) -> None:
    question = {"table": ["task,answer\n1,2\n"], **change}
    response = await client.post(TABLE, json=question, headers={"accept": accept})
    assert response.status_code == status, response.text
    assert (pointer, code) in [(one["pointer"], one["code"]) for one in response.json()["problems"]]


async def test_what_many_wrote_is_judged_once(client: httpx.AsyncClient, app: FastAPI) -> None:
    rows = [f"student {n},pendulum,lagrangian,m*l^2*dot(phi)^2/2 + 7*m*g*l*cos(phi),{n}\n" for n in range(30)]
    misses = app.state.service.cache.misses
    answer = (await client.post(TABLE, json={"table": [HEAD, *rows]})).json()
    assert {row["outcome"] for row in answer["rows"]} == {"wrong"}
    assert app.state.service.cache.misses == misses + 1


async def test_whoever_leaves_gives_up_the_rest(client: httpx.AsyncClient, app: FastAPI) -> None:
    """The row under way frees its worker, and no other is begun."""
    pool, cache = app.state.service.pool, app.state.service.cache
    rows = [f"ada,double-pendulum,lagrangian,{n}*m1*phi1,{n}\n" for n in range(2, 200)]
    running = asyncio.create_task(client.post(TABLE, json={"table": [HEAD, *rows]}, headers=STREAM))
    before = cache.misses
    while cache.misses < before + 2:
        await asyncio.sleep(0.01)
    running.cancel()
    while pool.state.busy:
        await asyncio.sleep(0.02)
    begun = cache.misses
    await asyncio.sleep(0.5)
    assert cache.misses == begun < before + 100


class Clock:
    """A time that is set, and passes while somebody sleeps."""

    def __init__(self) -> None:
        self.now = 0.0
        self.slept: list[float] = []

    def __call__(self) -> float:
        return self.now

    async def sleep(self, seconds: float) -> None:
        self.slept.append(seconds)
        self.now += seconds


PLAN = Plan(
    (Target(SceneWithChanges(scene="pendulum"), "pendulum", "kinetic-energy", "T", 2.0),),
    tuple(Row(n + 2, f"student {n}", "", "", f"answer {n}", person=f"student {n}", target=0) for n in range(4)),
)


async def marked(fails: dict[int, list[Exception]], longest: float = 100.0, seconds: float = 1.0) -> tuple[Any, Clock]:
    """Of each row its outcome or what is told of it, where the judge fails at some; and the clock."""
    clock = Clock()

    async def verdict_on(question: RowQuestion) -> RowVerdict:
        clock.now += seconds
        errors = fails.get(int(question.answer.value.split()[1]), [])
        if errors:
            raise errors.pop(0)
        return refusal("", "correct")

    marking = Marking(PLAN, verdict_on, "en", longest, clock, clock.sleep)
    kinds = [kind async for kind, _ in marking.events() if kind not in ("begun", "totals")]
    return ([(row["outcome"], row["feedback"]) for row in marking.rows()], kinds), clock


GOOD = ("correct", "")


@pytest.mark.parametrize("error", [DeadlineExceeded("no answer"), MemoryExceeded("")], ids=["time", "memory"])
async def test_a_row_that_is_too_large_spoils_no_other(error: Exception) -> None:
    (rows, _), _ = await marked({1: [error]})
    assert [outcome for outcome, _ in rows] == ["correct", "undecided", "correct", "correct"]
    assert "To check this takes longer than one answer of many may take" in rows[1][1]


async def test_a_row_that_makes_no_sense_in_its_values_is_told_in_it() -> None:
    error = UnknownNameError(Problem("unknown-task", "/task", parameters={"name": "x", "known": "y"}))
    (rows, _), _ = await marked({2: [error]})
    assert [outcome for outcome, _ in rows] == ["correct", "correct", "invalid", "correct"]


@pytest.mark.parametrize(
    ("errors", "slept"),
    [
        pytest.param([Overloaded("full"), Overloaded("full")], [BUSY_PAUSE, BUSY_PAUSE], id="busy"),
        pytest.param([QuotaExceeded("x", 7.0)], [7.0], id="the client's share is used up"),
    ],
)
async def test_a_busy_service_is_waited_for(errors: list[Exception], slept: list[float]) -> None:
    (rows, kinds), clock = await marked({1: errors})
    assert rows == [GOOD] * 4
    assert clock.slept == slept
    assert kinds == ["row", *["waiting"] * len(slept), "row", "row", "row"]


async def test_what_comes_after_the_time_is_over_is_left_undecided() -> None:
    (rows, _), clock = await marked({}, longest=2.0)
    assert [outcome for outcome, _ in rows] == ["correct", "correct", "undecided", "undecided"]
    assert clock.now == 2.0
    (rows, _), clock = await marked({1: [QuotaExceeded("x", 50.0)]}, longest=20.0)
    assert [outcome for outcome, _ in rows] == ["correct", "undecided", "correct", "correct"]
    assert clock.slept == []  # it would not have got further


async def test_our_own_mistake_is_told_in_the_stream_after_the_rows_before(
    client: httpx.AsyncClient, app: FastAPI, monkeypatch: pytest.MonkeyPatch
) -> None:
    service = app.state.service
    answer: Callable[..., Awaitable[bytes]] = service.answer

    async def failing(key: str, job: Any, document: Any) -> bytes:
        if document["answer"]["value"] == T:
            raise JobFailed("bug")
        return await answer(key, job, document)

    monkeypatch.setattr(type(service), "answer", lambda _, *given: failing(*given))
    async with client.stream("POST", TABLE, json={"table": [HEAD, ROWS], "lang": "en"}, headers=STREAM) as response:
        events = [event async for event in events_of(response) if event[0] != "totals"]
    assert [kind for kind, _ in events] == ["begun", "row", "problem"]
    assert events[-1][1]["status"] == 500
