"""Whatever text stands wherever a text may stand: an answer of the service, and no trace of the text but in it."""

from __future__ import annotations

from pathlib import Path

import httpx
import pytest
from fastapi import FastAPI
from tests.api.hostile import LINES, Walk, ask, judged

pytestmark = [pytest.mark.anyio, pytest.mark.usefixtures("laboratory")]
STEP = 37  # from one text to the next; all of them in the long run


async def test_every_string_of_every_call(
    app: FastAPI, client: httpx.AsyncClient, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    # A scene is read by the same code in every call; here it is looked into once.
    slots = [slot for slot in Walk(app.openapi()).slots() if "/scene/" not in slot.where]
    assert len(slots) > 200
    found = []
    for number, slot in enumerate(slots):
        text = LINES[number * STEP % len(LINES)]
        if wrong := judged(await ask(client.request, slot, text), text):
            found.append(f"{slot}: {text!r} {wrong}")
    assert found == []
