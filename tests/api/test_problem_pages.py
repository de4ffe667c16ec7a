"""Every type of problem document is the address of a page that explains it."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from html import unescape
from pathlib import Path
from typing import Any

import httpx
import pytest

from deltaq.api.problem_pages import example_of
from deltaq.api.problems import TYPES, ProblemType
from deltaq.settings import Settings

pytestmark = pytest.mark.anyio
API = Path(__file__).parents[2] / "backend" / "deltaq" / "api"
HTML, JSON = {"Accept": "text/html,*/*;q=0.8"}, {"Accept": "application/json"}
WITH_REQUEST = [kind for kind in TYPES if example_of(kind, Settings()).request]


def named_in_the_code() -> Iterator[str]:
    """The name of each type that is made anywhere."""
    for file in API.rglob("*.py"):
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "ProblemType":
                yield ast.literal_eval(node.args[0])


def text_of(html: str) -> str:
    """What is read of a page, its marks taken away."""
    return unescape(re.sub(r"<[^>]*>", "", html))


def test_every_type_that_the_code_makes_is_known() -> None:
    made = sorted(named_in_the_code())
    assert len(made) >= 16, "the pattern no longer finds the types"
    assert made == sorted(kind.name for kind in TYPES)


@pytest.mark.parametrize("language", ["en", "de"])
@pytest.mark.parametrize("kind", TYPES, ids=[kind.name for kind in TYPES])
async def test_every_type_leads_to_a_page(client: httpx.AsyncClient, kind: ProblemType, language: str) -> None:
    page = await client.get(kind.address, headers=HTML | {"Accept-Language": language})
    told = (await client.get(kind.address, headers=JSON | {"Accept-Language": language})).json()
    assert (page.status_code, page.headers["content-type"]) == (200, "text/html; charset=utf-8")
    assert page.headers["content-language"] == language
    assert f'<html lang="{language}">' in page.text
    assert f"<title>δq · {told['title']}</title>" in unescape(page.text)
    assert (told["type"], told["status"]) == (kind.address, kind.status)
    read = text_of(page.text)
    for part in (told["title"], told["meaning"].replace("`", ""), told["remedy"].replace("`", "")):
        assert part.strip() in read
    assert told["example"]["request"] in read
    assert f'"type": "{kind.address}"' in read
    assert "{" not in told["title"] + told["meaning"] + told["remedy"]


@pytest.mark.parametrize("address", ["/problems", "/problems/overloaded", "/problems/nothing-of-the-kind"])
@pytest.mark.parametrize("accepted", [HTML, JSON], ids=["page", "json"])
async def test_head_is_as_get(client: httpx.AsyncClient, address: str, accepted: dict[str, str]) -> None:
    read, asked = await client.get(address, headers=accepted), await client.head(address, headers=accepted)
    assert asked.content == b""
    assert asked.status_code == read.status_code
    for name in ("content-type", "content-language", "vary"):
        assert asked.headers.get(name) == read.headers.get(name), name


@pytest.mark.parametrize("kind", WITH_REQUEST, ids=[kind.name for kind in WITH_REQUEST])
async def test_the_request_of_a_page_fails_as_it_says(client: httpx.AsyncClient, kind: ProblemType) -> None:
    example = (await client.get(kind.address, headers=JSON | {"Accept-Language": "en"})).json()["example"]
    answer = await sent(client, example["request"])
    assert answer.json() == example["answer"]
    assert answer.status_code == kind.status


async def sent(client: httpx.AsyncClient, written: str) -> httpx.Response:
    """A request as it is written: its line, its headers, and after an empty line its body."""
    head, _, body = written.partition("\n\n")
    line, *fields = head.splitlines()
    method, address = line.split()
    headers: dict[str, Any] = dict(field.split(": ", 1) for field in fields)
    return await client.request(method, address, headers=headers, content=body or None)


async def test_what_the_settings_limit_is_told_as_it_is_set(client: httpx.AsyncClient) -> None:
    told = (await client.get("/problems/body-too-large", headers=JSON)).json()
    assert str(Settings().largest_body) in told["example"]["answer"]["detail"]


async def test_a_type_that_there_is_not_has_a_page_that_lists_those_there_are(client: httpx.AsyncClient) -> None:
    page = await client.get("/problems/<b>body-to-large</b>?lang=en", headers=HTML)
    assert page.status_code == 404
    assert "No problem is called “<b>body-to-large</b>”" in unescape(page.text)
    assert "<b>" not in page.text
    assert [kind.address for kind in TYPES if f'href="{kind.address}?lang=en"' not in page.text] == []
    refused = await client.get("/problems/body-to-large", headers=JSON)
    assert (refused.status_code, refused.json()["type"]) == (404, "/problems/not-found")


async def test_all_types_are_listed(client: httpx.AsyncClient) -> None:
    page = await client.get("/problems?lang=de", headers=HTML)
    assert page.status_code == 200
    assert [kind.address for kind in TYPES if f'href="{kind.address}?lang=de"' not in page.text] == []


async def test_the_language_in_the_address_goes_before_that_of_the_header(client: httpx.AsyncClient) -> None:
    page = await client.get("/problems/overloaded?lang=de", headers=HTML | {"Accept-Language": "en"})
    assert '<html lang="de">' in page.text
    assert "Der Dienst ist ausgelastet" in page.text
