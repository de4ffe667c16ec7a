"""Practice in a real browser: a mistake that is named comes back on another system, and the level rises."""

from __future__ import annotations

import datetime as dt
import re

import pytest
from playwright.sync_api import Page, expect
from tests.e2e.lecture import Lecture

pytestmark = pytest.mark.e2e
KINETIC = "?side=practice&lang=en&series=ada&level=1&number=3"  # a block on an incline: its kinetic energy
SOON = dt.timedelta(minutes=11)


def _open(lecture: Lecture, query: str) -> Page:
    lecture.page.goto(f"{lecture.address}homework{query}")
    lecture.page.locator(".question .of-system").wait_for()
    return lecture.page


def _answer(page: Page, text: str, outcome: str) -> None:
    page.get_by_role("group", name="Notation").get_by_role("button", name="Text").click()
    page.locator("textarea.entry").fill(text)
    page.locator(".answering button.main").click()
    page.locator(f".verdict-card[data-outcome={outcome}]:not(.stale)").wait_for()


def test_a_mistake_comes_back_on_another_system(lecture: Lecture) -> None:
    page = _open(lecture, KINETIC)
    system = page.locator(".of-system").inner_text()
    lessons = page.locator(".lessons li")
    expect(lessons).to_have_count(0)
    _answer(page, "m*s'^2", "wrong")
    expect(lessons).to_have_text(re.compile("Factor of the kinetic energy"))
    _answer(page, "m*s'^2/2", "correct")
    expect(page.locator(".practice .total")).to_have_text(re.compile("1 of 3"))
    page.clock.set_fixed_time(dt.datetime.now(dt.UTC) + SOON)
    page.get_by_role("button", name="Next exercise").click()
    expect(page.locator(".returns")).to_be_visible()
    expect(page).to_have_url(re.compile("recall=half-in-kinetic-energy"))
    expect(page.locator(".question h2").last).to_have_text(re.compile("Kinetic energy"))
    expect(page.locator(".of-system")).not_to_have_text(system)
    page.reload()
    expect(lessons.locator("time")).to_have_text("now")


def test_practice_is_entered_left_and_found_again(lecture: Lecture) -> None:
    page = _open(lecture, "?practice&lang=de")
    first, second = re.compile("level=1&number=1$"), re.compile("level=1&number=2$")
    expect(page).to_have_url(first)
    expect(page.locator(".drawing.right svg path").first).to_be_attached()
    page.get_by_role("button", name="Andere Aufgabe").click()
    expect(page).to_have_url(second)
    page.evaluate("window.same = true")
    page.go_back()
    expect(page).to_have_url(first)
    page.go_forward()
    page.locator(".question .of-system").wait_for()
    expect(page).to_have_url(second)
    assert page.evaluate("window.same"), "the way back loads no page"
    page.get_by_role("button", name="Eine Antwort").click()
    expect(page.locator(".tasks .task").first).to_be_visible()
    page.get_by_role("button", name="Üben").click()
    page.locator(".question .of-system").wait_for()
    expect(page).to_have_url(second)
