"""Long formulas, row by row, in a real browser."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Route, expect
from tests.e2e.lecture import ROWS, Lecture

pytestmark = pytest.mark.e2e

STEP = "product-rule:third"
FORMULA = f".step[data-step='{STEP}'] .formula"
FILLED = """selector => [...document.querySelectorAll(selector)].every(formula => {
    const cells = [...formula.querySelectorAll('.cell')];
    return cells.length > 0 && cells.every(cell => !cell.dataset.latex || cell.querySelector('.katex-html'));
})"""
MORE = "([selector, before]) => document.querySelectorAll(selector).length > before"


@pytest.fixture
def long(lecture: Lecture) -> Lecture:
    """The longest step of the triple pendulum."""
    lecture.page.emulate_media(reduced_motion="reduce")
    lecture.open(f"?scene=triple-pendulum&lang=en&step={STEP}")
    lecture.page.locator(FORMULA).wait_for()
    lecture.page.wait_for_function(FILLED, arg=FORMULA)
    return lecture


def test_a_long_formula_stands_in_rows_that_fit(long: Lecture) -> None:
    formula = long.page.locator(FORMULA)
    expect(long.page.locator(".step[aria-current]")).to_be_in_viewport()
    assert formula.locator(".untypeset").count() == 0
    assert formula.evaluate("e => e.scrollWidth - e.clientWidth") <= 0


def test_it_is_heard_as_one_formula(long: Lecture) -> None:
    formula = long.page.locator(FORMULA)
    expect(formula).to_have_role("img")
    expect(formula).to_have_accessible_name(
        re.compile("^the scalar product of the partial derivative of r sub third bob .+ equals .+")
    )
    expect(formula.locator("math")).to_have_count(0)


def test_rows_have_their_heights_before_they_are_typeset(long: Lecture) -> None:
    """As high as what then stands in them, within a few pixels of the whole."""
    heights: list[float] = long.page.locator(FORMULA).evaluate(
        """async formula => {
            const set = formula.offsetHeight;
            formula.querySelectorAll('.cell').forEach(cell => cell.replaceChildren());
            return [set, formula.offsetHeight];
        }"""
    )
    assert heights[1] == pytest.approx(heights[0], abs=4)


def test_a_narrower_page_has_more_rows(long: Lecture) -> None:
    rows = long.page.locator(f"{FORMULA} .cell")
    before = rows.count()
    long.page.set_viewport_size({"width": 360, "height": 740})
    long.page.wait_for_function(MORE, arg=[f"{FORMULA} .cell", before])
    long.page.wait_for_function(FILLED, arg=FORMULA)
    fits = "selector => (e => e.scrollWidth <= e.clientWidth)(document.querySelector(selector))"
    long.page.wait_for_function(fits, arg=FORMULA)


def test_paper_has_all_of_them(long: Lecture) -> None:
    """Also those that nobody has seen yet."""
    page = long.page
    page.locator(".pager .minor").click()
    page.locator(".pager .minor:disabled").wait_for()
    page.evaluate("dispatchEvent(new Event('beforeprint'))")
    formulas = ".steps > .step > .formula"
    assert page.locator(formulas).count() > 40
    assert page.locator(f"{formulas}:not(:has(.katex-html))").count() == 0
    assert page.evaluate(FILLED, f"{formulas}:has(.rows)")


def test_what_is_scrolled_back_to_is_drawn_again(long: Lecture) -> None:
    page = long.page
    place = page.locator(".scroll")
    formula = page.locator(".step[data-step='virtual-displacement:first'] > .formula > .rows")
    place.evaluate("e => e.scrollTo(0, 0)")
    formula.locator(".katex-html").first.wait_for()
    place.evaluate("e => e.scrollTo(0, e.scrollHeight)")
    expect(formula).to_have_class("rows resting")
    formula.evaluate("e => e.closest('.step').scrollIntoView()")
    expect(formula).to_have_class("rows")
    expect(formula.locator(".katex-html").first).to_be_visible()


@pytest.mark.one_in(2)
def test_a_formula_is_there_also_where_rows_cannot_be_fetched(either: Lecture) -> None:
    page = either.page
    refused: list[str] = []

    def refuse(route: Route) -> None:
        refused.append(route.request.url)
        route.abort()

    page.route(ROWS, refuse)
    either.open(f"?scene=triple-pendulum&lang=en&step={STEP}")
    expect(page.locator(f"{FORMULA} .katex-html")).to_be_visible()
    page.wait_for_function("() => [...document.querySelectorAll('.step .formula')].every(e => e.firstChild)")
    assert refused
    either.complaints.clear()  # the browser reports what it could not fetch
