"""One thread that keeps one worker process alive and feeds it tasks."""

from __future__ import annotations

import logging
import time
from collections.abc import Collection
from contextlib import suppress
from dataclasses import dataclass
from threading import Event, Thread
from typing import get_args

from ...errors import DeltaqError, InputError
from .account import QuotaExceeded
from .job import GivenUp, JobError, JobFailed, Overloaded, Pace, WorkerKilled
from .message import decode_reply
from .queue import FairQueue
from .task import Task
from .worker import Worker, start_worker

LOGGER = logging.getLogger("deltaq.workers")
ANY_PACE: tuple[Pace, ...] = get_args(Pace)
FIRST_PAUSE, LONGEST_PAUSE = 0.05, 5.0


@dataclass(frozen=True)
class Limits:
    """What every worker of a pool is held to: bytes of memory, jobs before it is replaced, seconds."""

    memory: int
    jobs: int
    start_timeout: float
    patience: float


class Lane(Thread):
    """Takes tasks of its paces from the queue one by one, until the queue is closed."""

    def __init__(self, tasks: FairQueue, limits: Limits, paces: Collection[Pace] = ANY_PACE) -> None:
        super().__init__(name="deltaq-lane", daemon=True)
        self.tasks = tasks
        self.limits = limits
        self.paces = paces
        self.worker: Worker | None = None
        self.served = 0
        self.kills = 0
        self.processor_seconds = 0.0
        self.busy = False
        self.stopping = Event()

    def run(self) -> None:
        self.ready_worker()
        while not self.stopping.is_set() and (task := self.tasks.take(self.paces)) is not None:
            self.serve(task)
        self.drop_worker()

    def stop(self) -> None:
        """End after the task at hand."""
        self.stopping.set()

    def ready_worker(self) -> Worker | None:
        """The lane's worker, started if need be; tried again until it comes up, or None when the lane is stopped."""
        pause = FIRST_PAUSE
        while self.worker is None and not self.stopping.is_set():
            try:
                self.worker = start_worker(self.limits.memory, self.limits.start_timeout)
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
        """Give the task's future an answer or an error; nothing that happens here may end the lane."""
        if not task.answer.set_running_or_notify_cancel():
            return
        self.busy = True
        try:
            outcome = self.outcome(task)
        except Exception as error:
            LOGGER.exception("the lane failed")
            self.drop_worker()  # it may be in the middle of a reply
            outcome = JobFailed(f"{type(error).__name__}: {error}")
        self.busy = False
        with suppress(Exception):  # the future may have been given up meanwhile
            task.answer.set_result(outcome) if isinstance(outcome, bytes) else task.answer.set_exception(outcome)
        if self.served >= self.limits.jobs:
            self.drop_worker()
        self.ready_worker()

    def outcome(self, task: Task) -> bytes | DeltaqError:
        """Run it; once more if it is pure and the worker was killed from outside."""
        if time.monotonic() - task.asked_at > self.limits.patience:
            return Overloaded("waited too long")
        try:
            task.account.admit()  # others of its tasks may have used up the share meanwhile
            first = self.attempt(task)
            return self.attempt(task) if isinstance(first, WorkerKilled) and task.job.pure else first
        except QuotaExceeded as error:
            return error

    def pay(self, task: Task, seconds: float) -> None:
        """Charge processor time to the client, and count it."""
        task.account.pay(seconds)
        self.processor_seconds += seconds

    def attempt(self, task: Task) -> bytes | DeltaqError:
        """One try, for which the client pays. A worker that failed otherwise than by wrong input gets no other task."""
        worker = self.ready_worker()
        if worker is None:
            return Overloaded("the service is stopping")
        try:
            outcome = decode_reply(worker.ask(task.request, task.job, task.listener))
        except JobError as error:
            outcome = error
        self.served += 1
        self.pay(task, worker.meter.seconds)
        if isinstance(outcome, JobError) and not isinstance(outcome, InputError):
            self.kills += not isinstance(outcome, GivenUp)
            self.drop_worker()
        return outcome
