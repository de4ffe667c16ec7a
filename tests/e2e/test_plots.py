"""The plots taken in hand: values read, parts of the time, hidden curves, wrapped angles, axes."""

from __future__ import annotations

import re
from itertools import pairwise

import pytest
from playwright.sync_api import Page, expect
from tests.e2e.lecture import Lecture
from tests.e2e.test_figure import numbers_in, open_at_rest
from tests.e2e.waiting import at_rest, until, until_equal

pytestmark = pytest.mark.e2e

PLOTLY = "document.querySelector('.plots .canvas')"


def open_plots(lecture: Lecture, query: str) -> Page:
    page = open_at_rest(lecture, query)
    page.locator(".plots.ready .reading").first.wait_for(state="attached")
    return page


def reading(page: Page, quantity: str) -> float:
    return numbers_in(page.locator(f".reading.{quantity}").first.text_content())[0]


def test_values_are_read_under_the_pointer_and_at_the_moment(lecture: Lecture) -> None:
    """Beside the names: those of the drawing at the moment; under a mouse those of its time, until it leaves."""
    page = open_plots(lecture, "?scene=elastic-pendulum&lang=en&at=2")
    shown = numbers_in(page.locator(".readouts .q-1 .number").text_content())[0]
    assert reading(page, "q-1") == pytest.approx(shown, abs=0.002)
    plots = at_rest(page.locator(".plots"))
    # Where the curve is lowest its slope is nothing: the place is known well enough.
    page.mouse.move(plots["x"] + plots["width"] / 2, plots["y"] + plots["height"] / 2)
    until(page, lambda: reading(page, "q-1"), lambda value: abs(value - shown) > 0.01)
    time = numbers_in(page.locator(".ghost").text_content())[0]
    page.mouse.move(5, 400)
    until_equal(page, lambda: reading(page, "q-1"), pytest.approx(shown, abs=0.002))
    page.locator(".scrub").focus()
    lecture.pause_at(time)
    until(page, lambda: reading(page, "q-1"), lambda value: abs(value - shown) > 0.01)


def test_a_curve_is_hidden_by_its_name(lecture: Lecture) -> None:
    """By keyboard, too; the rest of its row fills the axis, the address has it, the name keeps the focus."""
    page = open_plots(lecture, "?scene=elastic-pendulum&lang=en")
    name, wide = page.locator(".legend [data-curve=kinetic]"), page.evaluate(f"{PLOTLY}._fullLayout.width")
    name.focus()
    page.set_viewport_size({"width": 1300, "height": 768})  # all curves are drawn anew, below a name that stays
    until(page, lambda: page.evaluate(f"{PLOTLY}._fullLayout.width"), lambda width: width < wide)
    expect(name).to_be_focused()
    page.keyboard.press("Enter")
    expect(page.locator(".plots .trace.energy-kinetic")).to_have_count(0)
    expect(name).to_have_attribute("aria-pressed", "false")
    expect(name).to_be_focused()
    expect(page).to_have_url(re.compile("plot=-kinetic"))
    assert page.evaluate(f"{PLOTLY}._fullLayout.yaxis3.range[1]") < -5
    page.reload()
    expect(page.locator(".plots .trace.energy-potential")).to_have_count(1)
    expect(page.locator(".plots .trace.energy-kinetic")).to_have_count(0)
    name.click()
    expect(page.locator(".plots .trace.energy-kinetic")).to_have_count(1)


def test_a_part_of_the_time(lecture: Lecture) -> None:
    """By the wheel about the pointer, by Shift and a drag, by the menu's buttons; and all of it again."""
    page = open_plots(lecture, "?scene=pendulum&lang=en&at=1")
    plots = at_rest(page.locator(".plots"))
    shown = lambda: page.evaluate(f"{PLOTLY}._fullLayout.xaxis.range")
    y = plots["y"] + 0.3 * plots["height"]
    page.mouse.move(plots["x"] + plots["width"] / 2, y)
    page.mouse.wheel(0, -400)
    begin, end = until(page, shown, lambda found: found[1] - found[0] < 5)
    assert begin > 2
    assert end < 8
    page.get_by_role("button", name="Whole time").first.click()
    until_equal(page, shown, [0, 10])
    page.keyboard.down("Shift")
    page.mouse.move(plots["x"] + 0.3 * plots["width"], y)
    page.mouse.down()
    page.mouse.move(plots["x"] + 0.5 * plots["width"], y, steps=3)
    page.mouse.up()
    page.keyboard.up("Shift")
    begin, end = until(page, shown, lambda found: found[0] > 0)
    assert (begin, end) == pytest.approx((2.5, 4.7), abs=0.5)
    assert "at=1&" in page.url + "&"  # the moment is where it was
    expect(page.locator(".cursor")).to_be_hidden()
    page.locator(".plot-menu summary").click()
    page.locator(".plot-menu").get_by_role("button", name="Whole time").click()
    until_equal(page, shown, [0, 10])
    page.locator(".plot-menu").get_by_role("button", name="Zoom in").click()
    until_equal(page, shown, [0.5, 5.5])


def test_wrapped_angles_and_axes_are_chosen_in_the_menu(lecture: Lecture) -> None:
    """A pendulum that turns over stays between −π and π; each angle has an axis, or all have one."""
    page = open_plots(lecture, "?scene=double-pendulum&lang=en&set=phi1:0:14")
    range_of = lambda axis: page.evaluate(f"{PLOTLY}._fullLayout.{axis}?.range ?? [0, 0]")
    assert range_of("yaxis")[1] > 7
    page.locator(".plot-menu summary").focus()
    page.keyboard.press("Enter")
    page.get_by_label("Angles within").check()
    expect(page).to_have_url(re.compile("plot=wrapped"))
    until(page, lambda: range_of("yaxis"), lambda found: 3.1 < found[1] < 4)
    page.get_by_label("Axes").select_option("one for each unit")
    expect(page.locator(".plots .legend")).to_have_count(2)
    page.get_by_label("Axes").select_option("one for each curve")
    expect(page.locator(".plots .legend")).to_have_count(3)
    page.keyboard.press("Escape")
    expect(page.locator(".plot-menu .sheet")).to_be_hidden()
    expect(page.locator(".plot-menu summary")).to_be_focused()


@pytest.mark.one_in(2)
@pytest.mark.parametrize("scene", ["double-pendulum", "four-bar"])
def test_names_of_curves_keep_off_each_other_on_a_phone(lecture: Lecture, scene: str) -> None:
    """Above each row its names in one line: none on another, on the menu or out of the page; all can be scrolled to."""
    lecture.page.set_viewport_size({"width": 360, "height": 780})
    page = lecture.page
    page.goto(f"{lecture.address}scene?scene={scene}&lang=de&panel=plots")
    page.locator(".plots.ready .reading").first.wait_for(state="attached")
    legends = page.locator(".plots .legend").filter(visible=True)
    menu = page.locator(".plot-menu summary").bounding_box()
    assert menu is not None
    for legend in legends.all():
        box = legend.bounding_box()
        assert box is not None
        assert box["x"] + box["width"] <= (menu["x"] if box["y"] < menu["y"] + menu["height"] else 360)
        names = [one.bounding_box() for one in legend.locator("> *").filter(visible=True).all()]
        ends = [(name["x"], name["x"] + name["width"]) for name in names if name]
        assert len(ends) > 1
        assert all(end <= start + 0.5 for (_, end), (start, _) in pairwise(ends)), ends
        legend.evaluate("one => { one.scrollLeft = one.scrollWidth; }")
        last = legend.locator("> *").filter(visible=True).last.bounding_box()
        assert last is not None
        assert last["x"] + last["width"] <= box["x"] + box["width"] + 1


LINKED = {
    "format": 1,
    "id": "linked",
    "title": "Two blocks on a rod",
    "coordinates": [{"name": "x", "value": 0.0}, {"name": "z", "value": 1.0}],
    "bodies": [
        {"name": "left", "kind": "particle", "mass": "2", "position": ["x", "0"]},
        {"name": "right", "kind": "particle", "mass": "1", "position": ["z", "0"]},
    ],
    "constraints": [{"kind": "distance", "name": "rod", "from": "left", "to": "right", "length": "1"}],
    "loads": [
        {"kind": "force", "name": "push", "at": "left", "force": ["4*sin(t)", "0"]},
        {"kind": "friction", "name": "first", "coordinate": "x", "force": "2"},
        {"kind": "friction", "name": "second", "coordinate": "z", "force": "1"},
    ],
}


def test_forces_that_are_not_determined_are_told_and_not_drawn(sources: Lecture) -> None:
    """Both blocks stick up to 4 sin t = 3, t = 0.848: R₁, R₂ and λ are dashes before, and numbers behind it."""
    page = sources.page
    page.goto(f"{sources.address}scene?lang=en")
    fragment = page.evaluate("scene => import('/model/own.js').then(own => own.fragmentOf(scene))", LINKED)
    own = page.evaluate("import('/model/own.js').then(own => own.OWN)")
    for time, seen in ((0.5, "–"), (2.0, "−2")):
        page.goto("about:blank")  # an address that differs in its fragment alone is the same page
        page.goto(f"{sources.address}scene?scene={own}&lang=en&at={time}{fragment}")
        page.locator(".plots.ready .reading").first.wait_for(state="attached")
        note = page.locator(".report .note")
        expect(note).to_contain_text("Statically indeterminate")
        expect(note).to_contain_text("first from 0.00 to 0.85 s")
        expect(page.locator('[data-curve="friction-first"] + .reading')).to_contain_text(seen)
    gaps = page.evaluate(f"{PLOTLY}.data.filter(trace => trace.y.some(Number.isNaN)).map(trace => trace.name)")
    assert sorted(gaps) == ["friction-first", "friction-second", "reaction-lambda"]
    assert sources.complaints == []
