"""A bounded queue in front of a few worker threads, of which slow jobs never get all."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Callable, Coroutine, Sequence
from contextlib import asynccontextmanager, suppress
from dataclasses import dataclass, field
from threading import Event
from typing import Any

from .account import FREE, Account, QuotaExceeded
from .job import Job, Overloaded
from .message import encode_request
from .occupancy import Slots
from .queue import BEGUN, FairQueue, Place
from .task import Task
from .worker import LOOK_UP, PRELOAD, Listener, start_fork_server
from .worker_thread import Limits, WorkerThread

FIRST, AGAIN = 0.2, 1.0  # seconds after which one who waits is told so, and told again
Take = Callable[[bytes], Coroutine[Any, Any, None]]
TICK = 0.01  # seconds by which the event loop may call too early


@dataclass(frozen=True)
class PoolState:
    """How the pool is doing."""

    workers: int
    ready: int
    busy: int
    waiting: int
    kills: int
    processor_seconds: float = field(default=0.0, compare=False)


@dataclass(frozen=True, eq=False)
class Asker:
    """One client who waits for what runs under a key, since when (seconds of the event loop), and his time limit."""

    account: Account
    since: float
    limit: asyncio.Timeout

    def refuse(self) -> None:
        """End his waiting, and nobody else's."""
        if self.limit.when() is None:
            self.limit.reschedule(0.0)


def _ignore(_said: object) -> None:
    """Nobody wants to hear it."""


def _wait(taking: Coroutine[Any, Any, None], loop: asyncio.AbstractEventLoop, gone: Event) -> None:
    """Waits in a thread until a part is taken, or nobody is there any more who would."""
    taken = asyncio.run_coroutine_threadsafe(taking, loop)
    while not gone.is_set():
        with suppress(TimeoutError):
            return taken.result(LOOK_UP)
    taken.cancel()


class Pool:
    """Runs `size` slow jobs at a time, each in a process, and `reserve` fast ones more; `queue_length` may wait."""

    def __init__(
        self, size: int, queue_length: int, limits: Limits, modules: Sequence[str] = (PRELOAD,), reserve: int = 0
    ) -> None:
        self._tasks = FairQueue(queue_length, Slots(size + reserve, size))
        self._limits = limits
        self._modules = tuple(modules)
        self._askers: dict[str, list[Asker]] = {}
        self._threads = tuple(WorkerThread(self._tasks, limits) for _ in range(size + reserve))

    def start(self) -> None:
        """Start the threads; returns at once, the worker processes come up in the background."""
        start_fork_server(self._modules)
        for thread in self._threads:
            thread.start()

    def stop(self, timeout: float = 5.0) -> None:
        """End the threads: waiting tasks are refused, running ones may finish within `timeout` seconds."""
        for thread in self._threads:
            thread.stop()
        for task in self._tasks.close():
            if task.answer.set_running_or_notify_cancel():
                task.answer.set_exception(Overloaded("the service is stopping"))
        for thread in self._threads:
            thread.join(timeout)
            thread.drop_worker()

    async def run(
        self,
        job: Job,
        document: Any,
        on_part: Callable[[bytes], object] = _ignore,
        account: Account = FREE,
        wait: Callable[[Place], object] | None = None,
        key: str = "",
        take: Take | None = None,
    ) -> bytes:
        """The JSON of a job's answer. `on_part` receives its parts before, in the event loop; `account` pays.

        Where none may be lost and many may come, `take` takes each instead, and the worker waits until it has.
        While the task waits, `wait` receives its place in the queue: the best one of all who ask for `key`. Raises
        InputError as the job raised it; else Overloaded, QuotaExceeded, DeadlineExceeded, MemoryExceeded, WorkerDied or
        JobFailed. It always ends: at once if the queue is full, after `queue_timeout` seconds if the task has not
        begun, else at its deadline. When it is cancelled, the worker is freed.
        """
        account.admit()
        loop, gone = asyncio.get_running_loop(), Event()

        def give(part: bytes) -> None:
            if take is None:
                loop.call_soon_threadsafe(on_part, part)
            else:
                _wait(take(part), loop, gone)

        listener = Listener(give, gone.is_set)
        task = Task(job, encode_request(job.target, job.processor_time, document), listener, account, key=key)
        try:
            return await self._answer(task, wait)
        finally:
            gone.set()
            self._tasks.discard(task)

    @asynccontextmanager
    async def asked(self, key: str, account: Account) -> AsyncIterator[None]:
        """While somebody asks for what runs under a key, its task also has a place of his in the queue.

        So nobody waits behind all that another client has asked for who asked for the same before. Everyone has the
        whole `queue_timeout` from when he asked, whoever asked first. Raises Overloaded when that is over and the task
        has not begun.
        """
        try:
            async with asyncio.timeout(None) as limit:
                asker = Asker(account, asyncio.get_running_loop().time(), limit)
                askers = self._askers.setdefault(key, [])
                askers.append(asker)
                self._share(key, account)
                try:
                    yield
                finally:
                    askers.remove(asker)
                    if not askers:
                        del self._askers[key]
                    if all(one.account.client != account.client for one in askers):
                        self._tasks.leave(key, account.client)
        except TimeoutError:
            if not limit.expired():
                raise
            raise Overloaded("waited too long") from None

    def _share(self, key: str, account: Account) -> None:
        """Who may not have a place of his own waits at the other's."""
        with suppress(Overloaded, QuotaExceeded):
            account.admit()
            self._tasks.share(key, account)

    async def _answer(self, task: Task, wait: Callable[[Place], object] | None = None) -> bytes:
        self._tasks.put(task)
        for asker in self._askers.get(task.key, ()):
            self._share(task.key, asker.account)
        try:
            async with asyncio.timeout(None) as limit:
                refusing = asyncio.create_task(self._refuse_in_time(task, limit))
                if wait is not None:
                    asyncio.get_running_loop().call_later(FIRST, self._tell_place, task, wait)
                try:
                    return await asyncio.wrap_future(task.answer)
                finally:
                    refusing.cancel()
        except TimeoutError:
            raise Overloaded("no worker came up") from None

    async def _refuse_in_time(self, task: Task, limit: asyncio.Timeout) -> None:
        """Refuse those whose time is over, and the task with the last of them; the others go on waiting.

        What has begun is not refused any more, also where it has to wait again; `limit` is when it must have ended.
        """
        loop, timeout = asyncio.get_running_loop(), self._limits.queue_timeout
        begin, later = loop.time(), [loop.time() + timeout]
        while later and not task.answer.running():
            limit.reschedule(max(later) + 2 * task.job.deadline + 5.0)  # it may be run twice, and workers take time
            await asyncio.sleep(min(later) - loop.time())
            ends = {asker: max(asker.since, begin) + timeout for asker in self._askers.get(task.key, ())}
            later = [end for end in ends.values() if end > loop.time() + TICK]
            for asker, end in ends.items() if later and not task.answer.running() else ():
                if end not in later:
                    asker.refuse()
        if not task.answer.running() and self._tasks.discard(task):
            task.answer.set_exception(Overloaded("waited too long"))

    def _tell_place(self, task: Task, wait: Callable[[Place], object]) -> None:
        """Now and again, as long as it waits; then that it has begun. Of what begins at once nothing is told."""
        if (place := self._tasks.place_of(task)) is not None:
            wait(place)
            asyncio.get_running_loop().call_later(AGAIN, self._tell_begin, task, wait)

    def _tell_begin(self, task: Task, wait: Callable[[Place], object]) -> None:
        """That what has waited has begun, if it has; else where it stands."""
        if self._tasks.is_running(task):
            wait(BEGUN)
        self._tell_place(task, wait)

    @property
    def state(self) -> PoolState:
        """How the pool is doing now."""
        return PoolState(
            workers=len(self._threads),
            ready=sum(thread.worker is not None for thread in self._threads),
            busy=sum(thread.busy for thread in self._threads),
            waiting=len(self._tasks),
            kills=sum(thread.kills for thread in self._threads),
            processor_seconds=sum(thread.processor_seconds for thread in self._threads),
        )

    @property
    def pids(self) -> tuple[int, ...]:
        """The process ids of the workers that are up."""
        return tuple(worker.pid for thread in self._threads if (worker := thread.worker) is not None)
