"""The tasks that wait: clients take turns, and what may not run yet does not keep what may waiting."""

from __future__ import annotations

import time
from collections import OrderedDict, deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from threading import Condition
from weakref import WeakSet

from .account import Account
from .job import Overloaded, Pace
from .occupancy import Occupancy, Slots
from .task import Task


@dataclass(frozen=True)
class Place:
    """Where a task stands in the queue, 1 for the next, and in how many seconds it should begin."""

    number: int
    seconds: float


BEGUN = Place(0, 0.0)


class FairQueue:
    """Clients take turns. At most `length` tasks wait, at most half of them for one client but the nameless one."""

    def __init__(self, length: int, slots: Slots, clock: Callable[[], float] = time.monotonic) -> None:
        self._length = length
        self._running = Occupancy(slots, clock)
        self._count = 0
        self._open = True
        self._by_client: OrderedDict[str, deque[Task]] = OrderedDict()  # whose turn it is stands first
        self._turned_slow: WeakSet[Task] = WeakSet()
        self._idle: list[object] = []
        self._changed = Condition()

    def __len__(self) -> int:
        return self._count

    def put(self, task: Task) -> None:
        """Adds a task. Raises Overloaded if the queue is full, or its client has half of the places."""
        client = task.account.client
        with self._changed:
            own = self._by_client.get(client, ())
            if not self._open or self._count >= self._length or (client and 2 * len(own) >= self._length):
                raise Overloaded("the queue is full")
            self._by_client.setdefault(client, deque()).append(task)
            self._count += 1
            self._changed.notify_all()

    def take(self) -> Task | None:
        """Waits for the next task that may run; None when the queue is closed. The taker calls `done` at its end.

        Of several threads that wait, the one that began last is served first: the caches of its worker are the warmest.
        """
        taker, task = object(), None
        with self._changed:
            self._idle.append(taker)
            while self._open and (self._idle[-1] is not taker or (task := self.take_now()) is None):
                self._changed.wait()
            self._idle.remove(taker)
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
        """Frees the slot of a task that was taken; `answered` if it came to its end."""
        with self._changed:
            self._running.end(task, answered=answered)
            self._changed.notify_all()

    def go_on_as_slow(self, task: Task) -> bool:
        """Whether a task that has used more than a moment may go on, now as a slow one."""
        with self._changed:
            return self._running.go_on_as_slow(task)

    def put_back(self, task: Task) -> None:
        """Returns a task to the front of its client's, as a slow one. Raises Overloaded if the queue is closed."""
        client = task.account.client
        with self._changed:
            if not self._open:
                raise Overloaded("the service is stopping")
            self._turned_slow.add(task)
            self._by_client.setdefault(client, deque()).appendleft(task)
            self._count += 1
            self._changed.notify_all()

    def share(self, key: str, account: Account) -> None:
        """Gives the task that waits under a key another place, of this client. Raises Overloaded if there is none."""
        with self._changed:
            found = next((task for task in self._waiting() if task.key == key), None)
            if found is None or any(one.answer is found.answer for one in self._by_client.get(account.client, ())):
                return
            own = replace(found, account=account)
            if found in self._turned_slow:
                self._turned_slow.add(own)
            self.put(own)

    def leave(self, key: str, client: str) -> None:
        """Frees the place of a client who no longer waits for what others still wait for."""
        with self._changed:
            for task in [one for one in self._by_client.get(client, ()) if one.key == key]:
                if sum(one.answer is task.answer for one in self._waiting()) > 1:
                    self._free(task)

    def discard(self, task: Task) -> bool:
        """Removes a task from all its places; False if it has none."""
        with self._changed:
            alike = [one for one in self._waiting() if one.answer is task.answer]
            for one in alike:
                self._free(one)
            self._changed.notify_all()
            return bool(alike)

    def place_of(self, task: Task) -> Place | None:
        """The place of a task that waits, else None."""
        with self._changed:
            ahead = self._running.left
            for number, one in enumerate(self._in_turn(), 1):
                if one.answer is task.answer:
                    return Place(number, sum(ahead) / self._running.slots.all)
                ahead.append(self._running.durations.usual(one.job.kind))
            return None

    def is_running(self, task: Task) -> bool:
        """Whether a task runs."""
        return task in self._running

    def close(self) -> list[Task]:
        """Closes the queue, and returns the tasks that still waited."""
        with self._changed:
            self._open = False
            left = list(self._waiting())
            self._by_client.clear()
            self._count = 0
            self._changed.notify_all()
            return left

    def _next(self) -> Task | None:
        """The first task that may run, of the first client in turn who has one; it waits no more."""
        for client, tasks in self._by_client.items():
            place = next((n for n, task in enumerate(tasks) if self._has_slot(task)), None)
            if place is not None:
                task = self._remove(client, place)
                self.discard(task)  # the others who ask for it wait for the same answer
                return task
        return None

    def _waiting(self) -> Iterator[Task]:
        return (task for tasks in self._by_client.values() for task in tasks)

    def _free(self, task: Task) -> None:
        """Free one place; whose turn it is stays as it is."""
        tasks = self._by_client[task.account.client]
        tasks.remove(task)
        self._count -= 1
        if not tasks:
            del self._by_client[task.account.client]

    def _has_slot(self, task: Task) -> bool:
        return self._running.has_slot(task.account.client, self._pace_of(task))

    def _pace_of(self, task: Task) -> Pace:
        return "slow" if task in self._turned_slow else task.job.pace

    def _in_turn(self) -> Iterator[Task]:
        """The tasks that wait, in the order in which they would be taken if none were kept from it by its pace."""
        lines = deque(deque(tasks) for tasks in self._by_client.values())
        seen = set[int]()
        while lines:
            line = lines.popleft()
            task = line.popleft()
            if id(task.answer) not in seen:  # what several wait for is run once
                yield task
            seen.add(id(task.answer))
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
