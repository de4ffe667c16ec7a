"""What the routes share: settings, workers, cache, and the files of the page."""

from __future__ import annotations

import asyncio
import functools
import hashlib
import json
import logging
from collections.abc import Awaitable, Callable, Iterator
from dataclasses import dataclass, field, replace
from functools import partial
from importlib import import_module
from pathlib import Path
from threading import Event
from typing import Any

from fastapi import Request

from ..settings import Settings
from .assets import Assets
from .blocks import Blocks
from .body import LargeBodies
from .cache import Cache, content_hash
from .clients import ACCOUNT
from .ending import Ending
from .flights import OnUpdate, Update, ignore
from .kernels import Kernels
from .metrics import Metrics, make_metrics
from .packing import pack
from .page import SITE
from .stores.disk import Disk
from .stores.memory import Memory
from .stores.store import Store
from .workers.account import Ledger, QuotaExceeded
from .workers.job import Job
from .workers.pool import Pool
from .workers.queue import Place
from .workers.worker_thread import Limits

LOGGER = logging.getLogger("deltaq.api")
PACKAGE = Path(__file__).parents[1]
RESERVE = 1  # workers that slow jobs never get
NICENESS = 5  # of the workers; of those that experiment twice as much


@dataclass(frozen=True)
class Service:
    """One running service."""

    settings: Settings
    pool: Pool
    laboratory: Pool  # experiments: few at a time, for they measure times
    cache: Cache
    assets: Assets
    metrics: Metrics
    kernels: Kernels
    large_bodies: LargeBodies = field(default_factory=LargeBodies)
    ending: Ending = field(default_factory=Ending)

    async def answer(self, key: str, job: Job, document: Any) -> bytes:
        """The gzipped JSON of a pure job, from the cache if it is there."""

        async def compute(_publish: OnUpdate) -> bytes:
            return await asyncio.to_thread(pack, await self.run(job, document, key))

        async with self.pool.asked(key, ACCOUNT.get()):
            return await _shared(partial(self.cache.get, key, compute))

    async def parts(self, key: str, job: Job, document: Any, on_update: OnUpdate) -> bytes:
        """Like `answer`, of a job whose parts `on_update` receives before."""

        async def compute(publish: OnUpdate) -> bytes:
            whole = await self.pool.run(
                job, document, lambda part: publish(Update("part", part)), ACCOUNT.get(), key=key
            )
            return await asyncio.to_thread(pack, whole)

        async with self.pool.asked(key, ACCOUNT.get()):
            return await _shared(partial(self.cache.get, key, compute, on_update))

    async def blocks(self, key: str, job: Job, document: Any, blocks: Blocks, kernels: tuple[str, ...] = ()) -> bytes:
        """The JSON of a job's answer, whose parts are sent as `blocks` before; those that are known at once.

        Others wait for the `kernels` that the job takes.
        """
        if (known := await blocks.known(self.cache, key)) is not None:
            return known
        if kernels:
            await self.kernels.wait(*kernels, tell=lambda here, all_: blocks.tell(_preparing(here, all_)))
        result = await self.pool.run(
            job, document, ignore, ACCOUNT.get(), lambda place: blocks.tell(_waiting(place)), take=blocks.take
        )
        await blocks.keep(self.cache, key, result)
        return result

    async def measurement(
        self,
        key: str,
        job: Job,
        document: Any,
        on_update: OnUpdate | None,
        *,
        anew: bool,
        kernels: tuple[str, ...] | None = None,
    ) -> bytes:
        """The gzipped JSON of an experiment; `on_update` receives what it waits for, and its parts, before.

        `anew` measures what is in the cache already. It waits for the `kernels` that it takes, all if None: for as long
        as that takes if somebody hears of it, else until `Kernels` gives up. Who has been let in waits for minutes, and
        is not refused for what the experiments have cost that he asked for at the same time.
        """

        async def compute(publish: OnUpdate) -> bytes:
            if kernels is None or kernels:
                told = None if on_update is None else lambda here, all_: publish(_preparing(here, all_))
                await self.kernels.wait(*(kernels or ()), tell=told)
            account, has_begun = ACCOUNT.get(), Event()
            account.admit()

            def tell_part(part: bytes) -> None:
                has_begun.set()
                publish(Update("part", part))

            def tell_place(place: Place) -> None:
                if not has_begun.is_set():  # a part says as much, and may come before the next look at the queue
                    publish(_waiting(place))

            measured = await self.laboratory.run(job, document, tell_part, account.let_in(), tell_place, key)
            return await asyncio.to_thread(pack, measured)

        ask = self.cache.renew if anew else self.cache.get
        async with self.laboratory.asked(key, ACCOUNT.get()):
            return await _shared(partial(ask, key, compute, on_update or ignore))

    async def run(self, job: Job, document: Any, key: str = "") -> bytes:
        """The JSON of a job's answer, at the expense of the client that asks."""
        return await self.pool.run(job, document, ignore, ACCOUNT.get(), key=key)

    @staticmethod
    def key(*question: Any) -> str:
        """The content hash of a question: another version of δq may answer it differently, so its code counts too."""
        return content_hash(source_digest(), *question)


def _preparing(here: int, all_: int) -> Update:
    """How many of all kernels are compiled."""
    return Update("preparing", json.dumps({"kernels": here, "of": all_}).encode())


def _waiting(place: Place) -> Update:
    """Where somebody stands in a queue."""
    return Update("waiting", json.dumps({"place": place.number, "seconds": round(place.seconds, 1)}).encode())


async def _shared(ask: Callable[[], Awaitable[bytes]]) -> bytes:
    """What somebody else may have asked for at the same time, who then pays; and if he cannot, we may."""
    try:
        return await ask()
    except QuotaExceeded as error:
        if error.client == ACCOUNT.get().client:
            raise
        return await ask()


def make_service(settings: Settings) -> Service:
    """A service; its workers are not started yet."""
    limits = Limits(
        settings.worker_memory, settings.jobs_per_worker, settings.start_timeout, settings.queue_patience, NICENESS
    )
    pool = Pool(settings.workers, settings.queue_length, limits, reserve=RESERVE)
    waiting_longer = replace(limits, queue_timeout=settings.experiment_patience, niceness=2 * NICENESS)
    laboratory = Pool(settings.experiment_workers, settings.experiment_queue, waiting_longer)
    cache = Cache(Memory(settings.cache_size), *stores_of(settings))
    metrics = make_metrics({"requests": pool, "experiments": laboratory}, cache)
    return Service(settings, pool, laboratory, cache, make_assets(settings), metrics, Kernels())


def make_assets(settings: Settings) -> Assets:
    """The files of the pages. A package without a bundle says so: only a checkout is meant to serve its sources."""
    assets = Assets(static_root(settings.static), source_digest())
    if assets.root == PACKAGE / "static" and not assets.bundled:
        LOGGER.warning("the page is not bundled: this package was built without esbuild, and pages open slowly")
    return assets


def stores_of(settings: Settings) -> Iterator[Store]:
    """The stores behind the memory that the settings name, the fastest first."""
    if settings.cache_folder:
        yield Disk(Path(settings.cache_folder), settings.cache_folder_size)
    if settings.redis:
        yield import_module("deltaq.api.stores.shared").Shared(settings.redis)  # an extra; most do without


def make_ledger(settings: Settings) -> Ledger | None:
    """The ledger of the clients' shares; None if they may use what they like."""
    rate = settings.client_share * settings.workers
    return Ledger(rate, settings.client_credit) if rate > 0.0 else None


def service_of(request: Request) -> Service:
    """The service of the application that got the request."""
    service: Service = request.app.state.service
    return service


def static_root(configured: str) -> Path:
    """Where the page is: as configured, else frontend/ of the checkout, else static/ of the installed package."""
    checkout = PACKAGE.parents[1] / "frontend"
    if configured:
        return Path(configured)
    return checkout if (checkout / SITE).is_file() else PACKAGE / "static"


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
