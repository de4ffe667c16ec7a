"""The application: routes, error map, headers, and the life of the workers."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager, suppress
from typing import Any

from fastapi import APIRouter, FastAPI
from starlette.middleware.cors import CORSMiddleware
from starlette.middleware.gzip import GZipMiddleware

from .. import __version__
from ..packages import modules_of
from ..settings import Settings
from . import problems
from .access import Access
from .clients import Clients, Proxies
from .description import DESCRIPTION, SUMMARY, DescribedAPI, operation_id, subjects
from .headers import SecurityHeaders
from .heads import Heads
from .hosts import TrustedHosts
from .routes import pages
from .routes.common import PREFIX
from .service import Service, make_ledger, make_service

# What pages of other origins may do, where the settings let them in; they never bring cookies, for there are none.
CROSS_ORIGIN: Any = {
    "allow_methods": ["GET", "POST"],
    "allow_headers": ["Content-Type", "If-None-Match", "X-Request-ID"],
    "expose_headers": ["Content-Location", "ETag", "Retry-After", "X-Request-ID"],
    "max_age": 86400,
}


def create_app(settings: Settings | None = None) -> FastAPI:
    """A FastAPI application with its own workers and cache."""
    service = make_service(settings or Settings.from_environment())
    app = DescribedAPI(
        title="deltaq",
        summary=SUMMARY,
        description=DESCRIPTION,
        openapi_tags=subjects(),
        generate_unique_id_function=operation_id,
        version=__version__,
        openapi_url=None,  # routes/description.py: FastAPI would make the document while everybody waits
        docs_url=None,
        redoc_url=None,
        lifespan=_lifespan,
        telemetry={"tracing": False},
        separate_input_output_schemas=False,
    )
    app.state.service = service
    app.include_router(_api(), prefix=PREFIX)
    app.include_router(pages.router)  # last: it takes every address that is left
    problems.install(app)
    _add_layers(app, service)
    return app


def _add_layers(app: FastAPI, service: Service) -> None:
    """What every request passes, from the inside to the outside."""
    settings = service.settings
    app.add_middleware(GZipMiddleware, minimum_size=1000, compresslevel=5)
    app.add_middleware(TrustedHosts, names=settings.allowed_hosts)
    if settings.cors_origins:
        app.add_middleware(CORSMiddleware, allow_origins=settings.cors_origins, **CROSS_ORIGIN)
    app.add_middleware(Heads)
    app.add_middleware(SecurityHeaders, frame_ancestors=settings.frame_ancestors)
    app.add_middleware(Clients, ledger=make_ledger(settings), proxies=Proxies.of(settings.trusted_proxies))
    app.add_middleware(Access, metrics=service.metrics)


def _api() -> APIRouter:
    """All routers that stand in `routes/`, but the pages."""
    api = APIRouter()
    for module in modules_of("deltaq.api.routes"):
        if module is not pages and hasattr(module, "router"):
            api.include_router(module.router)
    return api


@asynccontextmanager
async def _lifespan(app: FastAPI) -> AsyncIterator[None]:
    service: Service = app.state.service
    for pool in (service.pool, service.laboratory):
        pool.start()
    spare = max(1, service.settings.workers - 1)  # one worker at least answers meanwhile
    compiling = asyncio.create_task(service.kernels.compile(service.pool, service.laboratory, spare))
    try:
        yield
    finally:
        compiling.cancel()
        with suppress(asyncio.CancelledError):
            await compiling
        for pool in (service.laboratory, service.pool):
            await asyncio.to_thread(pool.stop)
