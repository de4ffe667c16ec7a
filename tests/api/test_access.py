"""Request identifiers and the line that each request leaves in the log."""

from __future__ import annotations

import json
import logging
import re

import httpx
import pytest

from deltaq.api.logs import Line

pytestmark = pytest.mark.anyio
SCENES = "/api/v1/scenes"


async def test_each_request_has_an_identifier_of_its_own(client: httpx.AsyncClient) -> None:
    one, other = [(await client.get(SCENES)).headers["x-request-id"] for _ in range(2)]
    assert re.fullmatch("[0-9a-f]{32}", one)
    assert one != other


@pytest.mark.parametrize(
    ("given", "kept"),
    [
        pytest.param("proxy-17.a_B", True, id="of a proxy"),
        pytest.param("x" * 65, False, id="too long"),
        pytest.param('a"b', False, id="quotes"),
        pytest.param("", False, id="empty"),
    ],
)
async def test_identifier_of_a_proxy(client: httpx.AsyncClient, given: str, kept: bool) -> None:
    response = await client.get(SCENES, headers={"X-Request-ID": given})
    assert (response.headers["x-request-id"] == given) is kept


async def test_files_of_the_page_carry_no_identifier(client: httpx.AsyncClient) -> None:
    assert "x-request-id" not in (await client.get("/app.js")).headers


@pytest.mark.parametrize(
    ("method", "path", "facts"),
    [
        pytest.param(
            "GET",
            f"{SCENES}/pendulum?n=3",
            {"method": "GET", "route": "/scenes/{identifier}", "status": "200"},
            id="pattern of the address",
        ),
        pytest.param(
            "GET",
            "/secret/name",
            {"method": "GET", "route": "/{path:path}", "status": "404"},
            id="no such address",
        ),
        pytest.param(
            "SECRET",
            SCENES,
            {"method": "other", "route": "/scenes", "status": "405"},
            id="a method that there is not",
        ),
        pytest.param(
            "GET",
            "/api/v1/openapi.json",
            {"method": "GET", "route": "/openapi.json", "status": "200"},
            id="the description of the API",
        ),
    ],
)
async def test_line_tells_the_pattern_and_nothing_that_the_user_wrote(
    client: httpx.AsyncClient, caplog: pytest.LogCaptureFixture, method: str, path: str, facts: dict[str, str]
) -> None:
    with caplog.at_level(logging.INFO, "deltaq.access"):
        await client.request(method, path, headers={"X-Request-ID": "one"})
    (record,) = [one for one in caplog.records if one.name == "deltaq.access"]
    line = json.loads(Line().format(record))
    assert {key: line[key] for key in facts} == facts
    assert line.keys() == {"time", "level", "logger", "message", "bytes", "ms", *facts}
    assert "secret" not in str(line).lower()
