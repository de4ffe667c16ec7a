"""What schemathesis is told of this API: which cases it makes, how a body of TOML is written, when 504 is an answer."""

from __future__ import annotations

import os
import sys
from typing import Any
from zlib import crc32

import schemathesis

SOONEST = 0.2  # seconds: the least bound of any computation
# Of so many cases one is made: which ones depends on what is sent, not on their order, and on the number of the turn;
# as many runs with numbers that follow one another make all of them.
SHARE, TURN = "SCHEMA_ONE_IN", "SCHEMA_TURN"


@schemathesis.hook
def filter_case(_context: Any, case: Any) -> bool:
    """Whether a request is among those that a run takes."""
    sent = repr((case.method, case.path, case.path_parameters, case.query, case.headers, case.body))
    drawn = crc32(sent.encode("utf-8", "backslashreplace")) - int(os.environ.get(TURN, "0"))
    return drawn % int(os.environ.get(SHARE, "1")) == 0


@schemathesis.serializer("application/toml")
def text(_context: Any, value: Any) -> bytes:
    """The text as bytes; what is no text has no TOML."""
    return value.encode("utf-8", "backslashreplace") if isinstance(value, str) else b"\xff"


@schemathesis.check
def too_large_took_its_time(_context: Any, response: Any, case: Any) -> None:
    """A computation is too large when it has reached a bound, not before; each is told, for somebody to look at."""
    if response.status_code == 504:
        print(f"504 after {response.elapsed:.1f} s: {case.method} {case.path}", file=sys.stderr)
        assert response.elapsed > SOONEST, f"too large after {response.elapsed} s"
