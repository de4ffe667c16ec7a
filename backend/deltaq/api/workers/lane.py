"""One thread that keeps one worker process alive and feeds it tasks."""

from __future__ import annotations

import logging
import time
from concurrent.futures import Future
from contextlib import suppress
from dataclasses import dataclass, field
from queue import Queue
from threading import Event, Thread

from ...errors import DeltaqError, InputError
from .job import GivenUp, Job, JobError, JobFailed, Overloaded, WorkerDied
from .message import decode_reply
from .worker import NOBODY, Listener, Worker, start_worker

LOGGER = logging.getLogger("deltaq.workers")
FIRST_PAUSE, LONGEST_PAUSE = 0.05, 5.0


@dataclass(frozen=True)
class Task:
    """A job, its request as bytes, the future that waits for the answer's JSON, and who hears its parts."""

    job: Job
    request: bytes
    listener: Listener = NOBODY
    answer: Future[bytes] = field(default_factory=Future)
    asked_at: float = field(default_factory=time.monotonic)


@dataclass(frozen=True)
class Limits:
    """What every worker of a pool is held to: bytes of memory, jobs before it is replaced, seconds."""

    memory: int
    jobs: int
    start_timeout: float
    patience: float


class Lane(Thread):
    """Takes tasks from the queue one by one; None in the queue ends the lane."""

    def __init__(self, tasks: Queue[Task | None], limits: Limits) -> None:
        super().__init__(name="deltaq-lane", daemon=True)
        self.tasks = tasks
        self.limits = limits
        self.worker: Worker | None = None
        self.served = 0
        self.kills = 0
        self.busy = False
        self.stopping = Event()

    def run(self) -> None:
        self.ready_worker()
        while not self.stopping.is_set() and (task := self.tasks.get()) is not None:
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
                LOGGER.warning("a worker did not start: %s", error)
                self.stopping.wait(pause)
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
        first = self.attempt(task)
        if isinstance(first, WorkerDied) and first.repeatable and task.job.pure:
            return self.attempt(task)
        return first

    def attempt(self, task: Task) -> bytes | DeltaqError:
        """One try. A worker that failed otherwise than by wrong input is not trusted with another task."""
        worker = self.ready_worker()
        if worker is None:
            return Overloaded("the service is stopping")
        try:
            outcome = decode_reply(worker.ask(task.request, task.job.deadline, task.listener))
        except JobError as error:
            outcome = error
        self.served += 1
        if isinstance(outcome, JobError) and not isinstance(outcome, InputError):
            self.kills += not isinstance(outcome, GivenUp)
            self.drop_worker()
        return outcome
