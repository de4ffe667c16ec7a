"""A cache of answers in a Redis, which several replicas share."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable

from redis import Redis, RedisError

from .store import verified, with_digest

LOGGER = logging.getLogger("deltaq.cache")
LASTING = 30 * 86400  # seconds
TIMEOUT = 0.25  # seconds; a computation is seldom worth a longer wait
PAUSE = 5.0  # seconds for which a Redis that failed is left alone
PREFIX = "deltaq:"


class Shared:
    """Redis drops what was used longest ago by itself (maxmemory-policy allkeys-lru)."""

    name = "redis"

    def __init__(self, address: str) -> None:
        self._redis = Redis.from_url(address, socket_timeout=TIMEOUT, socket_connect_timeout=TIMEOUT)
        self._quiet_until = 0.0

    def load(self, key: str) -> bytes | None:
        """The answer of this key, None if it is missing or damaged."""
        content = self._tried(lambda: self._redis.get(PREFIX + key))
        return verified(key, content) if isinstance(content, bytes) else None

    def save(self, key: str, answer: bytes) -> None:
        """Stores an answer for LASTING seconds at most."""
        self._tried(lambda: self._redis.set(PREFIX + key, with_digest(key, answer), ex=LASTING))

    def _tried(self, call: Callable[[], object]) -> object:
        """What the call gives; None while Redis is gone, which is tried again after a pause."""
        if time.monotonic() < self._quiet_until:
            return None
        try:
            return call()
        except RedisError as error:
            self._quiet_until = time.monotonic() + PAUSE
            LOGGER.warning("Redis does not answer: %s", type(error).__name__)
            return None
