"""Who asks, and who pays for the answer."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import httpx
import pytest
from fastapi import FastAPI

from deltaq.api.app import create_app
from deltaq.api.clients import client_of
from deltaq.settings import Settings

pytestmark = pytest.mark.anyio
VARIATIONS = "/api/v1/variations"


@pytest.mark.parametrize(
    ("address", "client"),
    [
        pytest.param(("192.0.2.7", 1234), "192.0.2.7", id="version 4"),
        pytest.param(("::ffff:192.0.2.7", 1234), "192.0.2.7", id="version 4 in version 6"),
        pytest.param(("2001:db8:1:2:3:4:5:6", 1), "2001:0db8:0001:0002::/64", id="network of version 6"),
        pytest.param(("127.0.0.1", 1234), "", id="loopback"),
        pytest.param(("::1", 1234), "", id="loopback of version 6"),
        pytest.param(("::ffff:127.0.0.1", 1), "", id="loopback in version 6"),
        pytest.param(None, "", id="a socket of the file system"),
        pytest.param(("", 0), "", id="no address"),
    ],
)
async def test_client(address: Any, client: str) -> None:
    assert client_of({"type": "http", "client": address}) == client


@pytest.fixture(scope="module")
def strict_app() -> Iterator[FastAPI]:
    """Any computation uses up a client's share for long."""
    app = create_app(Settings(workers=1, client_share=1e-6, client_credit=1e-6))
    app.state.service.pool.start()
    yield app
    app.state.service.pool.stop()


def client_at(app: FastAPI, address: str) -> httpx.AsyncClient:
    transport = httpx.ASGITransport(app=app, client=(address, 1234), raise_app_exceptions=False)
    return httpx.AsyncClient(transport=transport, base_url="http://deltaq.test", timeout=150)


def question(power: int) -> dict[str, Any]:
    return {"expression": f"x^{power}", "functions": ["x"]}


async def test_share_is_of_computing_time_not_of_requests(strict_app: FastAPI) -> None:
    async with client_at(strict_app, "192.0.2.1") as greedy, client_at(strict_app, "192.0.2.2") as other:
        assert (await greedy.post(VARIATIONS, json=question(2))).status_code == 200
        refused = await greedy.post(VARIATIONS, json=question(3))
        assert (refused.status_code, refused.json()["type"]) == (429, "/problems/quota-exceeded")
        assert int(refused.headers["retry-after"]) > 2
        assert (await greedy.post(VARIATIONS, json=question(2))).status_code == 200  # is there already
        assert (await greedy.get("/api/v1/scenes")).status_code == 200
        assert (await other.post(VARIATIONS, json=question(3))).status_code == 200


async def test_loopback_is_free(strict_app: FastAPI) -> None:
    async with client_at(strict_app, "127.0.0.1") as local:
        answers = [await local.post(VARIATIONS, json=question(power)) for power in (4, 5, 6)]
    assert [answer.status_code for answer in answers] == [200, 200, 200]
