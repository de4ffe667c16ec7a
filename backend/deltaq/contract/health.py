"""How the service is doing."""

from __future__ import annotations

from typing import Literal

from .base import Answer


class WorkerHealth(Answer):
    """Worker processes: all, up, busy; tasks that wait; workers killed or dead; processor time that jobs have used."""

    workers: int
    ready: int
    busy: int
    waiting: int
    kills: int
    processor_seconds: float


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


class Readiness(Answer):
    """Always true: a service that is not ready answers with a problem document."""

    ready: Literal[True]


class Version(Answer):
    """The released version, and a digest of what the answers depend on."""

    version: str
    source: str
