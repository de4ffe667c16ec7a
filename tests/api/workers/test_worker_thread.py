"""What a thread answers without a worker, and how the end of a worker is told."""

from __future__ import annotations

import asyncio
import signal
from dataclasses import replace
from typing import NoReturn

import pytest

from deltaq.api.workers.account import Account, Ledger, QuotaExceeded
from deltaq.api.workers.job import DeadlineExceeded, Job, Overloaded, WorkerDied, WorkerKilled
from deltaq.api.workers.message import encode_request
from deltaq.api.workers.occupancy import Slots
from deltaq.api.workers.pool import Pool
from deltaq.api.workers.queue import FairQueue
from deltaq.api.workers.task import Task
from deltaq.api.workers.worker import Listener
from deltaq.api.workers.worker_thread import Limits, WorkerThread, begins

LIMITS = Limits(memory=2**31, jobs=100, start_timeout=30.0, queue_timeout=30.0)


def task(name: str, document: object = None, account: Account | None = None) -> Task:
    job = Job(f"tests.api.workers.jobs:{name}", 30.0, pure=False)
    request = encode_request(job.target, 30.0, document)
    return Task(job, request) if account is None else Task(job, request, account=account)


def test_task_that_was_cancelled_is_not_begun() -> None:
    thread, cancelled = WorkerThread(FairQueue(1, Slots(1, 1)), LIMITS), task("echo")
    cancelled.answer.cancel()
    thread.serve(cancelled)
    assert (thread.worker, thread.served) == (None, 0)


def test_client_that_used_up_its_share_while_waiting_gets_no_worker() -> None:
    thread, debtor = WorkerThread(FairQueue(1, Slots(1, 1)), LIMITS), Account("one", Ledger(0.5, 10.0))
    debtor.pay(100.0)
    found = thread.outcome(task("echo", account=debtor))
    assert isinstance(found, QuotaExceeded)
    assert thread.worker is None


def test_lane_that_stops_refuses() -> None:
    thread = WorkerThread(FairQueue(1, Slots(1, 1)), LIMITS)
    thread.stop()
    found = thread.attempt(task("echo"))
    assert isinstance(found, Overloaded)
    assert str(found) == "the service is stopping"


@pytest.mark.parametrize(
    ("failures", "told"),
    [
        pytest.param(0, [], id="it goes with the service"),
        pytest.param(2, ["a worker did not start: EOFError()"] * 2, id="twice before that"),
    ],
)
def test_start_that_fails_is_told_unless_the_service_stops(
    failures: int, told: list[str], monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    thread, left = WorkerThread(FairQueue(1, Slots(1, 1)), LIMITS), iter(range(failures))

    def fails(_memory: int, _timeout: float, _niceness: int) -> NoReturn:
        if next(left, None) is None:
            thread.stop()
        raise EOFError

    monkeypatch.setattr("deltaq.api.workers.worker_thread.start_worker", fails)
    assert thread.ready_worker() is None
    assert caplog.messages == told


@pytest.mark.parametrize(
    ("number", "kind", "text"),
    [
        pytest.param(signal.SIGXCPU, DeadlineExceeded, "processor time used up", id="bound on processor time"),
        pytest.param(signal.SIGKILL, WorkerKilled, "the worker process ended with exit code -9", id="killed"),
        pytest.param(signal.SIGSEGV, WorkerDied, "the worker process ended with exit code -11", id="crashed"),
    ],
)
def test_end_of_a_worker(number: signal.Signals, kind: type[Exception], text: str) -> None:
    thread = WorkerThread(FairQueue(1, Slots(1, 1)), LIMITS)
    found = thread.attempt(task("end_by_signal", int(number)))
    assert type(found) is kind
    assert str(found) == text
    assert thread.worker is None


@pytest.mark.anyio
async def test_pool_without_any_worker_refuses_in_the_end() -> None:
    pool = Pool(1, 1, Limits(memory=2**31, jobs=1, start_timeout=1.0, queue_timeout=0.05))
    with pytest.raises(Overloaded, match="waited too long"):
        await pool.run(Job("tests.api.workers.jobs:echo", 30.0), None)
    assert pool.state.waiting == 0


@pytest.mark.anyio
async def test_stop_passes_over_what_was_cancelled() -> None:
    pool = Pool(1, 2, LIMITS)
    waiting = [asyncio.create_task(pool._answer(task("echo"))) for _ in range(2)]
    await asyncio.sleep(0)
    waiting[0].cancel()
    with pytest.raises(asyncio.CancelledError):
        await waiting[0]
    await asyncio.sleep(0)
    pool._threads = ()  # none was started
    pool.stop(0.0)
    with pytest.raises(Overloaded, match="the service is stopping"):
        await waiting[1]


@pytest.mark.anyio
async def test_what_has_begun_and_waits_again_is_not_refused_any_more() -> None:
    pool, begun, new = Pool(1, 2, replace(LIMITS, queue_timeout=0.02)), task("echo"), task("echo")
    begun.answer.set_running_or_notify_cancel()
    for one in (begun, new):
        pool._tasks.put(one)
        async with asyncio.timeout(None) as limit:
            await pool._refuse_in_time(one, limit)
    assert (begun.answer.done(), new.answer.done(), pool.state.waiting) == (False, True, 1)


@pytest.mark.parametrize("gone", [False, True])
def test_what_was_put_back_is_begun_again_only_if_somebody_waits(*, gone: bool) -> None:
    waiting = replace(task("echo"), listener=Listener(lambda _part: None, lambda: gone))
    assert begins(waiting)
    assert begins(waiting) is not gone
