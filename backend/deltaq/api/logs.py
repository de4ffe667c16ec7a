"""The log: one JSON object per line on standard error, and no more of them than can be read.

What a user wrote may stand in the message of an exception, so exceptions appear by kind and place alone, unless the
level is debug.
"""

from __future__ import annotations

import json
import logging
import time
from collections.abc import Callable
from datetime import UTC, datetime
from types import TracebackType
from typing import Any

from .access import REQUEST_ID
from .workers.traces import trace_of

Place = tuple[str, int, str, int]
ExceptionInfo = tuple[type[BaseException], BaseException, TracebackType | None] | tuple[None, None, None]


class Line(logging.Formatter):
    """A record as a line of JSON; `extra={"facts": {…}}` adds members."""

    def __init__(self, *, private: bool = True) -> None:
        super().__init__()
        self.private = private

    def format(self, record: logging.LogRecord) -> str:
        """A record as one line of JSON: time (UTC), level, logger, message, and what else is known."""
        line: dict[str, Any] = {
            "time": datetime.fromtimestamp(record.created, UTC).isoformat(timespec="milliseconds"),
            "level": record.levelname.lower(),
            "logger": record.name,
            "message": record.getMessage(),
        }
        if identifier := REQUEST_ID.get():
            line["request"] = identifier
        line |= getattr(record, "facts", {})
        if record.exc_info:
            line["exception"] = self.formatException(record.exc_info)
        return json.dumps(line, ensure_ascii=False, default=str)

    def formatException(self, ei: ExceptionInfo) -> str:
        """The traceback; without the message of the exception where logs are private."""
        return trace_of(ei[1]) if self.private and ei[1] else super().formatException(ei)


class Repeats(logging.Filter):
    """Lets a warning or an error pass `most` times in `seconds`; the first that passes then tells how many did not.

    What is alike comes from one place in the code: of what is told about it the words may differ, and so may those who
    caused it. Reports on single requests are no warnings, and all of them pass.
    """

    def __init__(self, most: int = 20, seconds: float = 60.0, clock: Callable[[], float] = time.monotonic) -> None:
        super().__init__()
        self.most = most
        self.seconds = seconds
        self._clock = clock
        self._counts: dict[Place, tuple[float, int]] = {}  # when counting began, and how often since

    def filter(self, record: logging.LogRecord) -> bool:
        """Whether a record is written: warnings of one place only so often in a while."""
        if record.levelno < logging.WARNING:
            return True
        place, now = place_of(record), self._clock()
        began, count = self._counts.get(place, (now, 0))
        if now - began >= self.seconds:
            self._tell(record, count - self.most)
            began, count = now, 0
        self._counts[place] = began, count + 1
        return count < self.most

    @staticmethod
    def _tell(record: logging.LogRecord, missing: int) -> None:
        if missing > 0:
            record.facts = getattr(record, "facts", {}) | {"left_out": missing}


def place_of(record: logging.LogRecord) -> Place:
    """Where a record comes from: the line that logs, and the one that raised what it tells."""
    raised = record.exc_info[2] if record.exc_info else None
    while raised is not None and raised.tb_next is not None:
        raised = raised.tb_next
    where = (raised.tb_frame.f_code.co_filename, raised.tb_lineno) if raised else ("", 0)
    return (record.pathname, record.lineno, *where)


def configure(level: str) -> None:
    """Make the process write its log as lines of JSON, from this level up."""
    handler = logging.StreamHandler()
    handler.setFormatter(Line(private=level != "debug"))
    handler.addFilter(Repeats())
    logging.basicConfig(level=level.upper(), handlers=[handler], force=True)
