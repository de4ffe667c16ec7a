"""A job that somebody asked for."""

from __future__ import annotations

from concurrent.futures import Future
from dataclasses import dataclass, field

from .account import FREE, Account
from .job import Job
from .worker import NOBODY, Listener


@dataclass(frozen=True, eq=False)
class Task:
    """A job, its request as bytes, who hears its parts, who pays, and the future that waits for the answer's JSON.

    What several clients ask for at once is one task for each of them, with the same `key` and the same `answer`: it
    waits at the place of each, and is run once, for the first who has his turn.
    """

    job: Job
    request: bytes
    listener: Listener = NOBODY
    account: Account = FREE
    answer: Future[bytes] = field(default_factory=Future)
    key: str = ""
