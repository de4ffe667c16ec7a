"""The lectures that are ready to be given: every stop leads to something, in both languages to the same."""

from __future__ import annotations

import json
from importlib.resources import files
from urllib.parse import parse_qs, urlsplit

import httpx
import pytest
from tests.lecture.answers import steps

from deltaq.api.app import create_app
from deltaq.narration.vary import vary_request
from deltaq.settings import Settings

FOLDER = files("deltaq") / "lectures"
SHIPPED = {file.name: json.loads(file.read_text(encoding="utf-8")) for file in FOLDER.iterdir() if ".json" in file.name}
STOPS = [
    pytest.param(stop["place"], id=f"{name} {number}")
    for name, lecture in sorted(SHIPPED.items())
    for number, stop in enumerate(lecture["stops"], 1)
]


@pytest.mark.parametrize("place", STOPS)
def test_a_stop_leads_to_a_step_that_there_is(place: str) -> None:
    address = urlsplit(place)
    asked = {name: value for name, (value, *_) in parse_qs(address.query).items()}
    if address.path == "variations":
        functional = {"kind": asked["kind"], "at": asked["at"]}
        parameters = [{"name": asked["parameters"]}]
        question = {"expression": asked["expression"], "functions": ["x"], "direction": [asked["direction"]]}
        assert vary_request(question | {"functional": functional, "parameters": parameters})["chapters"]
    else:
        assert address.path in {"scene", "proof"}
        assert asked["step"] in steps(asked.get("scene", "proof"))


def test_both_languages_lead_the_same_way() -> None:
    german, english = SHIPPED["seed.de.json"]["stops"], SHIPPED["seed.en.json"]["stops"]
    assert len(german) == 18
    assert [stop["place"] for stop in german] == [stop["place"] for stop in english]
    assert [stop.get("poll", {}).get("right") for stop in german] == [
        stop.get("poll", {}).get("right") for stop in english
    ]
    assert sum("poll" in stop for stop in german) == 3
    assert all(stop["notes"] for stop in german + english)


@pytest.mark.anyio
async def test_the_service_gives_them_and_nothing_else() -> None:
    transport = httpx.ASGITransport(app=create_app(Settings(workers=1)))
    async with httpx.AsyncClient(transport=transport, base_url="http://deltaq.test") as client:
        answer = await client.get("/lectures/seed.de.json")
        assert (answer.status_code, answer.json()) == (200, SHIPPED["seed.de.json"])
        assert answer.headers["content-type"] == "application/json"
        again = await client.get("/lectures/seed.de.json", headers={"If-None-Match": answer.headers["etag"]})
        assert again.status_code == 304
        assert (await client.head("/lectures/seed.en.json")).status_code == 200
        for absent in ("seed.fr", "..%2F__init__", "__init__.py%00"):
            assert (await client.get(f"/lectures/{absent}.json")).status_code == 404
