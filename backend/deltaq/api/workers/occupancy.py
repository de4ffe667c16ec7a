"""Which jobs run, which others may start, and how long they should take. Guarded by the queue's lock.

A job that runs keeps its slot until it ends, so some slots are reserved:

- one slot is never given to a client who has all the others;
- one slot is never given to a slow job;
- of the slots for slow jobs, one is never given to a client who has all the others of them.

Where there is only one such slot, anybody may have it. The nameless client, who asks from the machine itself, may have
all of them.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from .job import Pace
from .task import Task

FIRST_GUESS = 10.0  # seconds that a job takes of whose like none has ended yet
OVERTIME = 0.25  # of the seconds that a job has taken, where it has taken longer than usual
RECENT = 0.3  # weight of the last duration in the mean


@dataclass(frozen=True)
class Slots:
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
class Run:
    """A task that runs, since when (seconds of the clock), and whether it counts as slow."""

    task: Task
    pace: Pace
    since: float


class Durations:
    """The usual duration of each kind of job in seconds, an exponentially weighted mean."""

    def __init__(self) -> None:
        self._means: dict[str, float] = {}

    def note(self, kind: str, seconds: float) -> None:
        """A job of a kind has taken so many seconds."""
        mean = self._means.get(kind, seconds)
        self._means[kind] = mean + RECENT * (seconds - mean)

    def usual(self, kind: str) -> float:
        """The mean duration of a kind in seconds; of a new kind that of all kinds."""
        of_all = sum(self._means.values()) / len(self._means) if self._means else FIRST_GUESS
        return self._means.get(kind, of_all)


class Occupancy:
    """The jobs that run, and the slots that are left."""

    def __init__(self, slots: Slots, clock: Callable[[], float]) -> None:
        self.slots = slots
        self.durations = Durations()
        self._clock = clock
        self._runs: dict[Task, Run] = {}

    def __contains__(self, task: Task) -> bool:
        return any(run.answer is task.answer for run in self._runs)

    def begin(self, task: Task, pace: Pace) -> None:
        """A task starts."""
        self._runs[task] = Run(task, pace, self._clock())

    def end(self, task: Task, *, answered: bool) -> None:
        """A task has ended, and its slot is free; its duration counts if it was `answered`."""
        run = self._runs.pop(task, None)
        if run is not None and answered:
            self.durations.note(task.job.kind, self._clock() - run.since)

    def has_slot(self, client: str, pace: Pace) -> bool:
        """Whether another job of this client may begin."""
        if len(self._runs) >= self.slots.all or (client and len(self._of(client)) >= self.slots.of_client):
            return False
        return pace == "fast" or self._has_slow_slot(client)

    def go_on_as_slow(self, task: Task) -> bool:
        """Whether a task that has run for more than a moment may go on, as a slow one from now on."""
        run = self._runs.get(task)
        if run is None or run.pace == "slow":
            return True
        if not self._has_slow_slot(task.account.client):
            return False
        self._runs[task] = Run(task, "slow", run.since)
        return True

    @property
    def left(self) -> list[float]:
        """The seconds that each job should still take; a job that takes longer than usual is given a quarter more."""
        return [self._left(run) for run in self._runs.values()]

    def _left(self, run: Run) -> float:
        elapsed = self._clock() - run.since
        return max(self.durations.usual(run.task.job.kind) - elapsed, OVERTIME * elapsed)

    def _has_slow_slot(self, client: str) -> bool:
        of_client = sum(run.pace == "slow" for run in self._of(client))
        of_all = sum(run.pace == "slow" for run in self._runs.values())
        return of_all < self.slots.slow and not (client and of_client >= self.slots.slow_of_client)

    def _of(self, client: str) -> list[Run]:
        return [run for run in self._runs.values() if run.task.account.client == client]
