"""What the routes share: settings, workers, cache, and the files of the page."""

from __future__ import annotations

import asyncio
import functools
import gzip
import hashlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from fastapi import Request

from ..settings import Settings
from .assets import Assets
from .cache import Cache, content_hash
from .metrics import Metrics, make_metrics
from .workers.job import Job
from .workers.lane import Limits
from .workers.pool import Pool

PACKAGE = Path(__file__).parents[1]
PRELOAD = "deltaq.api.workers.preload"


@dataclass(frozen=True)
class Service:
    """One running service."""

    settings: Settings
    pool: Pool
    laboratory: Pool  # experiments: few at a time, for they measure times
    cache: Cache
    assets: Assets
    metrics: Metrics

    async def answer(self, key: str, job: Job, document: Any) -> bytes:
        """The gzipped JSON of a pure job, from the cache if it is there."""

        async def compute() -> bytes:
            return await asyncio.to_thread(pack, await self.pool.run(job, document))

        return await self.cache.get(key, compute)

    @staticmethod
    def key(*question: Any) -> str:
        """The content hash of a question: another version of δq may answer it differently, so its code counts too."""
        return content_hash(source_digest(), *question)


def make_service(settings: Settings) -> Service:
    """A service; its workers are not started yet."""
    limits = Limits(settings.worker_memory, settings.jobs_per_worker, settings.start_timeout, settings.queue_patience)
    pool = Pool(settings.workers, settings.queue_length, limits, (PRELOAD,))
    laboratory = Pool(settings.experiment_workers, settings.experiment_queue, limits, (PRELOAD,))
    cache = Cache(settings.cache_size)
    return Service(settings, pool, laboratory, cache, Assets(static_root(settings.static)), make_metrics(pool, cache))


def pack(answer: bytes) -> bytes:
    """Compressed once, for every time it is sent."""
    return gzip.compress(answer, 5, mtime=0)


def unpack(answer: bytes) -> bytes:
    """The JSON of a kept answer."""
    return gzip.decompress(answer)


def service_of(request: Request) -> Service:
    """The service of the application that got the request."""
    service: Service = request.app.state.service
    return service


def static_root(configured: str) -> Path:
    """Where the page is: as configured, else frontend/ of the checkout, else static/ of the installed package."""
    checkout = PACKAGE.parents[1] / "frontend"
    if configured:
        return Path(configured)
    return checkout if (checkout / "index.html").is_file() else PACKAGE / "static"


@functools.cache
def source_digest() -> str:
    """A digest of the package's code, scenes and catalogs."""
    digest = hashlib.sha256()
    for file in sorted(_sources(PACKAGE)):
        digest.update(file.read_bytes())
    return digest.hexdigest()[:16]


def _sources(package: Path) -> Iterator[Path]:
    for pattern in ("*.py", "*.toml", "*.json"):
        yield from (file for file in package.rglob(pattern) if "static" not in file.relative_to(package).parts)
