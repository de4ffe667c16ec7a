"""Lecture mode and the presenter's window, in a real browser."""

from __future__ import annotations

import re
from typing import Literal

import pytest
from playwright.sync_api import expect
from tests.e2e.lecture import Lecture
from tests.e2e.slides import opened, share, slides
from tests.e2e.waiting import frames, until, until_equal

pytestmark = pytest.mark.e2e

PLACE = "?scene=elastic-pendulum&lang=en&view=lecture&step=virtual-displacement:bob"


@pytest.fixture
def hall(lecture: Lecture) -> Lecture:
    """The elastic pendulum in lecture mode, at a step with three substeps."""
    lecture.page.goto(f"{lecture.address}scene{PLACE}")
    expect(lecture.page.locator(".slide .formula .katex").first).to_be_visible()
    lecture.await_last_chapter()
    return lecture


def test_a_key_enters_and_leaves(lecture: Lecture) -> None:
    page = lecture.page
    lecture.open("?scene=pendulum&lang=en")
    page.keyboard.press("l")
    expect(page.locator(".slide .step")).to_have_count(1)
    expect(page.locator(".top")).to_be_hidden()
    expect(page).to_have_url(re.compile("view=lecture"))
    page.keyboard.press("l")
    expect(page.locator(".top")).to_be_visible()
    expect(lecture.steps).to_have_count(1)


def test_one_step_at_a_time_by_keys_and_remote(hall: Lecture) -> None:
    page = hall.page
    first = hall.current_step
    for key, step in (
        ("PageDown", "total-differential:bob"),
        ("Space", "work-of-force:weight"),
        ("PageUp", "total-differential:bob"),
        ("ArrowLeft", first),
        ("End", "symmetry-search"),
        ("Home", "position:bob"),
    ):
        page.keyboard.press(key)
        expect(page.locator(".slide .step")).to_have_attribute("data-step", step)
        expect(page.locator(".slide .step")).to_have_count(1)
    assert page.locator(".untypeset, .katex-error").count() == 0


def test_substeps_come_one_by_one_and_have_an_address(hall: Lecture) -> None:
    page = hall.page
    for shown, results in ((1, 0), (2, 0), (3, 0), (3, 1), (3, 1)):
        page.keyboard.press("ArrowDown")
        expect(page.locator(".slide .part")).to_have_count(shown)
        expect(page.locator(".slide .result")).to_have_count(results)
    for part in page.locator(".slide .part, .slide .result").all():  # all of the step is on one screen
        expect(part).to_be_in_viewport(ratio=0.98)
    page.keyboard.press("ArrowUp")
    page.keyboard.press("ArrowUp")
    expect(page).to_have_url(re.compile("part=2"))
    page.reload()
    expect(page.locator(".slide .part")).to_have_count(2)
    expect(page.locator(".slide .part").last).to_be_in_viewport(ratio=0.98)
    page.keyboard.press("e")
    expect(page.locator(".slide .part")).to_have_count(3)
    page.keyboard.press("e")
    expect(page.locator(".slide .part")).to_have_count(0)


INTERRUPTED = "() => document.querySelector('.slide .scroll').scrollTo({ top: 0, behavior: 'instant' })"
GROWN = "() => (document.querySelector('.slide .part').style.paddingTop = '60rem')"


@pytest.mark.parametrize("disturb", [pytest.param(INTERRUPTED, id="given up"), pytest.param(GROWN, id="grown")])
def test_the_newest_substep_stays_in_sight_until_somebody_scrolls(hall: Lecture, disturb: str) -> None:
    page = hall.page
    for shown in (1, 2, 3):
        page.keyboard.press("ArrowDown")
        expect(page.locator(".slide .part")).to_have_count(shown)
    newest = page.locator(".slide .part").last
    expect(newest).to_be_in_viewport(ratio=0.98)
    page.evaluate(disturb)
    expect(newest).to_be_in_viewport(ratio=0.98)
    page.locator(".slide .part").last.hover()
    page.mouse.wheel(0, -4000)
    page.evaluate(GROWN)
    expect(newest).not_to_be_in_viewport()
    page.evaluate(INTERRUPTED)
    expect(page.locator(".slide .title")).to_be_in_viewport()


def test_a_remote_with_two_buttons_reaches_the_substeps(hall: Lecture) -> None:
    page = hall.page
    page.keyboard.press("t")
    expect(page).to_have_url(re.compile("pace=substeps"))
    page.keyboard.press("PageDown")
    expect(page.locator(".slide .part")).to_have_count(1)
    page.keyboard.press("PageUp")
    page.keyboard.press("PageUp")
    expect(page.locator(".slide .step")).to_have_attribute("data-step", "position:bob")
    page.keyboard.press("PageDown")
    for _ in range(4):
        page.keyboard.press("PageDown")
    expect(page.locator(".slide .step")).to_have_attribute("data-step", "total-differential:bob")


def test_jump_to_a_number_and_to_a_word(hall: Lecture) -> None:
    page = hall.page
    page.keyboard.press("g")
    page.locator("dialog.jump input").fill("3.2")
    page.keyboard.press("Enter")
    expect(page.locator("dialog")).to_have_count(0)
    expect(page.locator(".slide .number")).to_have_text("3.2")
    page.keyboard.press("g")
    page.locator("dialog.jump input").fill("lagrange function")
    expect(page.locator("dialog.jump li:visible")).to_have_count(1)
    page.keyboard.press("Enter")
    expect(page.locator(".slide .step")).to_have_attribute("data-step", "lagrangian")


def test_black_screen_pointer_and_what_stands_beside(hall: Lecture) -> None:
    page = hall.page
    page.keyboard.press("b")
    expect(page.locator(".black")).to_be_visible()
    page.keyboard.press("PageDown")
    expect(page.locator(".black")).to_have_count(0)
    assert hall.current_step == "virtual-displacement:bob"
    page.keyboard.press("h")
    expect(page.locator(".spot")).to_be_visible()
    page.keyboard.press("h")
    expect(page.locator(".spot")).to_be_hidden()
    expect(page.locator(".plots")).to_be_hidden()
    page.keyboard.press("d")
    expect(page.locator(".plots.ready")).to_be_visible()
    page.keyboard.press("d")
    expect(page.locator(".drawing")).to_be_hidden()
    page.keyboard.press("d")
    expect(page.locator(".drawing")).to_be_visible()


def test_the_variation_and_the_reason_are_there_in_a_lecture_too(hall: Lecture) -> None:
    page = hall.page
    page.keyboard.press("w")
    expect(page.locator(".slide .law .source")).to_contain_text("Lanczos")
    expect(page).to_have_url(re.compile("why=virtual-displacement"))
    page.keyboard.press("Escape")  # closes the law, and only then would open all steps
    expect(page.locator(".slide .law")).to_have_count(0)
    expect(page.locator("dialog[open]")).to_have_count(0)
    page.locator(".figure-tools button").first.click()
    total = page.locator(".virtual-panel .bars [data-load='']")
    expect(total).to_be_in_viewport(ratio=0.98)
    expect(page.locator("[data-slider^=delta-] input[type=range]")).to_have_count(3)  # δq₁, δq₂ and dt
    page.reload()
    expect(total).to_be_in_viewport(ratio=0.98)


SWIPE = """([element, from, to]) => {
    const touch = x => new Touch({identifier: 1, target: element, clientX: x, clientY: 400});
    element.dispatchEvent(new TouchEvent('touchstart', {touches: [touch(from)], bubbles: true}));
    element.dispatchEvent(new TouchEvent('touchend', {changedTouches: [touch(to)], bubbles: true}));
}"""


def test_a_swipe_turns_the_page(hall: Lecture) -> None:
    page = hall.page
    title = page.locator(".slide .title").element_handle()
    page.evaluate(SWIPE, [title, 300, 100])
    expect(page.locator(".slide .step")).to_have_attribute("data-step", "total-differential:bob")
    title = page.locator(".slide .title").element_handle()
    page.evaluate(SWIPE, [title, 100, 110])
    assert hall.current_step == "total-differential:bob"
    page.evaluate(SWIPE, [title, 100, 300])
    expect(page.locator(".slide .step")).to_have_attribute("data-step", "virtual-displacement:bob")


@pytest.mark.one_in(2)
@pytest.mark.parametrize(
    ("width", "height"),
    [
        pytest.param(360, 740, id="phone"),
        pytest.param(1024, 768, id="old projector"),
        pytest.param(3840, 2160, id="4K"),
    ],
)
def test_equations_fit_the_width_of_the_screen(hall: Lecture, width: int, height: int) -> None:
    page = hall.page
    page.set_viewport_size({"width": width, "height": height})
    page.goto(f"{hall.address}scene?scene=double-pendulum&lang=de&view=lecture&step=lagrangian")
    for step in ("lagrangian", "equation:phi1", "equation:phi2"):
        expect(page.locator(".slide .step")).to_have_attribute("data-step", step)
        expect(page.locator(".slide .formula .katex").first).to_be_visible()
        fits = "() => [...document.querySelectorAll('.slide .formula')].every(e => e.scrollWidth <= e.clientWidth + 1)"
        page.wait_for_function(fits)
        until_equal(page, lambda: page.evaluate("document.documentElement.scrollWidth"), width)
        page.keyboard.press("PageDown")


SAMPLE = {
    "pendulum": ["position:bob", "virtual-displacement:bob", "total-differential:bob"],
    "double-pendulum": ["lagrangian", "equation:phi1", "equation:phi2"],
}


@pytest.mark.one_in(2)
@pytest.mark.parametrize(
    ("width", "height"),
    [
        pytest.param(1024, 768, id="old projector"),
        pytest.param(1366, 768, id="projector"),
        pytest.param(3840, 2160, id="4K"),
    ],
)
def test_formulas_fill_the_slide(hall: Lecture, width: int, height: int) -> None:
    """Read from the last row, all on one screen; `python -m tests.e2e.slides` looks at every step of every scene."""
    page = hall.page
    page.set_viewport_size({"width": width, "height": height})
    found = []
    for scene, steps in SAMPLE.items():
        opened(page, hall.address, scene, steps[0])
        found += slides(page, steps)
    assert [slide.step for slide in found if not slide.fits or slide.sideways] == []
    assert share(found) >= 5 / 6
    assert max(slide.size for slide in found) <= 0.08


@pytest.mark.one_in(2)
@pytest.mark.parametrize(("width", "height"), [(1366, 768), (3840, 2160)])
def test_nothing_is_smaller_in_full_screen(hall: Lecture, width: int, height: int) -> None:
    page = hall.page
    page.set_viewport_size({"width": width, "height": height})
    step = hall.current_step
    (before,) = slides(page, [step])
    page.keyboard.press("PageUp")
    page.keyboard.press("f")
    page.wait_for_function("() => document.fullscreenElement !== null")
    (after,) = slides(page, [step])
    assert after.root >= before.root
    assert after.size >= 0.99 * before.size


def test_what_a_step_rests_on_stands_above_it(hall: Lecture) -> None:
    page = hall.page
    page.goto(f"{hall.address}scene?scene=elastic-pendulum&lang=en&view=lecture&step=equation:y")
    given = page.locator(".given")
    expect(given.locator(".formula .katex").last).to_be_in_viewport()
    expect(given.locator(".from")).to_have_text(["6.7", "7.1"])
    names = [one.get_attribute("aria-label") or "" for one in given.locator(".formula").all()]
    assert names[1].startswith("capital L equals")
    expect(page.locator(".slide .meanings .term-sign-turned")).to_be_in_viewport()
    given.locator("summary").click()
    expect(given.locator(".formula").first).to_be_hidden()
    page.keyboard.press("w")
    expect(page.locator(".slide .law .source")).to_be_in_viewport(ratio=0.98)
    given.locator("summary").click()
    given.locator(".from").first.click()
    expect(page.locator(".slide .step")).to_have_attribute("data-step", "decomposition")


def test_a_result_is_hidden_until_the_hall_has_chosen(hall: Lecture) -> None:
    page = hall.page
    page.goto(f"{hall.address}scene?scene=elastic-pendulum&lang=en&view=lecture&step=kinetic-energy-of-particle:bob")
    page.keyboard.press("q")  # as soon as the document is there: lecture mode may still be on its way
    expect(page.locator(".choices .katex").first).to_be_visible()
    expect(page.locator(".slide .result .formula")).to_have_count(0)
    count = page.locator(".choices li").count()
    assert 2 <= count <= 4
    expect(page.locator(".choices .hint")).to_have_count(0)
    page.keyboard.press("1")
    expect(page.locator(".choices .right")).to_have_count(1)
    expect(page.locator(".choices .hint")).to_have_count(count - 1)
    expect(page.locator(".slide .result .formula")).to_have_count(0)
    page.keyboard.press("Space")
    expect(page.locator(".slide .result .formula .katex").first).to_be_visible()
    assert hall.current_step == "kinetic-energy-of-particle:bob"
    page.keyboard.press("Space")  # nothing is known to be got wrong here, and it is hidden all the same
    expect(page.locator(".slide .step")).to_have_attribute("data-step", "cancellation-of-dots:bob")
    expect(page.locator(".slide .veil")).to_be_visible()
    page.keyboard.press("q")
    expect(page.locator(".slide .result .formula .katex").first).to_be_visible()


WATCH = """() => {
    window.flown = 0;
    const note = list => list.forEach(({addedNodes}) =>
        addedNodes.forEach(node => window.flown += node.matches('.flight')));
    new MutationObserver(note).observe(document.body, {childList: true});
}"""


@pytest.mark.smooth
@pytest.mark.parametrize("motion", ["no-preference", "reduce"])
def test_terms_fly_to_what_becomes_of_them(hall: Lecture, motion: Literal["no-preference", "reduce"]) -> None:
    page = hall.page
    page.emulate_media(reduced_motion=motion)
    opened(page, hall.address, "elastic-pendulum", "equation:y&part=3")
    page.locator(".slide[data-filled]").wait_for()
    page.evaluate(WATCH)
    page.keyboard.press("ArrowDown")
    expect(page.locator(".slide .result .term-sign-turned").first).to_be_visible()
    if motion == "reduce":
        frames(page, 20)
        assert page.evaluate("window.flown") == 0
    else:
        until(page, lambda: page.evaluate("window.flown"), lambda count: 0 < count <= 40)
    page.keyboard.press("ArrowUp")
    expect(page.locator(".flight")).to_have_count(0)


def test_the_presenter_calls_bodies_as_the_slide_does(hall: Lecture) -> None:
    """By numbers where their names are long, with what each of them stands for."""
    page = hall.page
    opened(page, hall.address, "quarter-car", "kinetic-energy")
    page.locator(".slide[data-filled]").wait_for()
    with page.context.expect_page() as beside:
        page.keyboard.press("s")
    now = beside.value.locator(".presenter .now")
    told = page.locator(".slide .numbered").all_text_contents()
    assert len(told) == 2
    expect(now.locator(".numbered")).to_have_text(told)
    result = page.locator(".slide .result .formula .katex-html").all_text_contents()
    until_equal(beside.value, now.locator(".formula .katex-html").all_text_contents, result)


def test_the_presenter_sees_what_comes_and_leads(hall: Lecture) -> None:
    page = hall.page
    with page.context.expect_page() as opened:
        page.keyboard.press("s")
    presenter = opened.value
    presenter.on("pageerror", lambda error: hall.complaints.append(f"exception: {error}"))
    expect(presenter.locator(".now .number")).to_have_text("2.1")
    expect(presenter.locator(".next .number")).to_have_text("2.2")
    presenter.locator("textarea").fill("Ask why time stands still.")
    presenter.locator(".presenter .main").click()
    expect(page.locator(".slide .step")).to_have_attribute("data-step", "total-differential:bob")
    expect(presenter.locator("textarea")).to_have_value("")
    presenter.keyboard.press("PageUp")
    expect(page.locator(".slide .step")).to_have_attribute("data-step", "virtual-displacement:bob")
    expect(presenter.locator("textarea")).to_have_value("Ask why time stands still.")
    page.keyboard.press("e")
    expect(presenter.locator(".now h4")).to_have_count(3)
    assert presenter.locator(".now .formula").count() == 4
    says = "all => all.map(one => one.ariaLabel)"  # in the same order, the result last, however their rows are broken
    slide = page.locator(".slide .scroll .formula").evaluate_all(says)
    assert all(slide)
    until_equal(presenter, lambda: presenter.locator(".now .formula").evaluate_all(says), slide)
    page.keyboard.press("e")
    page.keyboard.press("ArrowDown")
    expect(presenter.locator(".now h4")).to_have_count(1)
    page.keyboard.press("b")
    expect(presenter.locator(".now h2 strong")).to_be_visible()
    presenter.locator(".times .tool").click()
    expect(presenter.locator(".elapsed")).not_to_have_text("0:00")
    presenter.reload()
    expect(presenter.locator(".now .number")).to_have_text("2.1")
    page.reload()
    expect(page.locator(".slide .part")).to_have_count(1)
    page.keyboard.press("PageDown")
    expect(presenter.locator(".now .number")).to_have_text("2.2")


def test_the_general_proof_is_lectured_the_same_way(lecture: Lecture) -> None:
    page = lecture.page
    page.goto(f"{lecture.address}proof?lang=en")
    page.locator(".steps .katex").first.wait_for()  # the first proof of a server takes its time
    page.keyboard.press("l")
    expect(page.locator(".slide .number")).to_have_text("1.1")
    expect(page.locator(".top")).to_be_hidden()
    screen = {"x": 0, "y": 0, "width": 1366, "height": 768}
    until_equal(page, page.locator(".slide").bounding_box, screen)
    for key, number in (("PageDown", "1.2"), ("End", "7.2"), ("PageUp", "7.1"), ("Home", "1.1")):
        page.keyboard.press(key)
        expect(page.locator(".slide .number")).to_have_text(number)
    page.keyboard.press("g")
    page.locator("dialog.jump input").fill("4.1")
    page.keyboard.press("Enter")
    expect(page.locator(".slide .number")).to_have_text("4.1")
    page.keyboard.press("b")
    expect(page.locator(".black")).to_be_visible()
    page.keyboard.press("b")
    with page.context.expect_page() as opened:
        page.keyboard.press("s")
    presenter = opened.value
    expect(presenter.get_by_role("heading", level=1)).to_have_text("General proof")
    expect(presenter.locator(".now .number")).to_have_text("4.1")
    presenter.locator("textarea").fill("Inner forces do no work.")
    presenter.locator(".presenter .main").click()
    expect(page.locator(".slide .number")).to_have_text("5.1")
    page.reload()
    expect(page.locator(".slide .number")).to_have_text("5.1")
    page.keyboard.press("PageUp")
    expect(presenter.locator("textarea")).to_have_value("Inner forces do no work.")
    page.keyboard.press("l")
    expect(page.locator(".top")).to_be_visible()


def test_a_presenter_without_a_lecture_says_how_to_get_one(lecture: Lecture) -> None:
    lecture.page.goto(f"{lecture.address}presenter?lang=en")
    expect(lecture.page.locator(".presenter")).to_contain_text("No lecture is connected")
