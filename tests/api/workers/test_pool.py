"""The supervisor holds whatever a job does."""

from __future__ import annotations

import asyncio
import json
import os
import signal
import subprocess
import sys
import time
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from deltaq.api.flights import Flights
from deltaq.api.workers import worker
from deltaq.api.workers.account import Account
from deltaq.api.workers.job import DeadlineExceeded, Job, JobFailed, MemoryExceeded, Overloaded, WorkerDied
from deltaq.api.workers.pool import Pool, PoolState
from deltaq.errors import Problem, SceneError, UnknownNameError

from .conftest import MakePool

pytestmark = pytest.mark.anyio

NOT_JSON = "PydanticSerializationError: Unable to serialize unknown type: <class 'object'>"


def job(name: str, deadline: float = 30.0, *, pure: bool = True) -> Job:
    return Job(f"tests.api.workers.jobs:{name}", deadline, pure)


async def run(pool: Pool, name: str, document: Any = None, deadline: float = 30.0) -> Any:
    return json.loads(await pool.run(job(name, deadline), document))


async def held(pool: Pool, door: Path) -> asyncio.Task[Any]:
    """A job that a worker is at, and that ends when something is at the door."""
    holding = asyncio.create_task(run(pool, "wait_at", str(door)))
    while not pool.state.busy:
        await asyncio.sleep(0.005)
    return holding


def is_alive(pid: int) -> bool:
    try:
        status = Path(f"/proc/{pid}/stat").read_text(encoding="utf-8")
    except FileNotFoundError:
        return False
    return status.rpartition(")")[2].split()[0] != "Z"


def gone_within(pid: int, seconds: float) -> bool:
    end = time.monotonic() + seconds
    while is_alive(pid) and time.monotonic() < end:
        time.sleep(0.01)
    return not is_alive(pid)


@pytest.mark.parametrize(
    "document",
    [
        pytest.param(None, id="null"),
        pytest.param({"a": [1, 2.5, "δq", None, True]}, id="mixed"),
        pytest.param("x" * 3_000_000, id="larger than any pipe"),
    ],
)
async def test_answer_is_the_documents_json(make_pool: MakePool, document: Any) -> None:
    assert await run(make_pool(), "echo", document) == document


async def test_answers_do_not_get_mixed_up(make_pool: MakePool) -> None:
    pool = make_pool(3)
    assert await asyncio.gather(*(run(pool, "echo", number) for number in range(60))) == list(range(60))


@pytest.mark.parametrize(
    ("name", "kind", "text"),
    [
        pytest.param("divide_by_zero", JobFailed, "ZeroDivisionError: division by zero", id="exception"),
        pytest.param("unpicklable", JobFailed, "Unpicklable", id="exception that has no pickle and no text"),
        pytest.param("leave", JobFailed, "SystemExit: 3", id="SystemExit"),
        pytest.param("hard_exit", WorkerDied, "the worker process ended with exit code 7", id="os._exit"),
        pytest.param(
            "not_a_number", JobFailed, "ValueError: Out of range float values are not JSON compliant", id="NaN"
        ),
        pytest.param("not_json", JobFailed, NOT_JSON, id="not JSON"),
        pytest.param("eat_memory", MemoryExceeded, "MemoryError: ", id="memory"),
        pytest.param("recurse", MemoryExceeded, "RecursionError: maximum recursion depth exceeded", id="recursion"),
        pytest.param(
            "nothing",
            JobFailed,
            "AttributeError: module 'tests.api.workers.jobs' has no attribute 'nothing'",
            id="no such job",
        ),
    ],
)
async def test_failure_is_data_and_the_next_job_is_served(
    make_pool: MakePool, name: str, kind: type[Exception], text: str
) -> None:
    pool = make_pool()
    with pytest.raises(kind) as caught:
        await run(pool, name)
    assert str(caught.value).partition(" in comparison")[0] == text
    assert await run(pool, "echo", 1) == 1
    assert pool.state == PoolState(workers=1, ready=1, busy=0, waiting=0, kills=1)


async def test_trace_of_a_failure_names_the_line(make_pool: MakePool) -> None:
    with pytest.raises(JobFailed) as caught:
        await run(make_pool(), "divide_by_zero")
    assert "return 1 / 0" in caught.value.trace


@pytest.mark.parametrize(
    ("name", "kind", "problems"),
    [
        pytest.param(
            "wrong_scene",
            SceneError,
            (
                Problem("unknown_name", "/bodies/0/mass", 2, 3, {"name": "mas", "suggestion": "m"}),
                Problem("missing", "/title"),
            ),
            id="scene",
        ),
        pytest.param(
            "unknown_name",
            UnknownNameError,
            (Problem("unknown_scene", "/scene", parameters={"name": "x"}),),
            id="unknown name",
        ),
    ],
)
async def test_input_error_comes_back_as_it_was_raised(
    make_pool: MakePool, name: str, kind: type[Exception], problems: tuple[Problem, ...]
) -> None:
    pool = make_pool()
    with pytest.raises(kind) as caught:
        await run(pool, name)
    assert caught.type is kind
    assert caught.value.args == problems
    assert pool.state.kills == 0  # the user's mistake costs no worker


@pytest.mark.parametrize("name", ["sleep", "spin", "ignore_signals"])
async def test_deadline_kills_what_cannot_be_interrupted(make_pool: MakePool, name: str) -> None:
    pool = make_pool()
    old = (await run(pool, "pid"))["pid"]
    begin = time.monotonic()
    with pytest.raises(DeadlineExceeded, match=r"no answer within 0\.5 s"):
        await run(pool, name, 60, deadline=0.5)
    assert 0.5 <= time.monotonic() - begin < 30.0  # of 60
    assert not is_alive(old)
    assert (await run(pool, "pid"))["pid"] != old


async def test_processor_time_is_bounded_even_without_a_supervisor(make_pool: MakePool) -> None:
    pool = make_pool()
    pid = (await run(pool, "pid"))["pid"]
    limits = Path(f"/proc/{pid}/limits").read_text(encoding="utf-8")
    soft = next(line for line in limits.splitlines() if line.startswith("Max cpu time")).split()[3]
    assert 31 <= int(soft) <= 34  # the deadline of 30 s, and what the process had used


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere the system chooses")
async def test_worker_is_what_goes_when_memory_is_used_up(make_pool: MakePool) -> None:
    pid = (await run(make_pool(), "pid"))["pid"]
    assert Path(f"/proc/{pid}/oom_score_adj").read_text(encoding="ascii").strip() == "1000"


def workers_of(fork_server: int) -> list[int]:
    """The processes that the fork server has made, also those that are not ready yet."""
    return [int(child) for child in Path(f"/proc/{fork_server}/task/{fork_server}/children").read_text().split()]


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
async def test_killed_while_starting_costs_nothing(make_pool: MakePool) -> None:
    pool = make_pool()
    fork_server = (await run(pool, "family"))["parent"]
    killed: set[int] = set()
    asking = asyncio.create_task(run(pool, "echo", "at last"))
    os.kill(pool.pids[0], signal.SIGKILL)
    while len(killed) < 4:
        for pid in workers_of(fork_server):
            with suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
                killed.add(pid)
        await asyncio.sleep(0.001)
    with suppress(WorkerDied):  # it may have been taken twice by a worker that had just come up
        assert await asking == "at last"
    assert await run(pool, "echo", 1) == 1


async def test_killed_while_idle_costs_nothing(make_pool: MakePool) -> None:
    pool = make_pool()
    old = (await run(pool, "pid"))["pid"]
    os.kill(old, signal.SIGKILL)
    assert (await run(pool, "pid"))["pid"] != old


async def test_killed_while_busy_is_repeated(make_pool: MakePool, tmp_path: Path) -> None:
    pool, door = make_pool(), tmp_path / "door"
    old = (await run(pool, "pid"))["pid"]
    running = await held(pool, door)
    os.kill(old, signal.SIGKILL)
    while old in pool.pids:
        await asyncio.sleep(0.005)
    door.touch()
    assert await running == "open"


@pytest.mark.parametrize(
    ("times", "pure", "runs"),
    [
        pytest.param(1, False, 1, id="not pure: never repeated"),
        pytest.param(2, True, 2, id="pure: repeated once only"),
    ],
)
async def test_killed_too_often(make_pool: MakePool, tmp_path: Path, times: int, pure: bool, runs: int) -> None:
    pool, marker = make_pool(), tmp_path / "marker"
    with pytest.raises(WorkerDied, match="the worker process ended with exit code -9"):
        await pool.run(job("kill_self_once", pure=pure), {"marker": str(marker), "times": times})
    assert marker.read_text(encoding="utf-8") == "x" * runs
    assert await run(pool, "echo", 1) == 1


async def test_pure_job_survives_one_kill(make_pool: MakePool, tmp_path: Path) -> None:
    answer = await run(make_pool(), "kill_self_once", {"marker": str(tmp_path / "marker"), "times": 1})
    assert answer == {"runs": 2}


async def test_killed_while_replying_is_repeated(make_pool: MakePool, tmp_path: Path) -> None:
    pool = make_pool()
    assert await run(pool, "kill_self_while_replying", {"marker": str(tmp_path / "marker")}) == "whole"
    assert pool.state.kills == 1


@pytest.mark.parametrize(
    ("what", "late"),
    [
        pytest.param("memory", 0.0, id="memory"),
        pytest.param("memory", 0.3, id="memory, on a machine so busy that the next one waits for a processor"),
        pytest.param("processor time", 0.0, id="processor time"),
    ],
)
async def test_what_one_job_leaves_behind_is_not_the_next_ones_fault(
    make_pool: MakePool, what: str, late: float, caplog: pytest.LogCaptureFixture
) -> None:
    pool = make_pool()
    await run(pool, "leave_nothing", what)
    time.sleep(0.5)
    assert await run(pool, "large", {"size": 10_000_000, "late": late}) == "x" * 10_000_000
    assert pool.state.kills == 1
    assert "a worker of 1 jobs was at its bounds" in caplog.text


async def test_too_large_in_a_new_worker_is_too_large(make_pool: MakePool) -> None:
    pool = make_pool()
    with pytest.raises(MemoryExceeded):
        await run(pool, "recurse")
    assert pool.state.kills == 1


async def test_no_answer_is_lost_or_wrong_while_workers_are_killed(make_pool: MakePool) -> None:
    pool = make_pool(3)
    stop = asyncio.Event()

    async def kill() -> None:
        while not stop.is_set():
            for pid in pool.pids[:1]:
                with suppress(ProcessLookupError):
                    os.kill(pid, signal.SIGKILL)
            await asyncio.sleep(0.05)

    killer = asyncio.create_task(kill())
    outcomes = await asyncio.gather(*(run(pool, "echo", n) for n in range(100)), return_exceptions=True)
    stop.set()
    await killer
    lost = [outcome for outcome in outcomes if isinstance(outcome, BaseException)]
    assert [n for n in outcomes if isinstance(n, int)] == [n for n in range(100) if isinstance(outcomes[n], int)]
    assert all(isinstance(outcome, WorkerDied) for outcome in lost)
    assert await run(pool, "echo", "still there") == "still there"


async def test_full_queue_refuses_at_once(make_pool: MakePool, tmp_path: Path) -> None:
    pool, door = make_pool(1, queue_length=2), tmp_path / "door"
    running = await held(pool, door)
    waiting = [asyncio.create_task(run(pool, "echo", number)) for number in range(2)]
    await asyncio.sleep(0)
    refused = run(pool, "echo")
    with pytest.raises(Overloaded, match="the queue is full"):
        refused.send(None)  # it waits for nothing
    door.touch()
    assert await asyncio.gather(running, *waiting) == ["open", 0, 1]


async def test_job_that_waited_too_long_is_refused_while_the_lane_is_still_taken(
    make_pool: MakePool, tmp_path: Path
) -> None:
    pool, door = make_pool(1, queue_timeout=0.3), tmp_path / "door"
    running = await held(pool, door)
    begin = time.monotonic()
    with pytest.raises(Overloaded, match="waited too long"):
        await run(pool, "echo")
    assert time.monotonic() - begin >= 0.3
    assert (pool.state.busy, pool.state.waiting) == (1, 0)
    door.touch()
    assert await running == "open"


async def test_what_has_begun_is_not_refused(make_pool: MakePool, tmp_path: Path) -> None:
    pool, door = make_pool(1, queue_timeout=0.2), tmp_path / "door"
    running = await held(pool, door)
    await asyncio.sleep(0.3)
    door.touch()
    assert await running == "open"


async def test_what_is_not_as_fast_as_was_thought_waits_for_a_slow_jobs_slot(
    make_pool: MakePool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(worker, "MOMENT", 0.1)
    pool, door, mark = make_pool(1, reserve=1), tmp_path / "door", tmp_path / "mark"
    slow = replace(job("wait_at"), pace="slow")
    running = asyncio.create_task(pool.run(slow, str(door)))
    while not pool.state.busy:
        await asyncio.sleep(0.005)
    burning = asyncio.create_task(pool.run(job("burn"), {"seconds": 0.3, "mark": str(mark)}))
    while not burning.done() and not (pool.state.waiting and mark.exists()):  # it has begun, and was put back
        await asyncio.sleep(0.01)
    assert await run(pool, "echo", "fast") == "fast"
    door.touch()
    assert (await running, json.loads(await burning)["seconds"]) == (b'"open"', 0.3)
    assert pool.state == PoolState(workers=2, ready=2, busy=0, waiting=0, kills=0)
    assert len(mark.read_text()) == 2


async def test_what_is_not_as_fast_as_was_thought_goes_on_where_there_is_room(
    make_pool: MakePool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(worker, "MOMENT", 0.1)
    mark = tmp_path / "mark"
    await make_pool(1, reserve=1).run(job("burn"), {"seconds": 0.3, "mark": str(mark)})
    assert len(mark.read_text()) == 1


async def test_one_who_waits_hears_the_place_and_the_beginning(make_pool: MakePool, tmp_path: Path) -> None:
    pool, doors = make_pool(), [tmp_path / "first", tmp_path / "second"]
    first = await held(pool, doors[0])
    told: list[list[int]] = [[], []]
    waiting = [
        asyncio.create_task(pool.run(job("wait_at"), str(doors[1]), wait=lambda place, to=to: to.append(place.number)))
        for to in told
    ]
    while not all(told):
        await asyncio.sleep(0.01)
    doors[0].touch()
    while told[0][-1]:
        await asyncio.sleep(0.01)
    doors[1].touch()
    await asyncio.gather(first, *waiting)
    assert (told[0][0], told[0][-1], set(told[1])) == (1, 0, {2, 1})


async def test_one_who_need_not_wait_hears_nothing(make_pool: MakePool) -> None:
    told: list[Any] = []
    await make_pool().run(job("sleep"), 0.4, wait=told.append)
    assert told == []


async def test_jobs_step_back_behind_the_service(make_pool: MakePool) -> None:
    pid = (await run(make_pool(niceness=7), "pid"))["pid"]
    assert os.getpriority(os.PRIO_PROCESS, pid) == min(19, os.getpriority(os.PRIO_PROCESS, 0) + 7)


async def test_job_that_nobody_waits_for_any_more_is_not_run(make_pool: MakePool, tmp_path: Path) -> None:
    pool, door, marker = make_pool(), tmp_path / "door", tmp_path / "marker"
    running = await held(pool, door)
    given_up = asyncio.create_task(run(pool, "kill_self_once", {"marker": str(marker), "times": 0}))
    while not pool.state.waiting:
        await asyncio.sleep(0.005)
    given_up.cancel()
    with pytest.raises(asyncio.CancelledError):
        await given_up
    door.touch()
    assert await running == "open"
    assert await run(pool, "echo", 1) == 1
    assert not marker.exists()


async def test_parts_are_heard_in_order_before_the_answer(make_pool: MakePool) -> None:
    heard: list[bytes] = []
    answer = await make_pool().run(job("count"), {"parts": 300}, heard.append)
    assert [json.loads(part)["number"] for part in (*heard, answer)] == list(range(300))


async def test_worker_waits_until_its_parts_are_taken_and_none_is_lost(make_pool: MakePool) -> None:
    pool, taken, may_take = make_pool(), list[bytes](), asyncio.Event()

    async def take(part: bytes) -> None:
        taken.append(part)
        await may_take.wait()

    running = asyncio.create_task(pool.run(job("count"), {"parts": 300}, take=take))
    while not taken:
        await asyncio.sleep(0.005)
    await asyncio.sleep(0.3)
    assert (len(taken), running.done()) == (1, False)
    may_take.set()
    answer = await running
    assert [json.loads(part)["number"] for part in (*taken, answer)] == list(range(300))


async def test_who_takes_no_parts_any_more_and_leaves_frees_the_worker(make_pool: MakePool) -> None:
    pool, taken = make_pool(), list[bytes]()

    async def take(part: bytes) -> None:
        taken.append(part)
        await asyncio.Event().wait()

    running = asyncio.create_task(pool.run(job("count"), {"parts": 300}, take=take))
    while not taken:
        await asyncio.sleep(0.005)
    running.cancel()
    with suppress(asyncio.CancelledError):
        await running
    assert await run(pool, "echo", 1) == 1
    assert len(taken) == 1


async def test_failure_after_some_parts_is_a_failure(make_pool: MakePool) -> None:
    heard: list[bytes] = []
    pool = make_pool()
    with pytest.raises(JobFailed, match="ValueError: no further"):
        await pool.run(job("count"), {"parts": 5, "fails_at": 3}, heard.append)
    assert [json.loads(part)["number"] for part in heard] == [0, 1, 2]
    assert await run(pool, "echo", 1) == 1


async def test_job_given_up_frees_its_worker(make_pool: MakePool) -> None:
    pool, heard = make_pool(), []
    running = asyncio.create_task(pool.run(job("count"), {"parts": 1000, "pause": 0.1}, heard.append))
    while len(heard) < 2:
        await asyncio.sleep(0.01)
    running.cancel()
    before = time.monotonic()
    with suppress(asyncio.CancelledError):
        await running
    assert await run(pool, "echo", 1) == 1
    assert time.monotonic() - before < 30.0  # of 100
    assert pool.state.kills == 0


async def test_worker_is_replaced_after_its_share_of_jobs(make_pool: MakePool) -> None:
    pool = make_pool(1, jobs=2)
    pids = [(await run(pool, "pid"))["pid"] for _ in range(4)]
    assert pids[0] == pids[1] != pids[2] == pids[3]
    assert pool.state.kills == 0


async def test_stop_refuses_what_waits_and_leaves_no_process(make_pool: MakePool) -> None:
    pool = make_pool(2)
    pids = {(await run(pool, "pid"))["pid"] for _ in range(20)} | set(pool.pids)
    running = [asyncio.create_task(run(pool, "sleep", 60)) for _ in range(2)]
    while pool.state.busy < 2:
        await asyncio.sleep(0.005)
    waiting = asyncio.create_task(run(pool, "echo"))
    while not pool.state.waiting:
        await asyncio.sleep(0.005)
    await asyncio.to_thread(pool.stop, 0.1)
    with pytest.raises(Overloaded, match="the service is stopping"):
        await waiting
    for task in running:
        with pytest.raises((WorkerDied, Overloaded, JobFailed)):
            await task
    assert [pid for pid in pids if not gone_within(pid, 2.0)] == []


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere workers outlive the fork server")
async def test_kill_of_the_fork_server_itself_is_survived(make_pool: MakePool) -> None:
    pool = make_pool(2)
    old = (await run(pool, "family"))["parent"]
    os.kill(old, signal.SIGKILL)
    assert gone_within(old, 2.0)
    assert [await run(pool, "echo", number) for number in range(5)] == list(range(5))
    assert (await run(pool, "family"))["parent"] != old


ORPHAN = """
import asyncio, json
from deltaq.api.workers.account import Account
from deltaq.api.workers.job import Job
from deltaq.api.workers.worker_thread import Limits
from deltaq.api.workers.pool import Pool

async def main():
    pool = Pool(1, 4, Limits(memory=2**31, jobs=10, start_timeout=30.0, queue_timeout=30.0))
    pool.start()
    print(json.loads(await pool.run(Job("tests.api.workers.jobs:pid", 30.0), None))["pid"], flush=True)
    await pool.run(Job("tests.api.workers.jobs:spin", 60.0), None)

asyncio.run(main())
"""


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere only the bound on processor time ends an orphan")
async def test_no_orphan_survives_the_kill_of_its_server(root: Path) -> None:
    environment = os.environ | {"PYTHONPATH": f"{root}:{root / 'backend'}"}
    with subprocess.Popen(
        [sys.executable, "-c", ORPHAN], stdout=subprocess.PIPE, cwd=root, env=environment, text=True
    ) as server:
        assert server.stdout is not None
        worker = int(server.stdout.readline())
        time.sleep(0.2)
        assert is_alive(worker)
        server.kill()
        assert gone_within(worker, 3.0)


async def test_who_asks_for_what_a_greedy_client_waits_for_waits_at_a_place_of_his_own(
    make_pool: MakePool, tmp_path: Path
) -> None:
    """Shared or not, nobody stands behind all that another has asked for."""
    pool, ended = make_pool(1), list[str]()
    holding = await held(pool, tmp_path / "door")

    async def ask(key: str, client: str) -> None:
        account = Account(client)
        async with pool.asked(key, account):
            await pool.run(job("echo"), key, account=account, key=key)
        ended.append(key)

    asking = [asyncio.create_task(ask(f"a{n}", "greedy")) for n in range(8)]
    await asyncio.sleep(0.02)
    async with pool.asked("a7", Account("modest")), pool.asked("a6", Account("")):  # one begins to wait before
        (tmp_path / "door").touch()
        await asyncio.gather(holding, *asking)
    assert sorted(ended) == [f"a{n}" for n in range(8)]
    assert {"a7", "a6"} <= set(ended[:4])
    assert len(ended) == 8


@pytest.mark.parametrize("clients", [("one", "other"), ("one", "one"), ("", "")], ids=["two", "one", "nameless"])
async def test_everyone_who_shares_a_computation_waits_for_his_own_time(
    make_pool: MakePool, tmp_path: Path, clients: tuple[str, str]
) -> None:
    """Whoever joins late is not refused with the first, and does not make the first wait for longer."""
    pool, flights, door = make_pool(1, queue_timeout=0.6), Flights(), tmp_path / "door"
    holding, loop = await held(pool, door), asyncio.get_running_loop()

    async def ask(client: str) -> tuple[str, float, float]:
        begin, account = loop.time(), Account(client)
        try:
            async with pool.asked("key", account):
                answer = await flights.join("key", lambda _: pool.run(job("echo"), 1, account=account, key="key"))
        except Overloaded as error:
            return str(error), begin, loop.time()
        return answer.decode(), begin, loop.time()

    first = asyncio.create_task(ask(clients[0]))
    await asyncio.sleep(0.4)
    late = asyncio.create_task(ask(clients[1]))
    told, begin, first_end = await first
    assert told == "waited too long"
    assert first_end - begin > 0.58
    last = asyncio.create_task(ask(clients[0]))
    told, begin, late_end = await late
    assert told == "waited too long"
    assert late_end - begin > 0.58
    assert late_end - first_end > 0.2  # 0.4, less what a busy machine delays
    door.touch()
    assert await holding == "open"
    assert (await last)[0] == "1"


async def test_a_late_one_is_not_refused_once_the_task_has_begun(make_pool: MakePool, tmp_path: Path) -> None:
    pool, flights, doors = make_pool(1, queue_timeout=1.5), Flights(), [tmp_path / "first", tmp_path / "second"]
    holding = await held(pool, doors[0])

    async def ask() -> bytes:
        async with pool.asked("key", Account("one")):
            return await flights.join("key", lambda _: pool.run(job("wait_at"), str(doors[1]), key="key"))

    first = asyncio.create_task(ask())
    await asyncio.sleep(0.2)
    late = asyncio.create_task(ask())
    doors[0].touch()
    await holding
    await asyncio.sleep(1.7)  # longer than anybody waits in the queue
    doors[1].touch()
    assert await asyncio.gather(first, late) == [b'"open"', b'"open"']
