"""A promise and the figure that was measured for it: a row of the table of targets."""

from __future__ import annotations

import statistics
from collections.abc import Callable
from dataclasses import dataclass

REPEATS = 5


@dataclass(frozen=True)
class Target:
    """One promise: what, the target, the figure, whether it is met, and the benchmark that tells more."""

    what: str
    wanted: str
    figure: str
    met: bool
    command: str

    def __str__(self) -> str:
        return f"| {self.what} | {self.wanted} | {self.figure} | {'met' if self.met else 'missed'} | `{self.command}` |"


def medians(*works: Callable[[], float]) -> list[float]:
    """The median of each, taken in turns so that all see the same machine."""
    return [
        statistics.median(times) for times in zip(*([work() for work in works] for _ in range(REPEATS)), strict=True)
    ]
