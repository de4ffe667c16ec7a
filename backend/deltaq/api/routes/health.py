"""How the service is doing: alive, ready, and which version of it."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from fastapi import APIRouter, Request, Response

from ... import __version__
from ...contract.health import CacheHealth, Health, Readiness, Version, WorkerHealth
from ..body import HeadedRoute
from ..metrics import MEDIA_TYPE
from ..service import service_of, source_digest
from ..workers.job import Overloaded
from .common import failures

router = APIRouter(tags=["service"], route_class=HeadedRoute)
TEXT: dict[int | str, dict[str, Any]] = {200: {"content": {"text/plain": {"schema": {"type": "string"}}}}}


@router.get("/health", responses=failures())
async def health(request: Request) -> Health:
    """Whether the service is alive: status, version, workers and cache."""
    service = service_of(request)
    state, cache = service.pool.state, service.cache
    return Health(
        status="ok" if state.ready else "starting",
        version=__version__,
        workers=WorkerHealth(**asdict(state)),
        cache=CacheHealth(
            entries=len(cache.memory), bytes=cache.memory.used, hits=cache.hits.total(), misses=cache.misses
        ),
    )


@router.get("/ready", responses=failures(503))
async def ready(request: Request) -> Readiness:
    """Whether a request would be computed now: 503 while no worker is up or the queue is full."""
    state = service_of(request).pool.state
    if not state.ready or state.waiting >= service_of(request).settings.queue_length:
        raise Overloaded("no worker is up, or the queue is full")
    return Readiness(ready=True)


@router.get("/version", responses=failures())
async def version() -> Version:
    """The version of δq, and a digest of its code, scenes and texts; replicas of one digest share a cache."""
    return Version(version=__version__, source=source_digest())


@router.get("/metrics", response_class=Response, responses=TEXT | failures())
async def metrics(request: Request) -> Response:
    """Latencies by route, queue, workers, cache and kernels in the exposition format of Prometheus."""
    return Response(service_of(request).metrics.text(), media_type=MEDIA_TYPE)
