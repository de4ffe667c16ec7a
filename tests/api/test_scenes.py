from __future__ import annotations

import json
from typing import Any

import httpx
import pytest

from deltaq.contract.document import EXAMPLE
from deltaq.mechanics.library import load_scene, scene_ids

pytestmark = pytest.mark.anyio
SCENES = "/api/v1/scenes"


async def test_member_of_a_family(client: httpx.AsyncClient) -> None:
    entries = {entry["id"]: entry for entry in (await client.get("/api/v1/scenes")).json()["scenes"]}
    assert entries["chain-pendulum"]["family"] == {"parameter": "n", "min": 1, "max": 12, "value": 4}
    assert "family" not in entries["pendulum"]
    usual, six = [(await client.get(f"/api/v1/scenes/chain-pendulum{query}")).json() for query in ("", "?n=6")]
    assert [len(scene["bodies"]) for scene in (usual, six)] == [4, 6]


@pytest.mark.parametrize(("n", "code"), [("13", "family-size"), ("-1", "family-size"), ("many", "request-not-integer")])
async def test_member_that_a_family_does_not_have(client: httpx.AsyncClient, n: str, code: str) -> None:
    response = await client.get(f"/api/v1/scenes/chain-pendulum?n={n}")
    assert response.status_code == 422
    assert [problem["code"] for problem in response.json()["problems"]] == [code]


async def test_list_has_every_scene_file(client: httpx.AsyncClient) -> None:
    response = await client.get(SCENES)
    assert response.status_code == 200
    entries = response.json()["scenes"]
    assert [entry["id"] for entry in entries] == list(scene_ids())
    for entry in entries:
        assert entry.keys() - {"family"} == {"id", "title", "summary", "degrees_of_freedom"}
        assert entry["title"].keys() == entry["summary"].keys() == {"de", "en"}
        assert entry["degrees_of_freedom"] == load_scene(entry["id"]).degrees_of_freedom


async def test_list_without_summaries(client: httpx.AsyncClient) -> None:
    entries = (await client.get(f"{SCENES}?summaries=false")).json()["scenes"]
    assert [entry["id"] for entry in entries] == list(scene_ids())
    assert all(entry.keys() - {"family"} == {"id", "title", "degrees_of_freedom"} for entry in entries)


@pytest.mark.parametrize("identifier", scene_ids())
async def test_scene_document_is_a_valid_scene_again(client: httpx.AsyncClient, identifier: str) -> None:
    document = (await client.get(f"{SCENES}/{identifier}")).json()
    assert document["id"] == identifier
    assert document["format"] == 1
    verdict = await client.post(f"{SCENES}/validate", json=document)
    assert verdict.json() == {"valid": True, "problems": []}


async def test_unknown_scene(client: httpx.AsyncClient) -> None:
    response = await client.get(f"{SCENES}/pendulun", headers={"Accept-Language": "en"})
    assert response.status_code == 404
    assert response.headers["content-type"] == "application/problem+json"
    message = f"There is no scene “pendulun”. Did you mean “pendulum”? There are: {', '.join(scene_ids())}."
    assert response.json() == {
        "type": "/problems/unknown-name",
        "title": "There is nothing of this name",
        "status": 404,
        "detail": message,
        "problems": [
            {
                "pointer": "",
                "offset": None,
                "length": None,
                "code": "unknown-scene",
                "severity": "error",
                "message": message,
            }
        ],
    }


def without(*path: str | int) -> dict[str, Any]:
    """The example scene with the field at `path` taken out."""
    document = json.loads(json.dumps(EXAMPLE))
    place = document
    for part in path[:-1]:
        place = place[part]
    del place[path[-1]]
    return document


def changed(value: Any, *path: str | int) -> dict[str, Any]:
    """The example scene with another value at `path`."""
    document = json.loads(json.dumps(EXAMPLE))
    place = document
    for part in path[:-1]:
        place = place[part]
    place[path[-1]] = value
    return document


async def test_example_of_the_documentation_is_valid(client: httpx.AsyncClient) -> None:
    response = await client.post(f"{SCENES}/validate", json=EXAMPLE)
    assert response.json() == {"valid": True, "problems": []}


@pytest.mark.parametrize(
    ("document", "pointer", "code", "offset"),
    [
        pytest.param(without("bodies"), "/bodies", "no-body", None, id="no body"),
        pytest.param(without("bodies", 0, "mass"), "/bodies/0/mass", "missing-field", None, id="no mass"),
        pytest.param(changed(3, "bodies", 0, "colour"), "/bodies/0/colour", "unknown-field", None, id="unknown field"),
        pytest.param(changed("l*sin(phi", "bodies", 0, "position", 0), "/bodies/0/position/0", None, 5, id="syntax"),
        pytest.param(changed("2*mas", "bodies", 0, "mass"), "/bodies/0/mass", None, 2, id="unknown name"),
        pytest.param({}, "/coordinates", "no-coordinate", None, id="empty"),
    ],
)
async def test_invalid_scene_says_where(
    client: httpx.AsyncClient, document: dict[str, Any], pointer: str, code: str | None, offset: int | None
) -> None:
    response = await client.post(f"{SCENES}/validate", json=document)
    assert response.status_code == 200
    answer = response.json()
    assert answer["valid"] is False
    found = [one for one in answer["problems"] if one["pointer"] == pointer]
    assert found, answer["problems"]
    assert found[0].keys() == {"pointer", "offset", "length", "code", "severity", "message"}
    assert found[0]["offset"] == offset
    assert code in {None, found[0]["code"]}


@pytest.mark.parametrize(
    ("language", "message"),
    [
        pytest.param("en", "The field mass is missing.", id="English"),
        pytest.param("de", "Das Feld mass fehlt.", id="German"),
    ],
)
async def test_problems_of_a_scene_are_told_in_the_language_asked_for(
    client: httpx.AsyncClient, language: str, message: str
) -> None:
    headers = {"Accept-Language": language}
    response = await client.post(f"{SCENES}/validate", json=without("bodies", 0, "mass"), headers=headers)
    assert response.json()["problems"][0]["message"] == message


async def test_scene_must_be_an_object(client: httpx.AsyncClient) -> None:
    response = await client.post(f"{SCENES}/validate", json=[1, 2])
    assert response.status_code == 422
    assert response.json()["problems"] == [
        {
            "pointer": "",
            "offset": None,
            "length": None,
            "code": "request-not-object",
            "severity": "error",
            "message": "A JSON object is needed here.",
        }
    ]


async def test_known_list_is_not_sent_again(client: httpx.AsyncClient) -> None:
    first = await client.get(SCENES)
    again = await client.get(SCENES, headers={"If-None-Match": f'W/{first.headers["etag"]}, "other"'})
    assert (again.status_code, again.content) == (304, b"")
    other = await client.get(SCENES, headers={"If-None-Match": '"other"'})
    assert other.json() == first.json()


async def test_warnings_do_not_make_a_scene_invalid(client: httpx.AsyncClient) -> None:
    scene = {**EXAMPLE, "parameters": [*EXAMPLE["parameters"], {"name": "k"}]}
    response = await client.post("/api/v1/scenes/validate", json=scene)
    answer = response.json()
    assert answer["valid"] is True
    assert answer["problems"] == [
        {
            "pointer": "/parameters/3",
            "offset": None,
            "length": None,
            "code": "unused-parameter",
            "severity": "warning",
            "message": "The parameter k is not used.",
        }
    ]


async def test_scene_in_toml(client: httpx.AsyncClient) -> None:
    text = 'format = 1\nid = "größe"\n[[points]]\nname = "A"\nposition = ["0", "1"]\n'
    response = await client.post("/api/v1/scenes/toml", content=text, headers={"content-type": "application/toml"})
    assert response.status_code == 200, response.text
    scene = {"format": 1, "id": "größe", "points": [{"name": "A", "position": ["0", "1"]}]}
    assert response.json() == {"scene": scene}


@pytest.mark.parametrize("kind", ["text/plain", "application/x-www-form-urlencoded", "multipart/form-data", None])
async def test_toml_is_not_taken_from_a_page_that_may_not_call(client: httpx.AsyncClient, kind: str | None) -> None:
    """These kinds a browser sends for any page without asking whether it may."""
    headers = {"content-type": kind} if kind else {}
    response = await client.post("/api/v1/scenes/toml", content=b"format = 1", headers=headers)
    assert response.status_code == 415
    told = response.json()
    assert (told["title"], told["detail"]) == (
        "The body is not called TOML",
        "Send it with the header content-type: application/toml.",
    )


@pytest.mark.parametrize(
    ("body", "code", "offset"),
    [
        pytest.param(b"a == 1", "toml-syntax", 3, id="syntax"),
        pytest.param(b"a = \xff", "toml-syntax", 4, id="bytes that are no text"),
        pytest.param(b"a = " + b"[" * 9000, "toml-depth", None, id="nested"),
    ],
)
async def test_no_toml(client: httpx.AsyncClient, body: bytes, code: str, offset: int | None) -> None:
    response = await client.post(
        "/api/v1/scenes/toml?lang=de", content=body, headers={"content-type": "application/toml"}
    )
    assert response.status_code == 422
    (problem,) = response.json()["problems"]
    assert (problem["code"], problem["offset"], problem["pointer"]) == (code, offset, "")
