"""Whatever the cache is asked for is asked for by the code that answers: another version has other answers."""

from __future__ import annotations

from typing import Any

import httpx
import pytest
from tests.api.test_examples import bodies, names

from deltaq.api import service as service_module
from deltaq.api.app import create_app
from deltaq.api.cache import Cache
from deltaq.api.packing import pack
from deltaq.api.service import Service
from deltaq.settings import Settings

pytestmark = pytest.mark.anyio
ANSWER = b'{"name": "file", "text": ""}'
# Each time, nothing is kept; of a table of answers its rows are, once it has been read, which is not done here.
COMPUTED = {"/api/v1/tasks/stack", "/api/v1/scenes/validate", "/api/v1/scenes/toml", "/api/v1/checks/table"}


async def keys(monkeypatch: pytest.MonkeyPatch, digest: str) -> dict[str, list[str]]:
    """By address, the keys that the examples of the API ask the cache for, if the code has this digest."""
    asked: list[str] = []

    async def found(_cache: Cache, key: str, *_: object) -> bytes:
        asked.append(key)
        return pack(ANSWER)

    async def computed(*_: object) -> bytes:
        return ANSWER

    for name in ("get", "renew", "find"):
        monkeypatch.setattr(Cache, name, found)
    monkeypatch.setattr(Service, "run", computed)
    monkeypatch.setattr(service_module, "source_digest", lambda: digest)
    transport = httpx.ASGITransport(app=create_app(Settings()), raise_app_exceptions=False)
    by_address: dict[str, list[str]] = {}
    async with httpx.AsyncClient(transport=transport, base_url="http://deltaq.test") as client:
        for address, media_type, body in (example.values for example in bodies()):
            asked.clear()
            sent: dict[str, Any] = {"content": body} if isinstance(body, str) else {"json": body}
            await client.post(str(address), headers={"content-type": str(media_type)}, **sent)
            by_address.setdefault(str(address), []).extend(asked)
        for (address,) in (example.values for example in names()):
            asked.clear()
            await client.get(str(address))
            by_address |= {str(address): list(asked)} if asked else {}
    return by_address


async def test_no_answer_of_another_version_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of no call and of no kind of answer, whichever way its key is made."""
    before, same, after = [await keys(monkeypatch, digest) for digest in ("one", "one", "another")]
    assert before == same
    assert {address for address, asked in before.items() if not asked} == COMPUTED
    assert {address for address, asked in before.items() if set(asked) & set(after[address])} == set()
