"""What the description of the API shows as examples can be sent, and is answered."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import httpx
import pytest
from tests.description import openapi

pytestmark = [pytest.mark.anyio, pytest.mark.usefixtures("laboratory")]


DOCUMENT = openapi()


def _schema(content: dict[str, Any]) -> dict[str, Any]:
    schema: dict[str, Any] = content["schema"]
    name = schema.get("$ref", "").rpartition("/")[2]
    return DOCUMENT["components"]["schemas"][name] if name else schema


def bodies() -> Iterator[Any]:
    """Address, media type and body of each example; a call without one is there with None."""
    for path, methods in DOCUMENT["paths"].items():
        if "post" not in methods:
            continue
        address = path.replace("{form}", "python")
        for media_type, content in methods["post"]["requestBody"]["content"].items():
            shown = _schema(content).get("examples", [None])
            for i, body in enumerate(shown):
                yield pytest.param(address, media_type, body, id=f"{path} {media_type} {i}")


@pytest.mark.one_in(2)
@pytest.mark.parametrize(("address", "media_type", "body"), [*bodies()])
async def test_each_body_is_answered(client: httpx.AsyncClient, address: str, media_type: str, body: Any) -> None:
    sent = {"content": body, "headers": {"content-type": media_type}} if isinstance(body, str) else {"json": body}
    assert body is not None
    answer = await client.post(address, **sent)
    assert answer.status_code == 200, answer.text


def names() -> Iterator[Any]:
    """Addresses that hold names, with their examples; a derivation has its id from a call before."""
    for path, methods in DOCUMENT["paths"].items():
        given = [one for one in methods.get("get", {}).get("parameters", []) if one["in"] == "path"]
        if given and not path.startswith("/api/v1/derivations"):
            yield pytest.param(path.format(**{one["name"]: one["schema"]["examples"][0] for one in given}), id=path)


@pytest.mark.parametrize("address", [*names()])
async def test_each_name_is_known(client: httpx.AsyncClient, address: str) -> None:
    assert (await client.get(address)).status_code == 200
