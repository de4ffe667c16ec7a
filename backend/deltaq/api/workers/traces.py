"""Where an exception came from, without what it says: that may be the user's own text."""

from __future__ import annotations

import traceback

LONGEST_CHAIN = 8
LONGEST = 10_000  # characters


def trace_of(error: BaseException) -> str:
    """Kind and lines of code of an exception, after those of its causes."""
    chain: list[str] = []
    link: BaseException | None = error
    while link is not None and len(chain) < LONGEST_CHAIN:
        chain.append("".join([*traceback.format_tb(link.__traceback__), type(link).__name__]))
        link = link.__cause__ or (None if link.__suppress_context__ else link.__context__)
    return "\n\n".join(reversed(chain))[-LONGEST:]
