"""Who asks, and who pays for the answer."""

from __future__ import annotations

import re
from collections.abc import Iterator
from ipaddress import ip_address, ip_network
from pathlib import Path
from typing import Any

import httpx
import pytest
from fastapi import FastAPI

from deltaq.api.app import create_app
from deltaq.api.clients import UNKNOWN, Proxies, client_of, scheme_of
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
        pytest.param(None, UNKNOWN, id="a socket of the file system"),
        pytest.param(("", 0), UNKNOWN, id="no address"),
        pytest.param(("proxy", 0), UNKNOWN, id="a name"),
    ],
)
async def test_client(address: Any, client: str) -> None:
    assert client_of({"type": "http", "client": address, "headers": []}, NEAR) == client


NEAR = Proxies.of(("127.0.0.1", "::1"))
FAR = Proxies.of(("172.31.250.2", "10.9.0.0/24"))


def asked(peer: str, proxies: Proxies, *forwarded: str, header: str = "X-Forwarded-For") -> str:
    """Whose request it is that comes from `peer` with these headers."""
    headers = [(header.lower().encode(), one.encode()) for one in forwarded]
    return client_of({"type": "http", "client": (peer, 1), "headers": headers}, proxies)


@pytest.mark.parametrize(
    ("peer", "forwarded", "client"),
    [
        pytest.param("172.31.250.2", ["192.0.2.7"], "192.0.2.7", id="by the proxy"),
        pytest.param("172.31.250.2", ["192.0.2.7:4711"], "192.0.2.7", id="with a port"),
        pytest.param("172.31.250.2", ["[2001:db8::5]:80"], "2001:0db8:0000:0000::/64", id="version 6 with a port"),
        pytest.param("172.31.250.2", ["203.0.113.9, 10.1.2.3"], "10.1.2.3", id="a private address forges another"),
        pytest.param("172.31.250.2", ["203.0.113.9", "10.1.2.3"], "10.1.2.3", id="in a header of its own"),
        pytest.param("172.31.250.2", ["127.0.0.1, 192.168.0.4"], "192.168.0.4", id="or loopback"),
        pytest.param("172.31.250.2", ["203.0.113.9, 10.1.2.3, 10.9.0.7"], "10.1.2.3", id="through two proxies of ours"),
        pytest.param("172.31.250.2", [], "172.31.250.2", id="a proxy that does not say"),
        pytest.param("10.1.2.3", ["203.0.113.9"], "10.1.2.3", id="no proxy of ours"),
        pytest.param("172.31.250.3", ["127.0.0.1"], "172.31.250.3", id="its neighbour"),
        pytest.param("172.31.250.2", ["127.0.0.1"], UNKNOWN, id="forwarded loopback"),
        pytest.param("172.31.250.2", ["::ffff:127.0.0.1"], UNKNOWN, id="forwarded loopback in version 6"),
        pytest.param("172.31.250.2", ["unknown"], UNKNOWN, id="unreadable"),
        pytest.param("172.31.250.2", ["192.0.2.7, x"], UNKNOWN, id="unreadable behind a readable one"),
        pytest.param("172.31.250.2", [""], UNKNOWN, id="empty"),
        pytest.param("172.31.250.2", ["10.9.0.7"], UNKNOWN, id="nobody but proxies"),
        pytest.param("127.0.0.1", ["192.0.2.7"], UNKNOWN, id="a proxy on the machine that nobody named"),
    ],
)
async def test_client_behind_a_proxy(peer: str, forwarded: list[str], client: str) -> None:
    assert asked(peer, FAR, *forwarded) == client


@pytest.mark.parametrize("header", ["X-Forwarded-For", "X-Real-IP", "Forwarded", "Via"])
async def test_nobody_is_at_the_machine_who_comes_through_a_proxy(header: str) -> None:
    for claimed in ("127.0.0.1", "::1", "", "for=127.0.0.1", "1.1 proxy", "\x00"):
        assert asked("127.0.0.1", NEAR, claimed, header=header) == UNKNOWN


async def test_the_scheme_is_the_one_that_the_proxy_was_asked_by() -> None:
    for peer, told, scheme in (
        ("127.0.0.1", "https", "https"),
        ("10.0.0.1", "https", "http"),
        ("::1", "gopher", "http"),
    ):
        scope = {
            "client": (peer, 1),
            "headers": [(b"x-forwarded-proto", told.encode())],
            "scheme": "http",
            "type": "http",
        }
        assert scheme_of(scope, NEAR) == scheme


def test_the_shipped_proxy_is_the_only_one_believed(root: Path) -> None:
    """One address, that of the proxy; and the proxy writes the address that it sees, alone."""
    compose = (root / "backend/deploy/compose.yaml").read_text(encoding="utf-8")
    (named,) = re.findall(r"DELTAQ_TRUSTED_PROXIES: ([^\s#]+)", compose)
    (given,) = re.findall(r"ipv4_address: ([\d.]+)", compose)
    (others,) = re.findall(r"ip_range: ([\d./]+)", compose)
    assert named == given
    assert ip_address(named) not in ip_network(others)
    nginx = (root / "backend/deploy/nginx.conf").read_text(encoding="utf-8")
    assert re.findall(r"X-Forwarded-For ([^;]+);", nginx) == ["$remote_addr"]


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


async def test_a_forwarded_loopback_pays(strict_app: FastAPI) -> None:
    async with client_at(strict_app, "127.0.0.1") as proxy:
        told = {"X-Forwarded-For": "127.0.0.1"}
        answers = [await proxy.post(VARIATIONS, json=question(power), headers=told) for power in (7, 8)]
    assert [answer.status_code for answer in answers] == [200, 429]
