"""Who may call the API from another page, and show the page in a frame: nobody, unless the settings say so."""

from __future__ import annotations

from collections.abc import AsyncIterator

import httpx
import pytest

from deltaq.api.app import create_app
from deltaq.settings import Settings

pytestmark = pytest.mark.anyio
COURSE = "https://moodle.example.org"
ASKS = {"Origin": COURSE, "Access-Control-Request-Method": "POST", "Access-Control-Request-Headers": "content-type"}


@pytest.fixture
async def open_client() -> AsyncIterator[httpx.AsyncClient]:
    settings = Settings(workers=1, cors_origins=(COURSE,), frame_ancestors=(COURSE,))
    transport = httpx.ASGITransport(app=create_app(settings))
    async with httpx.AsyncClient(transport=transport, base_url="http://deltaq.test") as client:
        yield client


@pytest.mark.parametrize("method", ["GET", "OPTIONS"])
async def test_closed_by_default(client: httpx.AsyncClient, method: str) -> None:
    response = await client.request(method, "/api/v1/scenes", headers=ASKS)
    assert [name for name in response.headers if name.startswith("access-control")] == []


async def test_preflight_of_an_origin_that_is_let_in(open_client: httpx.AsyncClient) -> None:
    headers = (await open_client.options("/api/v1/derivations", headers=ASKS)).headers
    assert headers["access-control-allow-origin"] == COURSE
    assert headers["access-control-allow-methods"] == "GET, POST"
    assert "content-type" in headers["access-control-allow-headers"].lower()
    assert "access-control-allow-credentials" not in headers


async def test_answer_to_an_origin_that_is_let_in(open_client: httpx.AsyncClient) -> None:
    headers = (await open_client.get("/api/v1/scenes", headers={"Origin": COURSE})).headers
    assert headers["access-control-allow-origin"] == COURSE
    assert "Retry-After" in headers["access-control-expose-headers"]


async def test_other_origins_stay_out(open_client: httpx.AsyncClient) -> None:
    response = await open_client.options("/api/v1/derivations", headers=ASKS | {"Origin": "https://other.example"})
    assert response.status_code == 400
    assert "access-control-allow-origin" not in response.headers


async def test_failures_too_can_be_read_by_an_origin_that_is_let_in(open_client: httpx.AsyncClient) -> None:
    response = await open_client.post("/api/v1/derivations", json={}, headers={"Origin": COURSE})
    assert (response.status_code, response.headers["access-control-allow-origin"]) == (422, COURSE)


@pytest.mark.parametrize("path", ["/", "/docs", "/icon.svg"])
async def test_frames_of_a_course(open_client: httpx.AsyncClient, path: str) -> None:
    policy = (await open_client.get(path)).headers["content-security-policy"]
    assert policy.endswith(f"; frame-ancestors 'self' {COURSE}")
