"""The processor time of jobs: what it is, and who pays for it."""

from __future__ import annotations

import asyncio
import os
import signal
import subprocess
import sys
from typing import Any

import pytest

from deltaq.api.workers.account import Account, Ledger
from deltaq.api.workers.job import DeadlineExceeded, Job, WorkerDied
from deltaq.api.workers.meter import Meter, processor_clock
from deltaq.api.workers.pool import Pool

from .conftest import MakePool

pytestmark = [
    pytest.mark.anyio,
    pytest.mark.skipif(sys.platform != "linux", reason="elsewhere the clock on the wall stands for that of a process"),
]
FOR_EVER = 1e9
BURNT = 0.1


class Purse:
    """A client that may use what it likes, and what it has used."""

    def __init__(self) -> None:
        self._ledger = Ledger(1e-12, FOR_EVER)
        self.account = Account("one", self._ledger)

    @property
    def paid(self) -> float:
        return self._ledger.debt("one")


async def run(pool: Pool, purse: Purse, name: str, document: Any, **bounds: Any) -> None:
    await pool.run(
        Job(f"tests.api.workers.jobs:{name}", **{"deadline": 30.0, **bounds}), document, account=purse.account
    )


async def burning(pool: Pool, purse: Purse, seconds: float) -> asyncio.Task[None]:
    """A job that has used more than BURNT seconds, however long a busy machine needs for that."""
    used = processor_clock(pool.pids[0])
    before = used()
    running = asyncio.create_task(run(pool, purse, "burn", {"seconds": seconds}))
    while used() - before < 2 * BURNT:
        await asyncio.sleep(0.005)
    return running


@pytest.mark.parametrize(
    ("document", "least", "most"),
    [
        pytest.param({"seconds": 0.3}, 0.3, 0.4, id="work"),
        pytest.param({"seconds": 0.0, "sleep": 0.6}, 0.0, 0.1, id="waiting is free"),
        pytest.param({"seconds": 0.2, "threads": 3}, 0.6, 0.8, id="threads count each"),
    ],
)
async def test_client_pays_for_the_time_of_processors(
    make_pool: MakePool, document: dict[str, float], least: float, most: float
) -> None:
    pool, purse = make_pool(), Purse()
    await run(pool, purse, "burn", document)
    assert least <= purse.paid < most
    assert pool.state.processor_seconds == pytest.approx(purse.paid, rel=1e-6)


async def test_jobs_of_one_worker_are_paid_for_one_by_one(make_pool: MakePool) -> None:
    pool, first, second = make_pool(), Purse(), Purse()
    await run(pool, first, "burn", {"seconds": 0.5})
    await run(pool, second, "echo", 1)
    assert first.paid > 0.5
    assert second.paid < 0.1


async def test_what_is_killed_is_paid_for(make_pool: MakePool) -> None:
    pool, purse = make_pool(), Purse()
    with pytest.raises(DeadlineExceeded):
        await run(pool, purse, "burn", {"seconds": 60.0}, deadline=FOR_EVER, processor=0.3)
    assert 0.3 <= purse.paid < 0.6


async def test_what_is_given_up_is_paid_for(make_pool: MakePool) -> None:
    pool, purse = make_pool(), Purse()
    running = await burning(pool, purse, 60.0)
    running.cancel()
    while pool.state.busy:
        await asyncio.sleep(0.02)
    assert purse.paid > BURNT


async def test_both_attempts_are_paid_for(make_pool: MakePool) -> None:
    pool, purse = make_pool(), Purse()
    running = await burning(pool, purse, 0.6)
    os.kill(pool.pids[0], signal.SIGKILL)
    await running
    assert purse.paid > 0.6 + BURNT


async def test_worker_that_dies_at_once_is_not_for_nothing(make_pool: MakePool) -> None:
    pool, purse = make_pool(), Purse()
    with pytest.raises(WorkerDied):
        await run(pool, purse, "hard_exit", None)
    assert purse.paid > 0.0


@pytest.mark.parametrize(
    ("name", "bounds", "told"),
    [
        pytest.param("spin", {"processor": 0.2}, "no answer within 0.2 s of a processor", id="processor"),
        pytest.param("sleep", {"deadline": 0.2}, "no answer within 0.2 s", id="clock"),
        pytest.param("sleep", {"deadline": 0.2, "processor": 0.1}, "no answer within 0.2 s", id="clock, no work"),
    ],
)
async def test_first_bound_that_is_reached_counts(
    make_pool: MakePool, name: str, bounds: dict[str, float], told: str
) -> None:
    with pytest.raises(DeadlineExceeded) as caught:
        await run(make_pool(), Purse(), name, 60, **bounds)
    assert str(caught.value) == told


def test_bound_of_a_processor_and_by_the_clock() -> None:
    job = Job("one", 1.0, threads=3).within(5.0)
    assert (job.deadline, job.processor_time) == (10.0, 15.0)
    assert Job("one", 2.0, threads=3).processor_time == 6.0  # more could not be used before the deadline


async def test_job_that_waits_does_not_use_up_its_processor_time(make_pool: MakePool) -> None:
    await run(make_pool(), Purse(), "burn", {"seconds": 0.05, "sleep": 0.6}, processor=0.2)


def test_time_of_a_process_that_is_gone_is_that_of_the_last_look_and_all_since() -> None:
    with subprocess.Popen([sys.executable, "-c", "while True: pass"]) as process:
        clock = processor_clock(process.pid)
        meter = Meter(clock)
        meter.start()
        while meter.seconds < 0.2:
            pass
        process.kill()
    with pytest.raises(OSError, match="Invalid argument"):
        clock()
    assert 0.2 <= meter.seconds < 30.0


def test_process_that_never_was_is_timed_by_the_wall() -> None:
    clock = processor_clock(2**22 + 1)
    assert clock() <= clock()
