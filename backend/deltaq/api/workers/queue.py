"""The tasks that wait: clients take turns, and what is slow does not keep what is fast waiting."""

from __future__ import annotations

from collections import OrderedDict, deque
from collections.abc import Collection
from threading import Condition

from .job import Overloaded, Pace
from .task import Task


class FairQueue:
    """At most `length` tasks; no client but the nameless one may hold more than half of the places."""

    def __init__(self, length: int) -> None:
        self._length = length
        self._count = 0
        self._open = True
        self._by_client: OrderedDict[str, deque[Task]] = OrderedDict()  # whose turn it is stands first
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

    def take(self, paces: Collection[Pace]) -> Task | None:
        """The next task of one of these paces, waited for; None when the queue is closed."""
        with self._changed:
            while self._open:
                for client, tasks in self._by_client.items():
                    place = next((n for n, task in enumerate(tasks) if task.job.pace in paces), None)
                    if place is not None:
                        return self._remove(client, place)
                self._changed.wait()
            return None

    def discard(self, task: Task) -> None:
        """Free the place of a task that nobody waits for any more."""
        client = task.account.client
        with self._changed:
            places = (n for n, one in enumerate(self._by_client.get(client, ())) if one is task)
            if (place := next(places, None)) is not None:
                self._remove(client, place)

    def close(self) -> list[Task]:
        """End all waiting; the tasks that are left."""
        with self._changed:
            self._open = False
            left = [task for tasks in self._by_client.values() for task in tasks]
            self._by_client.clear()
            self._count = 0
            self._changed.notify_all()
            return left

    def _remove(self, client: str, place: int) -> Task:
        """Take a task out; its client is the last to have another turn."""
        tasks = self._by_client.pop(client)
        task = tasks[place]
        del tasks[place]
        if tasks:
            self._by_client[client] = tasks
        self._count -= 1
        return task
