"""One thread that keeps one worker process alive and feeds it tasks."""

from __future__ import annotations

import logging
import time
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from threading import Event, Thread

from ...errors import DeltaqError, InputError
from .account import QuotaExceeded
from .job import DeadlineExceeded, GivenUp, JobError, JobFailed, MemoryExceeded, NotFast, Overloaded, WorkerKilled
from .message import decode_reply
from .queue import FairQueue
from .task import Task
from .worker import Worker, start_worker

LOGGER = logging.getLogger("deltaq.workers")
FIRST_PAUSE, LONGEST_PAUSE = 0.05, 5.0
AT_ONCE = 0.1  # seconds, in which no job can use up its own bounds: the least is 0.2 s of a processor


@dataclass(frozen=True)
class Limits:
    """What every worker of a pool is held to: bytes of memory, jobs before it is replaced, and niceness.

    `start_timeout` is how many seconds it may take to start, `queue_timeout` how many a task may wait for it.
    """

    memory: int
    jobs: int
    start_timeout: float
    queue_timeout: float
    niceness: int = 0


class WorkerThread(Thread):
    """One thread that keeps one worker process alive and gives it tasks, until the queue is closed."""

    def __init__(self, tasks: FairQueue, limits: Limits) -> None:
        super().__init__(name="deltaq-worker-thread", daemon=True)
        self.tasks = tasks
        self.limits = limits
        self.worker: Worker | None = None
        self.served = 0
        self.kills = 0
        self.processor_seconds = 0.0
        self.busy = False
        self.stopping = Event()

    def run(self) -> None:
        """Serve tasks until the queue is closed or the thread is stopped."""
        self.ready_worker()
        while not self.stopping.is_set() and (task := self.tasks.take()) is not None:
            self.serve(task)
        self.drop_worker()

    def stop(self) -> None:
        """Ends the thread after the present task."""
        self.stopping.set()

    def ready_worker(self) -> Worker | None:
        """The thread's worker, started if need be; tried again until it comes up; None when the thread is stopped."""
        pause = FIRST_PAUSE
        while self.worker is None and not self.stopping.is_set():
            try:
                self.worker = start_worker(self.limits.memory, self.limits.start_timeout, self.limits.niceness)
                self.served = 0
            except Exception as error:  # noqa: BLE001  killed while it started, no memory … : another one may come up
                if self.stopping.wait(pause):
                    break  # it goes with the service
                LOGGER.warning("a worker did not start: %r", error)
                pause = min(2 * pause, LONGEST_PAUSE)
        return self.worker

    def drop_worker(self) -> None:
        """Kill the worker, if there is one."""
        worker, self.worker = self.worker, None
        if worker is not None:
            worker.kill()

    def serve(self, task: Task) -> None:
        """Runs a task and gives its future the answer or an error; no exception ends the thread."""
        if not begins(task):
            self.tasks.done(task)
            return
        self.busy = True
        try:
            outcome = self.outcome(task)
        except Exception as error:
            LOGGER.exception("the worker thread failed")
            self.drop_worker()  # it may be in the middle of a reply
            outcome = JobFailed(f"{type(error).__name__}: {error}")
        self.busy = False
        self.tasks.done(task, answered=isinstance(outcome, bytes))
        self.tell(task, outcome)
        if self.served >= self.limits.jobs:
            self.drop_worker()
        self.ready_worker()

    def tell(self, task: Task, outcome: bytes | DeltaqError) -> None:
        """Gives the future the outcome; a task that turned out slow is put back instead."""
        try:
            if isinstance(outcome, NotFast):
                self.tasks.put_back(task)
                return
        except Overloaded as error:
            outcome = error
        with suppress(Exception):  # the future may have been given up meanwhile
            task.answer.set_result(outcome) if isinstance(outcome, bytes) else task.answer.set_exception(outcome)

    def outcome(self, task: Task) -> bytes | DeltaqError:
        """Runs a task; once more if it is pure and it was not its own doing that it had no answer.

        So it is when the worker was killed from outside, or was at its bounds when the task came: jobs before it had
        left it too little.
        """
        try:
            task.account.admit()  # others of its tasks may have used up the share meanwhile
            others, begin, used = self.served if self.worker else 0, time.monotonic(), self.processor_seconds
            first = self.attempt(task)
            passed, used = time.monotonic() - begin, self.processor_seconds - used
            if others > 0 and is_at_once(first, passed, used):
                LOGGER.warning("a worker of %d jobs was at its bounds: %r", others, first)
            elif not isinstance(first, WorkerKilled):
                return first
            return self.attempt(task) if task.job.pure else first
        except QuotaExceeded as error:
            return error

    def may_go_on(self, task: Task) -> bool:
        """Whether a task that has used more than a moment keeps its worker; one with an effect always does."""
        return self.tasks.go_on_as_slow(task) or not task.job.pure

    def pay(self, task: Task, seconds: float) -> None:
        """Charge processor time to the client, and count it."""
        task.account.pay(seconds)
        self.processor_seconds += seconds

    def attempt(self, task: Task) -> bytes | DeltaqError:
        """Runs a task once, at the client's expense. After any error but wrong input the worker is replaced."""
        worker = self.ready_worker()
        if worker is None:
            return Overloaded("the service is stopping")
        try:
            outcome = decode_reply(worker.ask(task.request, task.job, task.listener, partial(self.may_go_on, task)))
        except JobError as error:
            outcome = error
        self.served += 1
        self.pay(task, worker.meter.seconds)
        if isinstance(outcome, JobError) and not isinstance(outcome, InputError):
            self.kills += not isinstance(outcome, (GivenUp, NotFast))
            self.drop_worker()
        return outcome


def is_at_once(outcome: bytes | DeltaqError, passed: float, used: float) -> bool:
    """Whether a bound was met sooner than any job by itself can meet it.

    For memory that is told by the processor time it used: on a busy machine even the first moment of a job may be long.
    A deadline is met by waiting, too, so there the seconds that passed count.
    """
    if isinstance(outcome, MemoryExceeded):
        return used < AT_ONCE
    return isinstance(outcome, DeadlineExceeded) and passed < AT_ONCE


def begins(task: Task) -> bool:
    """Whether anybody still waits for a task; if so, its future counts as running."""
    if task.answer.running():  # it has been put back
        return not task.listener.has_gone()
    return task.answer.set_running_or_notify_cancel()
