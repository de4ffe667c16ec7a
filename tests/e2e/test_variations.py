"""The pages without a scene, in a real browser: variations of anything, and the general proof."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import expect
from tests.e2e.lecture import Lecture
from tests.e2e.waiting import until_equal

pytestmark = pytest.mark.e2e


# Whether the first route ends by one of its edges where the second begins by one of its own.
APART = """([end, begin]) => {
    const [first, second] = [...document.querySelectorAll('.routes > .steps')].map(e => e.getBoundingClientRect());
    return first[end] <= second[begin] + 1;
}"""


@pytest.fixture
def variations(lecture: Lecture) -> Lecture:
    """The page with the lecture's identity functional, answered and charted."""
    lecture.page.goto(f"{lecture.address}variations?lang=en")
    lecture.page.locator(".errors circle.now").first.wait_for()
    return lecture


def test_both_routes_stand_beside_each_other(variations: Lecture) -> None:
    page = variations.page
    page.wait_for_function(APART, arg=["right", "left"])
    expect(page.locator(".doubtful, .untypeset, .katex-error")).to_have_count(0)
    page.set_viewport_size({"width": 360, "height": 740})
    page.wait_for_function(APART, arg=["bottom", "top"])
    until_equal(page, lambda: page.evaluate("document.documentElement.scrollWidth"), 360)


def test_a_mistake_is_marked_and_a_name_can_be_declared(variations: Lecture) -> None:
    page = variations.page
    page.locator(".examples select").select_option("action")
    expect(page.locator(".outcome")).to_contain_text("Euler")
    page.locator("[data-pointer='/expression'] input").fill("m*dot(x)^2/2 - c*x^2/2")
    wrong = page.locator("[data-pointer='/expression']")
    expect(wrong.locator("mark")).to_have_text("c")
    wrong.get_by_role("button", name="c is a parameter").click()
    expect(page.locator("[data-pointer='/parameters'] input")).to_have_value("m, k, T, c")
    expect(page.locator("mark")).to_have_count(0)
    variations.complaints.clear()  # the browser reports that the server refused the unknown name


def test_each_end_is_fixed_or_free_by_itself(variations: Lecture) -> None:
    page = variations.page
    page.locator(".examples select").select_option("length")
    conditions = page.locator(".outcome .so")
    expect(conditions).to_have_text("as both ends are fixed")
    page.get_by_role("group", name="Upper end").get_by_role("button", name="free").click()
    expect(conditions).to_have_text("natural condition at t = 1:")
    expect(page).to_have_url(re.compile("ends=fixed-free"))


def test_the_slider_asks_nothing_and_its_place_is_in_the_address(variations: Lecture) -> None:
    page = variations.page
    sent: list[str] = []
    page.on("request", lambda request: sent.append(request.url) if "/api/" in request.url else None)
    neighbour = page.locator("path.neighbour").first
    before = neighbour.get_attribute("d")
    page.locator("#h").focus()
    page.keyboard.press("Home")
    expect(page.locator(".dial output")).to_have_text("1.0·10⁻¹⁶")
    expect(neighbour).not_to_have_attribute("d", before or "")
    assert sent == []
    expect(page).to_have_url(re.compile("h=64"))
    page.reload()
    expect(page.locator(".dial output")).to_have_text("1.0·10⁻¹⁶")


def test_the_proof_is_read_step_by_step_in_both_languages(lecture: Lecture) -> None:
    page = lecture.page
    page.goto(f"{lecture.address}proof?lang=de")
    lecture.steps.first.wait_for()
    page.keyboard.press("End")
    expect(lecture.steps).to_have_count(lecture.number_of_steps())
    expect(page.locator(".doubtful, .untypeset, .katex-error")).to_have_count(0)
    page.set_viewport_size({"width": 360, "height": 740})
    until_equal(page, lambda: page.evaluate("document.documentElement.scrollWidth"), 360)
    expect(page.locator(".step[aria-current] .title")).to_be_visible()
    step = lecture.current_step
    page.locator(".segments [lang=en]").click()
    expect(page.locator(".pager .main")).to_contain_text("Next")
    page.reload()
    expect(page.locator(".step[aria-current]")).to_have_attribute("data-step", step)


def test_the_language_goes_along_to_the_other_pages(lecture: Lecture) -> None:
    lecture.open("?scene=pendulum&lang=de&theme=dark")
    lecture.page.get_by_role("button", name="Alle Seiten").click()
    lecture.page.get_by_role("link", name="Variationen").click()
    expect(lecture.page).to_have_url(re.compile(r"/variations\?lang=de&theme=dark"))
    lecture.page.get_by_role("link", name="Allgemeiner Beweis").click()
    lecture.steps.first.wait_for()
    expect(lecture.page).to_have_url(re.compile(r"/proof\?step=.*lang=de&theme=dark"))
