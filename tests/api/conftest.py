"""The application under test, with real workers, and a client without a network between."""

from __future__ import annotations

from collections.abc import AsyncIterator, Iterator

import httpx
import pytest
from fastapi import FastAPI

from deltaq.api.app import create_app
from deltaq.api.workers.worker import start_fork_server
from deltaq.settings import Settings


@pytest.fixture(scope="session")
def anyio_backend() -> str:
    return "asyncio"


@pytest.fixture(scope="session", autouse=True)
def _fork_server() -> None:
    """The one of the service, whichever test is the first to need a worker: only the first decides what it loads."""
    start_fork_server()


@pytest.fixture(scope="session")
def app() -> Iterator[FastAPI]:
    settings = Settings(workers=2, derivation_deadline=60.0, simulation_deadline=120.0, queue_patience=120.0)
    application = create_app(settings)
    pool = application.state.service.pool
    pool.start()
    yield application
    pool.stop()


@pytest.fixture(scope="session")
def laboratory(app: FastAPI) -> Iterator[None]:
    """Experiments can be run; a pool is started once."""
    pool = app.state.service.laboratory
    pool.start()
    yield
    pool.stop(0.1)


@pytest.fixture
async def client(app: FastAPI) -> AsyncIterator[httpx.AsyncClient]:
    transport = httpx.ASGITransport(app=app, raise_app_exceptions=False)
    async with httpx.AsyncClient(transport=transport, base_url="http://deltaq.test", timeout=150) as one:
        yield one
