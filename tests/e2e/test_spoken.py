"""Formulas for those who listen: their names are the server's words, and their terms can be walked through by keys."""

from __future__ import annotations

import re
from typing import Any

import pytest
from playwright.sync_api import Page, expect
from tests.e2e.lecture import Lecture

pytestmark = pytest.mark.e2e

FRAME = """() => {
    const frame = document.querySelector('.term-frame')?.getBoundingClientRect();
    const formula = document.activeElement.getBoundingClientRect();
    return frame && [frame.width / formula.width, frame.left, frame.top, frame.height];
}"""


def heard(page: Page) -> list[Any]:
    """Names and roles of all images in the tree that readers of screens get."""
    client = page.context.new_cdp_session(page)
    nodes = client.send("Accessibility.getFullAXTree")["nodes"]
    return [
        (node["role"]["value"], node["name"]["value"], node.get("childIds", []))
        for node in nodes
        if not node.get("ignored") and node["role"]["value"] in ("image", "img", "math", "MathMLMath")
    ]


@pytest.mark.one_in(2)
@pytest.mark.parametrize(
    ("place", "words"),
    [
        ("scene?scene=pendulum&lang=en&step=equation:phi", "m l squared phi double dot"),
        ("scene?scene=pendulum&lang=de&step=equation:phi", "m l Quadrat phi Punkt Punkt"),
        ("proof?lang=en&view=lecture&step=general-lagrange-function", "L equals E"),
    ],
)
def test_a_formula_is_heard_once_in_the_words_of_the_server(lecture: Lecture, place: str, words: str) -> None:
    page = lecture.page
    page.goto(f"{lecture.address}{place}")
    formula = page.locator("[aria-current=step] .formula").first
    expect(formula.locator(".katex-html").first).to_be_attached()
    name = formula.get_attribute("aria-label") or ""
    assert words in name
    announced = page.locator("#announcer").text_content() or ""
    assert re.match(r"(Step|Schritt) \d", announced)
    assert not re.search(r"[\\{}$_]|varphi|mathrm", announced)
    found = [(role, children) for role, text, children in heard(page) if text == name]
    assert [role for role, _ in found] == ["image"]
    assert formula.locator("math").count() == 0


def test_the_terms_of_a_formula_are_walked_through(lecture: Lecture) -> None:
    """Enter begins, the arrows go on inside the formula and not in the lecture, Escape gives them back."""
    page = lecture.page
    page.goto(f"{lecture.address}scene?scene=pendulum&lang=en&step=equation:phi&view=lecture")
    formula = page.locator(".slide .result .formula")
    expect(formula.locator(".katex-html").first).to_be_attached()
    formula.focus()
    page.keyboard.press("Enter")
    said = page.locator("#announcer")
    spoken, frames, lit = [], [], []
    for _ in range(3):
        spoken.append(said.text_content())
        lit.append(page.locator(".drawing .q-0.lit").count())
        frames.append(page.evaluate(FRAME))
        page.keyboard.press("ArrowRight")
    assert spoken == [
        "d by d t of the partial derivative of capital L with respect to phi dot",
        "minus the partial derivative of capital L with respect to phi",
        "equals Q sub phi upper d",
    ]
    assert all(frame and frame[0] < 0.7 for frame in frames)
    assert all(lit)  # each term speaks of φ, and the drawing shows it
    assert frames[0][1] < frames[1][1] < frames[2][1]
    page.keyboard.press("ArrowLeft")
    assert said.text_content() == spoken[2]
    assert "step=equation" in page.url
    page.keyboard.press("Escape")
    expect(page.locator(".term-frame")).to_have_count(0)
    expect(page.locator(".lit")).to_have_count(0)
    expect(formula).to_have_attribute("role", "img")
    page.keyboard.press("ArrowRight")
    expect(page.locator(".slide .step")).not_to_have_attribute("data-step", "equation:phi")
