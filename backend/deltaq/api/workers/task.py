"""A job that somebody asked for."""

from __future__ import annotations

from concurrent.futures import Future
from dataclasses import dataclass, field

from .account import FREE, Account
from .job import Job
from .worker import NOBODY, Listener


@dataclass(frozen=True, eq=False)
class Task:
    """A job, its request as bytes, who hears its parts, who pays, and the future that waits for the answer's JSON."""

    job: Job
    request: bytes
    listener: Listener = NOBODY
    account: Account = FREE
    answer: Future[bytes] = field(default_factory=Future)
