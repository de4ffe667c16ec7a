"""The tasks that wait: clients take turns, and what may not run yet does not keep what may waiting."""

from __future__ import annotations

import time
from collections import OrderedDict, deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from threading import Condition
from weakref import WeakSet

from .job import Overloaded, Pace
from .occupancy import Lanes, Occupancy
from .task import Task


@dataclass(frozen=True)
class Place:
    """Where a task stands in the queue, 1 for the next, and in how many seconds it should begin."""

    number: int
    seconds: float


BEGUN = Place(0, 0.0)


class FairQueue:
    """At most `length` tasks wait; no client but the nameless one may hold more than half of the places."""

    def __init__(self, length: int, lanes: Lanes, clock: Callable[[], float] = time.monotonic) -> None:
        self._length = length
        self._running = Occupancy(lanes, clock)
        self._count = 0
        self._open = True
        self._by_client: OrderedDict[str, deque[Task]] = OrderedDict()  # whose turn it is stands first
        self._outgrown: WeakSet[Task] = WeakSet()
        self._idle: list[object] = []
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
                self._running.begin(task, self._pace_of(task))
            return task

    def done(self, task: Task, *, answered: bool = False) -> None:
        """A task that was taken needs its lane no more; `answered` if it came to its end."""
        with self._changed:
            self._running.end(task, answered=answered)
            self._changed.notify_all()

    def outgrow(self, task: Task) -> bool:
        """Whether a task that has run for more than a moment may go on, as a slow one from now on."""
        with self._changed:
            return self._running.outgrow(task)

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
            ahead = self._running.left
            for number, one in enumerate(self._in_turn(), 1):
                if one is task:
                    return Place(number, sum(ahead) / self._running.lanes.all)
                ahead.append(self._running.durations.usual(one.job.kind))
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
        return self._running.has_lane(task.account.client, self._pace_of(task))

    def _pace_of(self, task: Task) -> Pace:
        return "slow" if task in self._outgrown else task.job.pace

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
