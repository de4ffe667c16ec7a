"""The log: one JSON object per line on standard error.

What a user wrote may stand in the message of an exception, so exceptions appear by kind and place alone, unless the
level is debug.
"""

from __future__ import annotations

import json
import logging
from datetime import UTC, datetime
from types import TracebackType
from typing import Any

from .access import REQUEST_ID
from .workers.traces import trace_of

ExceptionInfo = tuple[type[BaseException], BaseException, TracebackType | None] | tuple[None, None, None]


class Line(logging.Formatter):
    """A record as a line of JSON; `extra={"facts": {…}}` adds members."""

    def __init__(self, *, private: bool = True) -> None:
        super().__init__()
        self.private = private

    def format(self, record: logging.LogRecord) -> str:
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
        return trace_of(ei[1]) if self.private and ei[1] else super().formatException(ei)


def configure(level: str) -> None:
    """Make the process write its log as lines of JSON, from this level up."""
    handler = logging.StreamHandler()
    handler.setFormatter(Line(private=level != "debug"))
    logging.basicConfig(level=level.upper(), handlers=[handler], force=True)
