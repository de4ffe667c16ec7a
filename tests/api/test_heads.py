"""How long addresses and headers may be."""

from __future__ import annotations

import httpx
import pytest

pytestmark = pytest.mark.anyio
SCENES = "/api/v1/scenes"


@pytest.mark.parametrize(
    ("address", "headers", "status"),
    [
        pytest.param(SCENES, {"X-A": "x" * 32000}, 200, id="long header"),
        pytest.param(SCENES, {"X-A": "x" * 33000}, 431, id="header that is too long"),
        pytest.param(SCENES, {f"X-{number}": "x" * 20 for number in range(2000)}, 431, id="too many headers"),
        pytest.param(f"{SCENES}?x={'x' * 32000}", {}, 200, id="long address"),
        pytest.param(f"{SCENES}?x={'x' * 33000}", {}, 431, id="address that is too long"),
        pytest.param(f"/{'x' * 33000}", {}, 431, id="path that is too long"),
        pytest.param(f"/{'x' * 300}", {}, 404, id="no name of a page, for files have shorter ones"),
        pytest.param(f"/{'x' * 300}.js", {}, 404, id="no name of a file"),
        pytest.param(f"/{'x/' * 3000}y.js", {}, 404, id="no name of a folder"),
    ],
)
async def test_head(client: httpx.AsyncClient, address: str, headers: dict[str, str], status: int) -> None:
    assert (await client.get(address, headers=headers)).status_code == status


async def test_what_may_be_done_about_a_head_that_is_too_long(client: httpx.AsyncClient) -> None:
    response = await client.get(SCENES, headers={"X-A": "x" * 33000, "Accept-Language": "en"})
    assert response.json() == {
        "type": "/problems/head-too-large",
        "title": "The head of the request is too long",
        "status": 431,
        "detail": "Address and headers may have 32768 bytes together. "
        "What is longer belongs into the body of the request.",
        "problems": [],
    }
