"""Starting workers: what does not come up is killed and tried again."""

from __future__ import annotations

import multiprocessing
import threading

import pytest
from tests.api.slow import never_ready

from deltaq.api.workers import worker as worker_module
from deltaq.api.workers import worker_thread as thread_module
from deltaq.api.workers.job import Job
from deltaq.api.workers.occupancy import Slots
from deltaq.api.workers.queue import FairQueue
from deltaq.api.workers.worker import Worker, start_worker
from deltaq.api.workers.worker_thread import Limits, WorkerThread

LIMITS = Limits(memory=2**31, jobs=100, start_timeout=30.0, queue_timeout=30.0)


def test_worker_that_is_not_ready_in_time_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(worker_module, "run", never_ready)
    before = set(multiprocessing.active_children())  # the services of other tests have workers, too
    with pytest.raises(TimeoutError, match=r"the worker was not ready after 0\.2 s"):
        start_worker(2**31, 0.2)
    assert set(multiprocessing.active_children()) - before == set()


@pytest.mark.parametrize(
    "error",
    [
        pytest.param(EOFError("killed while it started"), id="killed"),
        pytest.param(OSError(12, "no memory"), id="no memory"),
        pytest.param(TimeoutError("late"), id="late"),
    ],
)
def test_lane_tries_again_until_a_worker_comes_up(monkeypatch: pytest.MonkeyPatch, error: Exception) -> None:
    attempts: list[int] = []

    def start_third_time(memory: int, timeout: float, niceness: int) -> Worker:
        attempts.append(1)
        if len(attempts) < 3:
            raise error
        return start_worker(memory, timeout)

    monkeypatch.setattr(thread_module, "start_worker", start_third_time)
    thread = WorkerThread(FairQueue(10, Slots(1, 1)), LIMITS)
    worker = thread.ready_worker()
    assert worker is not None
    assert worker.ask(b'["tests.api.workers.jobs:echo", 10, 5]', Job("", 10.0)) == b"+5"
    assert len(attempts) == 3
    thread.drop_worker()


def test_stopped_lane_gives_up_starting(monkeypatch: pytest.MonkeyPatch) -> None:
    def never(memory: int, timeout: float, niceness: int) -> Worker:
        raise OSError("no more processes")

    monkeypatch.setattr(thread_module, "start_worker", never)
    thread = WorkerThread(FairQueue(10, Slots(1, 1)), LIMITS)
    threading.Timer(0.2, thread.stop).start()
    assert thread.ready_worker() is None
