"""Where a functional looks at its functions: at an instant, or over an interval of time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, cast

from ..language.tree import Node
from ..vocabulary import Ends

End = Literal["fixed", "hinged", "free"]
# How many of δx, δẋ are zero at an end: all of them, the function's own only, none.
HELD: Mapping[End, int] = {"fixed": 2, "hinged": 1, "free": 0}


@dataclass(frozen=True)
class Instant:
    """The functional that takes the value at an instant."""

    at: Node


@dataclass(frozen=True)
class Interval:
    """The functional that integrates from `lower` to `upper`.

    At a fixed end the functions are prescribed with the rates that need it, at a hinged one the functions alone.
    `ends` holds for both of them, or names the lower one first: "fixed-free".
    """

    lower: Node
    upper: Node
    ends: Ends

    @property
    def held(self) -> tuple[int, int]:
        """How many of δx, δẋ are zero at the lower and at the upper end."""
        lower, _, upper = self.ends.partition("-")
        return HELD[cast("End", lower)], HELD[cast("End", upper or lower)]
