"""What is asked of a worker, and the ways in which it can end without an answer."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Literal

from ...errors import DeltaqError

Pace = Literal["fast", "slow"]
MOMENT = 1.0  # seconds of a processor


@dataclass(frozen=True)
class Job:
    """A function named `package.module:function` that turns a JSON document into a JSON document.

    Its process is killed `deadline` seconds after the job began, or when it has used `processor` seconds of processor
    time. The second bound is for short jobs: on a busy machine a process may wait longer than they take, which is not
    their fault. A `pure` job has no effect but its answer, so it may be run again when its worker was killed from
    outside. A generator yields parts and returns the answer. `threads` is how many of
    them the job may keep busy.

    A job that usually takes more than a MOMENT is `slow`; one worker is never given such a job. A `fast` job that has
    used more counts as slow from then on. If no slot for slow jobs is free then, it is stopped, if it is pure, and
    waits for one. Durations are remembered by `kind`.
    """

    target: str
    deadline: float
    pure: bool = True
    threads: int = 1
    pace: Pace = "fast"
    processor: float = math.inf
    name: str = ""

    @property
    def kind(self) -> str:
        """Jobs of one kind take about equally long: those of one name, else of one target."""
        return self.name or self.target

    @property
    def processor_time(self) -> float:
        """The bound of its processor time in seconds: no more than its threads can use before the deadline."""
        return min(self.processor, self.threads * self.deadline)

    def within(self, seconds: float) -> Job:
        """The same with so many seconds of processor time for each thread, and twice that by the clock."""
        return replace(self, deadline=2.0 * seconds, processor=self.threads * seconds)


class JobError(DeltaqError):
    """A job ended without an answer, and not because of its input."""


class DeadlineExceeded(JobError):
    """The job exceeded its deadline or its processor time; the process was killed."""


class GivenUp(JobError):
    """Nobody waits for the answer any more; the process was killed."""


class NotFast(JobError):
    """A job thought fast has used more than a MOMENT, and no slot of slow ones is free; its process was killed."""


class MemoryExceeded(JobError):
    """The job needed more memory than a worker may have."""


class WorkerDied(JobError):
    """The job ended the process that ran it."""


class WorkerKilled(WorkerDied):
    """The process that ran the job was killed from outside; the job may be run again."""


class Overloaded(JobError):
    """The queue is full, or the job waited in it for too long."""


class Preparing(Overloaded):
    """What the job runs in is being compiled, once on a machine, and was not there in time."""

    seconds = 10.0  # after which it is worth asking again


class JobFailed(JobError):
    """The job raised an exception that is our bug; `trace` is its traceback."""

    def __init__(self, summary: str, trace: str = "") -> None:
        super().__init__(summary)
        self.trace = trace
