"""Whatever can be got has a head: the same status and fields, and no body."""

from __future__ import annotations

import http.client
import json
from collections.abc import Iterator
from typing import Any
from urllib.parse import urlsplit

import pytest
from tests.description import openapi
from tests.serving import PATIENCE

CHANGING = {"date", "x-request-id", "server-timing"}
COUNTING = ("/api/v1/metrics", "/api/v1/health")  # each answer counts the one before
DOCUMENT = openapi()


def addresses() -> Iterator[str]:
    """Every address that the description says can be got, with the examples of the names in it."""
    for path, methods in DOCUMENT["paths"].items():
        given = [one for one in methods.get("get", {}).get("parameters", []) if one["in"] == "path"]
        if "get" in methods:
            yield path.format(**{one["name"]: (one["schema"].get("examples") or ["none"])[0] for one in given})


@pytest.fixture(scope="module")
def service(server: str) -> str:
    return urlsplit(server).netloc


def asked(service: str, method: str, address: str) -> tuple[int, dict[str, str], bytes]:
    connection = http.client.HTTPConnection(service, timeout=PATIENCE)
    connection.request(method, address)
    answer = connection.getresponse()
    fields: dict[str, Any] = {name.lower(): value for name, value in answer.getheaders()}
    body = answer.read()
    connection.close()
    return answer.status, {name: value for name, value in fields.items() if name not in CHANGING}, body


@pytest.mark.one_in(3)
@pytest.mark.parametrize("address", [*addresses(), "/", "/scene", "/no-such-page", "/api/v1/scenes/no-such-scene"])
def test_head_is_get_without_a_body(service: str, address: str) -> None:
    status, fields, _ = asked(service, "GET", address)
    told = asked(service, "HEAD", address)
    if address in COUNTING:
        fields["content-length"] = told[1]["content-length"]
    assert told == (status, fields, b"")


@pytest.mark.parametrize("path", [*DOCUMENT["paths"], "/"])
def test_what_is_not_allowed_is_told_all_that_is(service: str, path: str) -> None:
    known = {method.upper() for method in DOCUMENT["paths"].get(path, {"get": {}})}
    allowed = sorted(known | ({"HEAD"} if "GET" in known else set()))
    status, fields, body = asked(service, "PUT", path)
    assert (status, fields["allow"].split(", ")) == (405, allowed)
    assert fields["allow"] in json.loads(body)["detail"]


def test_where_nothing_can_be_got_there_is_no_head(service: str) -> None:
    status, _, _ = asked(service, "HEAD", "/api/v1/simulations")
    assert status == 405
