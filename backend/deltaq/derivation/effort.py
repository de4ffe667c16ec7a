"""What the optional parts of the last chapter may cost, counted in operations: one question has one answer, always.

Each part has a share of its own, so that one that is too long leaves the others as they are. What is counted are the
parts of the expressions that are brought into a form, not seconds.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TypeVar

from ..vocabulary import Missing, OptionalPart

T = TypeVar("T")
SHARE = 300_000  # operations of each part: a few seconds, a hundred times what most scenes take


class Spent(Exception):
    """The part has used its share."""


@dataclass
class Effort:
    """Who spends, how much each part has spent, which are missing and why. Outside of a part nothing counts."""

    share: int = SHARE
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

    def afford(self, part: OptionalPart, compute: Callable[[], T], otherwise: T) -> T:
        """What is computed within the share of the part; else `otherwise`, and the part is left out."""
        self.running.append(part)
        try:
            self.spend(0)
            return compute()
        except Spent:
            self.left_out[part] = "budget"
            return otherwise
        finally:
            self.running.pop()
