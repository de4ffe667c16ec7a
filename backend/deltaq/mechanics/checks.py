"""What the frozen types of this package check about themselves."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator

from ..errors import Problem, SceneError

NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,31}")  # of places and loads: they become classes and keys of the page


def demand(*problems: Problem | None) -> None:
    """Raises SceneError if there is any problem."""
    found = [problem for problem in problems if problem is not None]
    if found:
        raise SceneError(*found)


def name_problem(name: str, pointer: str = "/name") -> Problem | None:
    if NAME.fullmatch(name):
        return None
    return Problem("invalid-name", pointer, parameters={"name": name[:40]})


def range_problems(value: float, low: float | None, high: float | None) -> Iterator[Problem]:
    """The value must be finite and lie between its bounds."""
    numbers = {"/value": value, "/min": low, "/max": high}
    not_finite = [key for key, number in numbers.items() if number is not None and not math.isfinite(number)]
    yield from (Problem("not-finite", key) for key in not_finite)
    if not_finite:
        return
    if low is not None and high is not None and low >= high:
        yield Problem("empty-range", "/max", parameters={"min": low, "max": high})
    elif (low is not None and value < low) or (high is not None and value > high):
        yield Problem("outside-range", "/value", parameters={"value": value, "min": str(low), "max": str(high)})
