"""How the service is doing."""

from __future__ import annotations

from dataclasses import asdict

from fastapi import APIRouter, Request

from ... import __version__
from ..service import service_of
from ..wire.health import CacheHealth, Health, WorkerHealth
from .common import failures

router = APIRouter(prefix="/health", tags=["service"])


@router.get("", responses=failures())
async def health(request: Request) -> Health:
    """Status, version, workers and cache."""
    service = service_of(request)
    state, cache = service.pool.state, service.cache
    return Health(
        status="ok" if state.ready else "starting",
        version=__version__,
        workers=WorkerHealth(**asdict(state)),
        cache=CacheHealth(entries=len(cache), bytes=cache.used, hits=cache.hits, misses=cache.misses),
    )
