"""The pool: a bounded queue in front of a few lanes, some of which are for fast jobs alone."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from threading import Event
from typing import Any

from .account import FREE, Account
from .job import Job, Overloaded, Pace
from .lane import ANY_PACE, Lane, Limits
from .message import encode_request
from .queue import FairQueue
from .task import Task
from .worker import PRELOAD, Listener, start_fork_server

FAST_ALONE: tuple[Pace, ...] = ("fast",)


@dataclass(frozen=True)
class PoolState:
    """How the pool is doing."""

    workers: int
    ready: int
    busy: int
    waiting: int
    kills: int
    processor_seconds: float = field(default=0.0, compare=False)


def _ignore(_part: bytes) -> None:
    """Nobody wants the parts."""


class Pool:
    """Runs jobs in `size` worker processes, and fast ones in `reserve` more; at most `queue_length` tasks wait."""

    def __init__(
        self, size: int, queue_length: int, limits: Limits, modules: Sequence[str] = (PRELOAD,), reserve: int = 0
    ) -> None:
        self._tasks = FairQueue(queue_length)
        self._limits = limits
        self._modules = tuple(modules)
        paces = [ANY_PACE] * size + [FAST_ALONE] * reserve
        self._lanes = tuple(Lane(self._tasks, limits, own) for own in paces)

    def start(self) -> None:
        """Start the lanes; returns at once, the workers come up in the background."""
        start_fork_server(self._modules)
        for lane in self._lanes:
            lane.start()

    def stop(self, timeout: float = 5.0) -> None:
        """End the lanes: waiting tasks are refused, running ones may finish within `timeout` seconds."""
        for lane in self._lanes:
            lane.stop()
        for task in self._tasks.close():
            if task.answer.set_running_or_notify_cancel():
                task.answer.set_exception(Overloaded("the service is stopping"))
        for lane in self._lanes:
            lane.join(timeout)
            lane.drop_worker()

    async def run(
        self, job: Job, document: Any, hear: Callable[[bytes], object] = _ignore, account: Account = FREE
    ) -> bytes:
        """The JSON of the job's answer; `hear` gets its parts before, in the event loop; `account` pays.

        InputError as the job raised it; Overloaded, QuotaExceeded, DeadlineExceeded, MemoryExceeded, WorkerDied or
        JobFailed otherwise. Always ends: with a full queue at once, else after patience and deadlines. When it is
        cancelled, the worker is freed.
        """
        account.admit()
        loop, gone = asyncio.get_running_loop(), Event()
        listener = Listener(lambda part: loop.call_soon_threadsafe(hear, part), gone.is_set)
        task = Task(job, encode_request(job.target, job.processor_time, document), listener, account)
        try:
            return await self._answer(task)
        finally:
            gone.set()
            self._tasks.discard(task)

    async def _answer(self, task: Task) -> bytes:
        self._tasks.put(task)
        longest = self._limits.patience + 2 * task.job.deadline + 5.0
        try:
            return await asyncio.wait_for(asyncio.wrap_future(task.answer), longest)
        except TimeoutError:
            raise Overloaded("no worker came up") from None

    @property
    def state(self) -> PoolState:
        return PoolState(
            workers=len(self._lanes),
            ready=sum(lane.worker is not None for lane in self._lanes),
            busy=sum(lane.busy for lane in self._lanes),
            waiting=len(self._tasks),
            kills=sum(lane.kills for lane in self._lanes),
            processor_seconds=sum(lane.processor_seconds for lane in self._lanes),
        )

    @property
    def pids(self) -> tuple[int, ...]:
        """The process ids of the workers that are up."""
        return tuple(worker.pid for lane in self._lanes if (worker := lane.worker) is not None)
