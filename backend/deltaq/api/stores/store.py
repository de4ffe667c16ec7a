"""What a store of answers can do, and the digest by which a damaged answer is known."""

from __future__ import annotations

import hashlib
from typing import Protocol

DIGEST = 32  # bytes


class Store(Protocol):
    """Answers by key. What cannot be read or written counts as missing; a store never raises."""

    @property
    def name(self) -> str:
        """What the metrics call it."""

    def load(self, key: str) -> bytes | None:
        """The answer of this key, or None."""

    def save(self, key: str, answer: bytes) -> None:
        """Stores an answer, if possible."""


def with_digest(key: str, answer: bytes) -> bytes:
    """The answer behind a digest (SHA-256) of its key and itself, so that it counts under no other key."""
    return _digest(key, answer) + answer


def verified(key: str, content: bytes) -> bytes | None:
    """The answer without its digest; None if that does not fit."""
    answer = content[DIGEST:]
    return answer if content[:DIGEST] == _digest(key, answer) else None


def _digest(key: str, answer: bytes) -> bytes:
    return hashlib.sha256(key.encode() + b"\0" + answer).digest()
