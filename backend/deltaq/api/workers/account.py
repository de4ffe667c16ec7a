"""What the jobs of each client have cost, in seconds of processor time."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from threading import Lock

from .job import JobError

MOST_CLIENTS = 10_000


class QuotaExceeded(JobError):
    """A client has used more than its share; it may ask again in `seconds`."""

    def __init__(self, client: str, seconds: float) -> None:
        super().__init__(f"more than its share; again in {seconds:.0f} s")
        self.client = client
        self.seconds = seconds


class Ledger:
    """What clients owe, in seconds of processor time: a leaky bucket for each of them.

    A client may owe `credit` seconds, and `rate` seconds are forgiven per second. So one client gets `rate` processors
    in the long run, and `credit` seconds of them at once. Used from many threads.
    """

    def __init__(self, rate: float, credit: float, clock: Callable[[], float] = time.monotonic) -> None:
        self.rate = rate
        self.credit = credit
        self._clock = clock
        self._debts: dict[str, tuple[float, float]] = {}  # seconds owed, and when that was so
        self._lock = Lock()

    def debt(self, client: str) -> float:
        """What a client owes now, in seconds of processor time."""
        owed, then = self._debts.get(client, (0.0, 0.0))
        return max(0.0, owed - self.rate * (self._clock() - then))

    def admit(self, client: str) -> None:
        """Raises QuotaExceeded if the client owes more than its credit."""
        excess = self.debt(client) - self.credit
        if excess > 0.0:
            raise QuotaExceeded(client, excess / self.rate)

    def charge(self, client: str, seconds: float) -> None:
        """Adds to what a client owes."""
        with self._lock:
            self._debts[client] = (self.debt(client) + seconds, self._clock())
            if len(self._debts) > MOST_CLIENTS:
                self._debts = {one: self._debts[one] for one in self._debts if self.debt(one) > 0.0}


@dataclass(frozen=True)
class Account:
    """A client and the ledger of its costs; without a ledger its jobs cost nothing."""

    client: str
    ledger: Ledger | None = None
    is_in: bool = False

    def let_in(self) -> Account:
        """The same account, which is not refused any more: its request was admitted and may wait long."""
        return replace(self, is_in=True)

    def admit(self) -> None:
        """Raises QuotaExceeded if the client has used more than its share."""
        if self.ledger and not self.is_in:
            self.ledger.admit(self.client)

    def pay(self, seconds: float) -> None:
        """Charges processor time, in seconds."""
        if self.ledger:
            self.ledger.charge(self.client, seconds)


FREE = Account("")
