"""With the Tab key through the pages: a ring shows where the focus is, also in colours that the system forces."""

from __future__ import annotations

from typing import Any, Literal

import pytest
from playwright.sync_api import Page, expect
from tests.e2e.lecture import Lecture

pytestmark = pytest.mark.e2e

MOST = 80
LEAST = {"button.main": 12}  # stops; the labs have no more before anything is measured
# The outline of what has the focus, or of what stands for it: the label of a hidden field, the frame of a choice.
# Of a ring that is cut off on opposite sides too little is seen.
STOP = """() => {
    const focused = document.activeElement;
    if (!focused || focused === document.body) return null;
    const cut = (one) => {
        const reach = parseFloat(getComputedStyle(one).outlineOffset) + 1;
        const { left, top, right, bottom } = one.getBoundingClientRect();
        for (let outer = one.parentElement; outer; outer = outer.parentElement) {
            if (getComputedStyle(outer).overflowX === 'visible') continue;
            const room = outer.getBoundingClientRect();
            if (left - reach < room.left && right + reach > room.right) return true;
            if (top - reach < room.top && bottom + reach > room.bottom) return true;
        }
        return false;
    };
    const ringed = (one) => {
        const { outlineStyle, outlineWidth, outlineColor } = getComputedStyle(one);
        const drawn = outlineStyle !== 'none' && parseFloat(outlineWidth) >= 2;
        return drawn && !/^rgba.*, 0[)]$/.test(outlineColor) && !cut(one);
    };
    const bearers = [focused.matches('.unseen') ? null : focused, focused.closest('label'), focused.closest('.choice')];
    const { x, y } = focused.getBoundingClientRect();
    const said = (focused.ariaLabel ?? focused.textContent).trim().slice(0, 40);
    const name = `${focused.localName}.${focused.className} ${said}`;
    return { name, place: [name, x, y].join(), ringed: bearers.some((one) => one && ringed(one)) };
}"""


def stops(page: Page) -> list[dict[str, Any]]:
    """What the Tab key leads to, until it leads out of the page."""
    found: dict[str, dict[str, Any]] = {}
    for _ in range(MOST):
        page.keyboard.press("Tab")
        stop = page.evaluate(STOP)
        if stop is None:
            break
        found.setdefault(stop["place"], stop)
    return list(found.values())


SCENE = "scene?scene=elastic-pendulum&lang=de"
HOMEWORK = "homework?scene=pendulum&task=equation:phi&lang=en"


@pytest.mark.one_in(3)
@pytest.mark.parametrize(
    ("place", "ready", "forced"),
    [
        pytest.param("?lang=en", ".hero path.bob", "none", id="start page"),
        pytest.param(SCENE, ".plots.ready", "none", id="scene"),
        pytest.param(SCENE, ".plots.ready", "active", id="scene, colours forced"),
        pytest.param("scene?scene=pendulum&edit=form&lang=en", ".editor .field .katex", "none", id="editor"),
        pytest.param(HOMEWORK, "math-field", "none", id="homework"),
        pytest.param(HOMEWORK, "math-field", "active", id="homework, colours forced"),
        pytest.param("labs?lang=de", "button.main", "none", id="labs"),
        pytest.param("variations?lang=en", ".steps .katex", "none", id="variations"),
    ],
)
def test_the_focus_is_seen_wherever_it_goes(
    lecture: Lecture, place: str, ready: str, forced: Literal["none", "active"]
) -> None:
    page = lecture.page
    page.emulate_media(reduced_motion="reduce", forced_colors=forced)
    page.goto(f"{lecture.address}{place}")
    page.locator(ready).first.wait_for(state="attached")
    found = stops(page)
    assert len(found) >= LEAST.get(ready, 16)
    assert [stop["name"] for stop in found if not stop["ringed"]] == []


def test_in_forced_colours_no_plate_covers_the_letter_below_its_dot(lecture: Lecture) -> None:
    """Chromium lays the plate behind every text whose colours it forces."""
    lecture.page.emulate_media(forced_colors="active")
    lecture.open("?scene=elastic-pendulum&lang=en&step=equation:phi")
    letters = lecture.page.locator(".step[aria-current] .katex .accent-body")
    expect(letters.first).to_be_attached()
    expect(letters.first).to_have_css("forced-color-adjust", "none")
