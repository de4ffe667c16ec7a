"""How the service is doing."""

from __future__ import annotations

from typing import Literal

from .base import Answer


class WorkerHealth(Answer):
    """Worker processes: all, up, busy; tasks that wait; workers that had to be killed or died."""

    workers: int
    ready: int
    busy: int
    waiting: int
    kills: int


class CacheHealth(Answer):
    """Answers in memory, their bytes, and how often the cache had the answer."""

    entries: int
    bytes: int
    hits: int
    misses: int


class Health(Answer):
    """`starting` until the first worker is up, then `ok`."""

    status: Literal["starting", "ok"]
    version: str
    workers: WorkerHealth
    cache: CacheHealth
