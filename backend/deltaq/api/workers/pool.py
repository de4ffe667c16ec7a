"""The pool: a bounded queue in front of a few lanes."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from queue import Full, Queue
from threading import Event
from typing import Any

from .job import Job, Overloaded
from .lane import Lane, Limits, Task
from .message import encode_request
from .worker import Listener, start_fork_server


@dataclass(frozen=True)
class PoolState:
    """How the pool is doing."""

    workers: int
    ready: int
    busy: int
    waiting: int
    kills: int


def _ignore(_part: bytes) -> None:
    """Nobody wants the parts."""


class Pool:
    """Runs jobs in `size` worker processes; at most `queue_length` tasks wait."""

    def __init__(self, size: int, queue_length: int, limits: Limits, modules: Sequence[str] = ()) -> None:
        self._tasks: Queue[Task | None] = Queue(queue_length)
        self._limits = limits
        self._modules = tuple(modules)
        self._lanes = tuple(Lane(self._tasks, limits) for _ in range(size))

    def start(self) -> None:
        """Start the lanes; returns at once, the workers come up in the background."""
        start_fork_server(self._modules)
        for lane in self._lanes:
            lane.start()

    def stop(self, timeout: float = 5.0) -> None:
        """End the lanes: waiting tasks are refused, running ones may finish within `timeout` seconds."""
        for lane in self._lanes:
            lane.stop()
        while not self._tasks.empty():
            task = self._tasks.get_nowait()
            if task is not None and task.answer.set_running_or_notify_cancel():
                task.answer.set_exception(Overloaded("the service is stopping"))
        for _ in self._lanes:  # wake those that wait for a task; with a full queue nobody does
            with suppress(Full):
                self._tasks.put_nowait(None)
        for lane in self._lanes:
            lane.join(timeout)
            lane.drop_worker()

    async def run(self, job: Job, document: Any, hear: Callable[[bytes], object] = _ignore) -> bytes:
        """The JSON of the job's answer; `hear` gets its parts before, in the event loop.

        InputError as the job raised it; Overloaded, DeadlineExceeded, MemoryExceeded, WorkerDied or JobFailed
        otherwise. Always ends: with a full queue at once, else after patience and deadlines. When it is cancelled,
        the worker is freed.
        """
        loop, gone = asyncio.get_running_loop(), Event()
        listener = Listener(lambda part: loop.call_soon_threadsafe(hear, part), gone.is_set)
        task = Task(job, encode_request(job.target, job.threads * job.deadline, document), listener)
        try:
            return await self._answer(task)
        finally:
            gone.set()

    async def _answer(self, task: Task) -> bytes:
        try:
            self._tasks.put_nowait(task)
        except Full:
            raise Overloaded("the queue is full") from None
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
            waiting=self._tasks.qsize(),
            kills=sum(lane.kills for lane in self._lanes),
        )

    @property
    def pids(self) -> tuple[int, ...]:
        """The process ids of the workers that are up."""
        return tuple(worker.pid for lane in self._lanes if (worker := lane.worker) is not None)
