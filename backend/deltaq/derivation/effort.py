"""What the optional parts of the last chapter may cost, counted in operations: one question has one answer, always.

Each part has a share of its own, so that one that is too long leaves the others as they are. What is counted are the
parts of the expressions that are brought into a form, not seconds. Where a derivation has a time, what comes late is
left out before it is over; an answer that was cut by time is not the answer to the question, and nobody keeps it.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from time import monotonic, process_time
from typing import TypeVar

from ..vocabulary import Missing, OptionalPart

T = TypeVar("T")
SHARE = 300_000  # operations of each part: a few seconds, a hundred times what most scenes take


STEPS_END, EQUATIONS_END, PARTS_END = 0.45, 0.65, 0.75  # of the time: the rest is for putting it into words


class Spent(Exception):
    """The part has used its share, or the time; `why` says which."""

    def __init__(self, why: Missing = "budget") -> None:
        super().__init__(why)
        self.why = why


def since_now() -> Callable[[], float]:
    """A clock of seconds of the processor from now on, or of half those that passed, if these are more."""
    used, begun = process_time(), monotonic()
    return lambda: max(process_time() - used, (monotonic() - begun) / 2)


@dataclass(frozen=True)
class Allowance:
    """The time that a derivation has: so many seconds on its clock."""

    seconds: float = math.inf
    clock: Callable[[], float] = process_time

    def is_past(self, part: float) -> bool:
        """Whether so much of the time has passed."""
        return self.seconds < math.inf and self.clock() > part * self.seconds


UNBOUNDED = Allowance()


@dataclass
class Effort:
    """Who spends, how much each part has spent, which are missing and why. Outside of a part nothing counts."""

    share: int = SHARE
    allowance: Allowance = UNBOUNDED
    spent: dict[OptionalPart, int] = field(default_factory=dict)
    left_out: dict[OptionalPart, Missing] = field(default_factory=dict)
    running: list[OptionalPart] = field(default_factory=list)

    def spend(self, operations: int) -> None:
        """Counts operations of the part that runs. Raises Spent when its share is used up."""
        if not self.running:
            return
        part = self.running[-1]
        self.spent[part] = self.spent.get(part, 0) + operations
        if self.spent[part] > self.share:
            raise Spent
        if operations:  # what is known already takes no time
            self.look()

    def look(self) -> None:
        """Raises Spent where a part runs and the time for it has passed."""
        if self.running and self.allowance.is_past(PARTS_END):
            raise Spent("time")

    def afford(self, part: OptionalPart, compute: Callable[[], T], otherwise: T) -> T:
        """What is computed within the share of the part; else `otherwise`, and the part is left out."""
        self.running.append(part)
        try:
            self.spend(0)
            return compute()
        except Spent as error:
            self.left_out[part] = error.why
            return otherwise
        finally:
            self.running.pop()
