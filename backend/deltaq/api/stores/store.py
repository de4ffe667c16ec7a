"""What a store of answers can do, and the seal by which a damaged answer is known."""

from __future__ import annotations

import hashlib
from typing import Protocol

DIGEST = 32  # bytes


class Store(Protocol):
    """Keeps answers by key. What cannot be read or written counts as missing; a store never raises."""

    @property
    def name(self) -> str:
        """What the metrics call it."""

    def load(self, key: str) -> bytes | None:
        """The answer of this key, or None."""

    def save(self, key: str, answer: bytes) -> None:
        """Keep an answer, if possible."""


def sealed(key: str, answer: bytes) -> bytes:
    """The answer behind a digest of itself and its key, so that it counts under no other."""
    return _digest(key, answer) + answer


def unsealed(key: str, content: bytes) -> bytes | None:
    """The answer, or None if not every bit is as it was."""
    answer = content[DIGEST:]
    return answer if content[:DIGEST] == _digest(key, answer) else None


def _digest(key: str, answer: bytes) -> bytes:
    return hashlib.sha256(key.encode() + b"\0" + answer).digest()
