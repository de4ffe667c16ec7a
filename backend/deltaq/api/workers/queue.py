"""Who is computed for next: clients take turns, nobody has every lane, and what is slow leaves a lane to what is fast.

A process cannot be taken from a job without losing what it has done, so what must stay free is never given away: of
the lanes one is never a client's who has all the others, one is never a slow job's, and of those that slow jobs may
have one is never a client's who has all the others of them. Where there is one such lane, it is anybody's. The nameless
client, who asks from the machine itself, may have them all.
"""

from __future__ import annotations

import time
from collections import OrderedDict, deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from threading import Condition
from weakref import WeakSet

from .job import Overloaded, Pace
from .task import Task

FIRST_GUESS = 10.0  # seconds that a job takes of whose like none has ended yet
OVERTIME = 0.25  # of the seconds that a job has taken, where it has taken longer than usual
RECENT = 0.3  # weight of the last duration in the mean


@dataclass(frozen=True)
class Lanes:
    """How many jobs may run at once, and how many slow ones among them."""

    all: int
    slow: int

    @property
    def of_client(self) -> int:
        """The jobs of one client that may run at once."""
        return max(1, self.all - 1)

    @property
    def slow_of_client(self) -> int:
        """The slow jobs of one client that may run at once."""
        return max(1, self.slow - 1)


@dataclass(frozen=True)
class Place:
    """Where a task stands in the queue, 1 for the next, and in how many seconds it should begin."""

    number: int
    seconds: float


BEGUN = Place(0, 0.0)


@dataclass(frozen=True)
class Run:
    """A task that a lane is at."""

    task: Task
    pace: Pace
    since: float


class Durations:
    """How many seconds jobs of a kind usually take; the recent ones count most."""

    def __init__(self) -> None:
        self._means: dict[str, float] = {}

    def note(self, kind: str, seconds: float) -> None:
        """One has ended."""
        mean = self._means.get(kind, seconds)
        self._means[kind] = mean + RECENT * (seconds - mean)

    def usual(self, kind: str) -> float:
        """The mean of its kind; of a new kind that of all kinds."""
        of_all = sum(self._means.values()) / len(self._means) if self._means else FIRST_GUESS
        return self._means.get(kind, of_all)


class FairQueue:
    """At most `length` tasks wait; no client but the nameless one may hold more than half of the places."""

    def __init__(self, length: int, lanes: Lanes, clock: Callable[[], float] = time.monotonic) -> None:
        self._length = length
        self._lanes = lanes
        self._clock = clock
        self._count = 0
        self._open = True
        self._by_client: OrderedDict[str, deque[Task]] = OrderedDict()  # whose turn it is stands first
        self._running: dict[Task, Run] = {}
        self._outgrown: WeakSet[Task] = WeakSet()
        self._idle: list[object] = []
        self._durations = Durations()
        self._changed = Condition()

    def __len__(self) -> int:
        return self._count

    def put(self, task: Task) -> None:
        """Let a task wait; Overloaded if there is no place."""
        client = task.account.client
        with self._changed:
            own = self._by_client.get(client, ())
            if not self._open or self._count >= self._length or (client and 2 * len(own) >= self._length):
                raise Overloaded("the queue is full")
            self._by_client.setdefault(client, deque()).append(task)
            self._count += 1
            self._changed.notify_all()

    def take(self) -> Task | None:
        """The next task that may run, waited for; None when the queue is closed. Who takes it says when it is `done`.

        Whoever has begun to wait last takes first: what its worker remembers is the freshest.
        """
        lane, task = object(), None
        with self._changed:
            self._idle.append(lane)
            while self._open and (self._idle[-1] is not lane or (task := self.take_now()) is None):
                self._changed.wait()
            self._idle.remove(lane)
            self._changed.notify_all()
        return task

    def take_now(self) -> Task | None:
        """The next task that may run; None if there is none."""
        with self._changed:
            task = self._next()
            if task is not None:
                self._running[task] = Run(task, self._pace_of(task), self._clock())
            return task

    def done(self, task: Task, *, answered: bool = False) -> None:
        """A task that was taken needs its lane no more; `answered` if it came to its end."""
        with self._changed:
            run = self._running.pop(task, None)
            if run is not None and answered:
                self._durations.note(task.job.kind, self._clock() - run.since)
            self._changed.notify_all()

    def outgrow(self, task: Task) -> bool:
        """Whether a task that has run for more than a moment may go on, as a slow one from now on."""
        with self._changed:
            run = self._running.get(task)
            if run is None or run.pace == "slow":
                return True
            if not self._has_slow_lane(task.account.client):
                return False
            self._running[task] = Run(task, "slow", run.since)
            return True

    def put_back(self, task: Task) -> None:
        """Let a task that was taken wait again, as a slow one and before its client's others; Overloaded if closed."""
        client = task.account.client
        with self._changed:
            if not self._open:
                raise Overloaded("the service is stopping")
            self._outgrown.add(task)
            self._by_client.setdefault(client, deque()).appendleft(task)
            self._count += 1
            self._changed.notify_all()

    def discard(self, task: Task) -> bool:
        """Free the place of a task that nobody waits for any more; False if it has none."""
        client = task.account.client
        with self._changed:
            places = (n for n, one in enumerate(self._by_client.get(client, ())) if one is task)
            if (place := next(places, None)) is None:
                return False
            self._remove(client, place)
            self._changed.notify_all()
            return True

    def place_of(self, task: Task) -> Place | None:
        """Where a task stands, if it waits."""
        with self._changed:
            ahead = [self._left(run) for run in self._running.values()]
            for number, one in enumerate(self._in_turn(), 1):
                if one is task:
                    return Place(number, sum(ahead) / self._lanes.all)
                ahead.append(self._durations.usual(one.job.kind))
            return None

    def is_running(self, task: Task) -> bool:
        """Whether a lane is at it."""
        return task in self._running

    def close(self) -> list[Task]:
        """End all waiting; the tasks that are left."""
        with self._changed:
            self._open = False
            left = [task for tasks in self._by_client.values() for task in tasks]
            self._by_client.clear()
            self._count = 0
            self._changed.notify_all()
            return left

    def _next(self) -> Task | None:
        """The first task that may run, of the first client in turn who has one; it waits no more."""
        for client, tasks in self._by_client.items():
            place = next((n for n, task in enumerate(tasks) if self._has_lane(task)), None)
            if place is not None:
                return self._remove(client, place)
        return None

    def _has_lane(self, task: Task) -> bool:
        client = task.account.client
        if len(self._running) >= self._lanes.all or (client and len(self._runs(client)) >= self._lanes.of_client):
            return False
        return self._pace_of(task) == "fast" or self._has_slow_lane(client)

    def _has_slow_lane(self, client: str) -> bool:
        of_client = sum(run.pace == "slow" for run in self._runs(client))
        of_all = sum(run.pace == "slow" for run in self._running.values())
        return of_all < self._lanes.slow and not (client and of_client >= self._lanes.slow_of_client)

    def _runs(self, client: str) -> list[Run]:
        return [run for run in self._running.values() if run.task.account.client == client]

    def _pace_of(self, task: Task) -> Pace:
        return "slow" if task in self._outgrown else task.job.pace

    def _left(self, run: Run) -> float:
        """Seconds that a job should still take: what takes longer than usual goes on for some time."""
        elapsed = self._clock() - run.since
        return max(self._durations.usual(run.task.job.kind) - elapsed, OVERTIME * elapsed)

    def _in_turn(self) -> Iterator[Task]:
        """The tasks that wait, in the order in which they would be taken if none were kept from it by its pace."""
        lines = deque(deque(tasks) for tasks in self._by_client.values())
        while lines:
            line = lines.popleft()
            yield line.popleft()
            if line:
                lines.append(line)

    def _remove(self, client: str, place: int) -> Task:
        """Take a task out; its client is the last to have another turn."""
        tasks = self._by_client.pop(client)
        task = tasks[place]
        del tasks[place]
        if tasks:
            self._by_client[client] = tasks
        self._count -= 1
        return task
