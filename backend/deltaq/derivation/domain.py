"""Where a functional looks at its functions: at an instant, or over an interval of time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from ..language.tree import Node

Ends = Literal["fixed", "free", "fixed-free", "free-fixed"]
FIXED: Mapping[Ends, tuple[bool, bool]] = {
    "fixed": (True, True),
    "free": (False, False),
    "fixed-free": (True, False),
    "free-fixed": (False, True),
}


@dataclass(frozen=True)
class Instant:
    """The functional that takes the value at an instant."""

    at: Node


@dataclass(frozen=True)
class Interval:
    """The functional that integrates from `lower` to `upper`; the functions are prescribed at fixed ends only.

    `ends` holds for both of them, or names the lower one first: "fixed-free".
    """

    lower: Node
    upper: Node
    ends: Ends
