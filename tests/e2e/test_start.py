"""The start page, and the ways between all pages, in a real browser."""

from __future__ import annotations

import json
import re
import urllib.request
from functools import cache
from urllib.parse import parse_qs, urlsplit

import pytest
from playwright.sync_api import Page, Request, Route, expect
from tests.e2e.lecture import Lecture

pytestmark = pytest.mark.e2e

FIRST_VIEW = 300_000


@pytest.fixture
def start(lecture: Lecture) -> Lecture:
    """The start page with its pendulum."""
    lecture.page.goto(f"{lecture.address}?lang=en")
    lecture.page.locator(".hero path.bob").wait_for(state="attached")
    return lecture


def test_the_pendulum_moves_and_leads_to_its_scene(start: Lecture) -> None:
    bob = start.page.locator(".hero path.bob")
    expect(bob).not_to_have_attribute("transform", bob.get_attribute("transform") or "")
    start.page.locator(".hero a").click()
    expect(start.steps.first).to_be_visible()


def test_who_waits_for_the_pendulum_is_told(lecture: Lecture) -> None:
    """A first start compiles for a while; the page is not empty meanwhile."""
    held: list[Route] = []
    released = False

    def hold(route: Route) -> None:
        if released:
            route.continue_()
        else:
            held.append(route)

    lecture.page.route("**/api/v1/simulations", hold)
    lecture.page.goto(f"{lecture.address}?lang=en")
    told = lecture.page.locator(".hero .patience")
    expect(told).to_be_visible()
    expect(told).to_contain_text("compiles its numerical methods")
    released = True
    for route in held:
        route.continue_()
    expect(told).to_be_hidden()
    expect(lecture.page.locator(".hero path.bob")).to_be_attached()


def test_the_pendulum_rests_for_those_who_prefer_it(lecture: Lecture) -> None:
    lecture.page.emulate_media(reduced_motion="reduce")
    lecture.page.goto(f"{lecture.address}?lang=en")
    bob = lecture.page.locator(".hero path.bob")
    before = bob.get_attribute("transform")
    lecture.page.wait_for_timeout(300)
    assert bob.get_attribute("transform") == before


def test_a_scene_moves_while_it_is_pointed_at(start: Lecture) -> None:
    card = start.page.locator(".card", has=start.page.locator("[data-scene=pendulum]"))
    card.scroll_into_view_if_needed()
    bob = card.locator("path.bob")
    before = bob.get_attribute("transform") or ""
    card.focus()
    expect(bob).not_to_have_attribute("transform", before)


@cache
def _steps(address: str, scene: str, formulation: str) -> frozenset[str]:
    body = json.dumps({"scene": scene, "formulation": formulation}).encode()
    request = urllib.request.Request(f"{address}api/v1/derivations", body, {"content-type": "application/json"})
    with urllib.request.urlopen(request) as answer:
        chapters = json.load(answer)["chapters"]
    return frozenset(step["id"] for chapter in chapters for step in chapter["steps"])


def test_every_entry_of_the_course_leads_to_what_it_names(start: Lecture) -> None:
    expect(start.page.locator(".course a").nth(15)).to_be_attached()
    links = [str(link.get_attribute("href")) for link in start.page.locator(".course a").all()]
    for link in links:
        assert start.page.request.get(start.address + link[1:]).ok
        place = {key: values[0] for key, values in parse_qs(urlsplit(link).query).items()}
        if "scene" in place and "step" in place:
            known = _steps(start.address, place["scene"], place.get("formulation", "dalembert-lagrange"))
            assert place["step"] in known, link


def test_every_scene_has_a_card(start: Lecture) -> None:
    with urllib.request.urlopen(f"{start.address}api/v1/scenes") as answer:
        scenes = [scene["id"] for scene in json.load(answer)["scenes"]]
    cards = start.page.locator(".card [data-scene]")
    expect(cards).to_have_count(len(scenes))
    assert [card.get_attribute("data-scene") for card in cards.all()] == scenes


@pytest.mark.one_in(2)
@pytest.mark.parametrize("width", [pytest.param(1920, id="wide"), pytest.param(360, id="phone")])
def test_every_page_is_two_clicks_from_every_page(lecture: Lecture, width: int) -> None:
    """One click on the navigation, and one on the button that shows it where there is no room."""
    page = lecture.page
    page.set_viewport_size({"width": width, "height": 740})
    page.goto(f"{lecture.address}?lang=en")
    page.locator(".places").wait_for(state="attached")
    pages = [str(link.get_attribute("href")) for link in page.locator(".places a:not(.home)").all()]
    assert len(pages) >= 4
    for here in pages:
        page.goto(lecture.address + here[1:])
        page.locator(".top").wait_for()
        if not page.locator(".places").is_visible():
            page.locator(".menu").click()
        for link in page.locator(".places a:not(.home)").all():
            expect(link).to_be_visible()
        shown = [str(link.get_attribute("href")) for link in page.locator(".places a:not(.home)").all()]
        assert [urlsplit(link).path for link in shown] == [urlsplit(link).path for link in pages]
        assert page.evaluate("document.documentElement.scrollWidth") == width
        page.wait_for_load_state("networkidle")
        page.locator(".brand:visible, .home:visible").first.click(force=True)
        expect(page.locator(".opening")).to_be_visible()
    page.goto(f"{lecture.address}docs/try")
    page.get_by_role("link", name="δq").click()
    expect(page.locator(".opening")).to_be_visible()


def test_old_addresses_of_scenes_lead_to_them(lecture: Lecture, page: Page) -> None:
    page.goto(f"{lecture.address}?scene=pendulum&lang=en&step=kinetic-energy-of-particle:bob")
    expect(page).to_have_url(re.compile(r"/scene\?scene=pendulum&step=kinetic-energy-of-particle:bob&lang=en"))
    page.goto(f"{lecture.address}?lang=en#edit")
    expect(page).to_have_url(re.compile(r"/scene\?.*edit=form"))


@pytest.mark.one_in(3)
@pytest.mark.usefixtures("bundle")
@pytest.mark.parametrize(
    ("place", "ready"),
    [
        pytest.param("?lang=en", ".hero path.bob", id="start page"),
        pytest.param("variations?lang=en", ".steps .katex", id="variations"),
        pytest.param("proof?lang=en", ".steps .katex", id="proof"),
        pytest.param("labs?lang=en", "main", id="labs"),
        pytest.param("homework?lang=en", "main .katex", id="homework"),
        pytest.param("lecture?lang=en", ".stops, .empty", id="own lectures"),
        pytest.param("docs?lang=en", ".calls article", id="reference"),
        pytest.param("docs/try?lang=en", ".trial textarea", id="trial of the API"),
        pytest.param("help?lang=en", ".guide article", id="help"),
        pytest.param("handout?scene=pendulum&lang=en", ".paper .katex", id="handout"),
        pytest.param("presenter?lang=en", ".presenter .notice", id="presenter"),
    ],
)
def test_bytes_of_the_first_view(lecture: Lecture, place: str, ready: str) -> None:
    """What a page fetches before anything is asked of it, but for the large libraries that come after it."""
    received: list[int] = []

    def count(request: Request) -> None:
        sizes = request.sizes()
        if not re.search(r"/(plotly|mathlive)", request.url):
            received.append(sizes["responseBodySize"] + sizes["responseHeadersSize"])

    lecture.page.on("requestfinished", count)
    lecture.page.goto(lecture.address + place)
    lecture.page.locator(ready).first.wait_for(state="attached")
    lecture.page.wait_for_load_state("networkidle")
    print(f"{place}: {len(received)} requests, {sum(received)} bytes")
    assert 0 < sum(received) < FIRST_VIEW
