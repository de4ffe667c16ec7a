"""The figure taken in hand: varied, dragged, scrubbed, compared, and tied to the formulas."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Locator, Page, expect
from tests.e2e.lecture import Lecture

pytestmark = pytest.mark.e2e


def numbers_in(text: str | None) -> list[float]:
    return [float(number) for number in re.findall(r"-?\d+\.?\d*", (text or "").replace("−", "-"))]


def open_at_rest(lecture: Lecture, query: str) -> Page:
    """A place whose motion does not begin by itself, with the instruments."""
    lecture.page.emulate_media(reduced_motion="reduce")
    lecture.open(query)
    lecture.page.locator(".drawing").hover(position={"x": 5, "y": 5})
    lecture.page.locator(".figure-tools button").first.wait_for()
    return lecture.page


def slide(slider: Locator, value: float) -> None:
    slider.evaluate("(e, v) => { e.value = v; e.dispatchEvent(new Event('input', {bubbles: true})) }", value)


def work(page: Page, load: str) -> float:
    return numbers_in(page.locator(f".bars [data-load='{load}'] .number").text_content())[0]


def test_a_variation_is_seen_and_has_an_address(lecture: Lecture) -> None:
    """A ghost and an arrow for δr; the works of the loads add up; the same again from the address."""
    page = open_at_rest(lecture, "?scene=elastic-pendulum&lang=en")
    page.locator(".figure-tools button").first.click()
    expect(page.locator("svg.under .ghost-varied.bob")).to_have_count(1)
    slide(page.locator("[data-slider=delta-y] input[type=range]"), 0.0)
    slide(page.locator("[data-slider=delta-phi] input[type=range]"), 0.5)
    expect(page.locator("svg.over .arrow.virtual.body-bob")).to_have_count(1)
    # At the start q₂ = 0.6: −m g ℓ sin q₂ δq₂ and F₀ ℓ δq₂.
    expect(page.locator(".bars [data-load=weight] .number")).to_have_text("−2.770 J")
    expect(page.locator(".bars [data-load=drive] .number")).to_have_text("1.000 J")
    assert work(page, "") == pytest.approx(sum(work(page, load) for load in ("weight", "suspension", "drive")))
    expect(page).to_have_url(re.compile("vary=y:0%2Cphi:0.5%2Cdt:0"))
    page.reload()
    expect(page.locator(".bars [data-load=weight] .number")).to_have_text("−2.770 J")
    page.locator(".virtual-panel .heading button").first.click()
    expect(page.locator("svg.under path")).to_have_count(0)
    expect(page.locator(".values [data-slider=parameter-m-value]")).to_be_visible()


def test_the_guide_adds_to_the_differential_alone(lecture: Lecture) -> None:
    """With a guided base dr has a part ∂r/∂t dt that δr has not; with a free base there is none."""
    page = open_at_rest(lecture, "?scene=guided-pendulum&lang=en&vary=phi:0.3,dt:0.2")
    expect(page.locator("svg.over .arrow.virtual")).to_have_count(1)
    expect(page.locator("svg.over .arrow.time-term")).to_have_count(1)
    expect(page.locator("svg.under .ghost-later.bob")).to_have_count(1)
    expect(page.locator("[data-slider=delta-y]")).to_have_count(0)
    slide(page.locator("[data-slider=delta-dt] input[type=range]"), 0)
    expect(page.locator("svg.over .arrow.time-term")).to_have_count(0)
    page = open_at_rest(lecture, "?scene=elastic-pendulum&lang=en&vary=phi:0.3,dt:0.2&at=1.2")
    expect(page.locator("svg.over .arrow.actual").first).to_be_attached()
    expect(page.locator("svg.over .arrow.time-term")).to_have_count(0)
