"""An address where there is nothing: readers get a page that leads on, programs a problem document."""

from __future__ import annotations

from html import unescape

import httpx
import pytest

pytestmark = pytest.mark.anyio
HTML, JSON = {"Accept": "text/html,*/*;q=0.8"}, {"Accept": "application/json"}


@pytest.mark.parametrize(
    ("path", "title", "near"),
    [
        pytest.param("lectures?lang=en", "There is no such page", "/lecture?lang=en", id="a letter too many"),
        pytest.param("Labs?lang=de", "Diese Seite gibt es nicht", "/labs?lang=de", id="a capital letter"),
        pytest.param("a/b/c?lang=en", "There is no such page", "", id="nothing like it"),
        pytest.param("<script>1</script>?lang=en", "There is no such page", "", id="marks of HTML"),
        pytest.param("x" * 5000 + "?lang=en", "There is no such page", "", id="very long"),
    ],
)
async def test_readers_are_told_where_the_pages_are(
    client: httpx.AsyncClient, path: str, title: str, near: str
) -> None:
    page = await client.get(f"/{path}", headers=HTML)
    assert (page.status_code, page.headers["content-type"]) == (404, "text/html; charset=utf-8")
    assert f"<h1>{title}</h1>" in page.text
    lead = page.text.partition("<nav>")[0]
    assert (f'href="{near}"' in lead) if near else ("href=" not in lead.partition("<main")[2])
    assert "<script>1" not in page.text
    assert f"/{path.partition('?')[0]}"[:65] in unescape(lead)
    assert all(f'href="/{name}?lang=' in page.text for name in ("scene", "labs", "homework", "lecture", ""))
    head = await client.head(f"/{path}", headers=HTML)
    assert (head.status_code, head.content) == (404, b"")


@pytest.mark.parametrize("headers", [JSON, {"Accept": "*/*"}], ids=["JSON", "anything"])
async def test_programs_get_a_problem_document(client: httpx.AsyncClient, headers: dict[str, str]) -> None:
    answer = await client.get("/lectures", headers=headers)
    assert (answer.status_code, answer.json()["type"]) == (404, "/problems/not-found")


async def test_the_api_speaks_json_to_everybody(client: httpx.AsyncClient) -> None:
    answer = await client.get("/api/v1/pendulum", headers=HTML)
    assert (answer.status_code, answer.json()["type"]) == (404, "/problems/not-found")
