"""Names under which the service answers."""

from __future__ import annotations

import httpx
import pytest

from deltaq.api.app import create_app
from deltaq.api.hosts import is_trusted
from deltaq.settings import Settings

pytestmark = pytest.mark.anyio


@pytest.mark.parametrize(
    ("host", "trusted"),
    [
        pytest.param("dq.example.org", True, id="the name"),
        pytest.param("DQ.example.ORG:8000", True, id="with port, in capitals"),
        pytest.param("a.lab.example.org", True, id="subdomain"),
        pytest.param("lab.example.org", False, id="domain of the subdomains itself"),
        pytest.param("localhost:8000", True, id="loopback"),
        pytest.param("127.0.0.1", True, id="loopback by number"),
        pytest.param("[::1]:8000", True, id="loopback, version 6"),
        pytest.param("attacker.example", False, id="another name"),
        pytest.param("dq.example.org.attacker.example", False, id="name as a beginning"),
        pytest.param("attackerdq.example.org", False, id="name as an end"),
        pytest.param("dq.example.org@attacker.example", False, id="name as a user"),
        pytest.param("[::1", False, id="half a bracket"),
        pytest.param("", False, id="no name"),
    ],
)
async def test_trusted_names(host: str, trusted: bool) -> None:
    assert is_trusted(host, ("dq.example.org", "*.lab.example.org")) is trusted


async def test_other_names_are_refused_with_a_problem() -> None:
    transport = httpx.ASGITransport(app=create_app(Settings(workers=1, allowed_hosts=("dq.example.org",))))
    async with httpx.AsyncClient(transport=transport, base_url="http://attacker.example") as client:
        response = await client.get("/api/v1/scenes", headers={"Accept-Language": "de"})
        good = await client.get("/api/v1/scenes", headers={"Host": "dq.example.org"})
    assert good.status_code == 200
    assert response.status_code == 421
    assert response.json() == {
        "type": "/problems/unknown-host",
        "title": "Unter diesem Namen antwortet der Dienst nicht",
        "status": 421,
        "detail": "Anfragen müssen einem Namen gelten, den die Einstellung DELTAQ_ALLOWED_HOSTS nennt.",
        "problems": [],
    }
