"""How answers are kept."""

from __future__ import annotations

import gzip


def pack(answer: bytes) -> bytes:
    """Compressed once, for every time it is sent."""
    return gzip.compress(answer, 5, mtime=0)


def unpack(answer: bytes) -> bytes:
    """The JSON of a cached answer."""
    return gzip.decompress(answer)
