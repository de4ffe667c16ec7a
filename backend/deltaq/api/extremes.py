"""Numbers so large or small that a computation may fail with them, though it would not with any others.

Their squares and products leave the range of floating-point numbers (IEEE 754: 5e-324 to 1.8e308). Most computations
end well all the same, and say what came of it; of one that fails, the numbers are to blame.
"""

from __future__ import annotations

import logging
import re
from collections.abc import Awaitable, Iterator
from itertools import islice
from typing import Any, TypeVar

from ..errors import MOST_PROBLEMS, Problem, RequestError, escaped
from .workers.job import JobFailed

T = TypeVar("T")
LOGGER = logging.getLogger("deltaq.api")
SMALLEST, LARGEST = 1e-30, 1e30  # with the numbers of physics that a scene may have in between
_CONSTANT = re.compile(r"\d{20}|\.0{20}|[eE][+-]?(?:[3-9]\d|\d{3})|(?:\^|\*\*)\s*[({]?\s*-?\s*(?:[2-9]\d|\d{3})")


async def unless_extreme(work: Awaitable[T], question: Any) -> T:
    """What the work gives; RequestError with the extreme numbers of the question if it fails and there are any."""
    try:
        return await work
    except JobFailed as error:
        found = tuple(islice(extremes(question), MOST_PROBLEMS + 1))
        if not found:
            raise
        LOGGER.warning("failed with extreme numbers: %s", error.trace)
        raise RequestError(*found) from None


def extremes(part: Any, pointer: str = "") -> Iterator[Problem]:
    """A problem for each extreme number, and for each text that has one."""
    if isinstance(part, dict):
        for name, one in part.items():
            yield from extremes(one, f"{pointer}/{escaped(str(name))}")
    elif isinstance(part, (list, tuple)):
        for index, one in enumerate(part):
            yield from extremes(one, f"{pointer}/{index}")
    elif _is_extreme(part):
        yield Problem("extreme-number", pointer, parameters={"least": SMALLEST, "most": LARGEST})


def _is_extreme(value: Any) -> bool:
    if isinstance(value, str):
        return _CONSTANT.search(value) is not None
    return isinstance(value, (int, float)) and value != 0 and not SMALLEST <= abs(value) <= LARGEST
