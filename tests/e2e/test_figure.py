"""The figure taken in hand: varied, dragged, scrubbed, compared, and tied to the formulas."""

from __future__ import annotations

import math
import re

import pytest
from playwright.sync_api import Locator, Page, expect
from tests.e2e.lecture import Lecture
from tests.e2e.waiting import at_rest, until, until_equal

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


def middle_of(part: Locator) -> float:
    """Where it stands, in pixels from the left edge of the page."""
    box = part.bounding_box() or {"x": math.nan, "width": 0.0}
    return float(box["x"] + box["width"] / 2)


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


def drag(page: Page, start: tuple[float, float], end: tuple[float, float]) -> None:
    """From one place of the drawing to another, in pixels of its frame, with the hand still down."""
    box = at_rest(page.locator(".drawing"))
    page.mouse.move(box["x"] + start[0], box["y"] + start[1])
    page.mouse.down()
    page.mouse.move(box["x"] + (start[0] + end[0]) / 2, box["y"] + (start[1] + end[1]) / 2, steps=3)
    page.mouse.move(box["x"] + end[0], box["y"] + end[1], steps=3)


def test_the_bob_is_dragged_to_where_the_motion_begins(lecture: Lecture) -> None:
    """It follows the hand at once; both coordinates and the address follow, and the motion begins there."""
    page = open_at_rest(lecture, "?scene=elastic-pendulum&lang=en")
    x, y = lecture.bob_position()
    aim = (x - 90, y - 5)
    with page.expect_response("**/api/v1/simulations"):  # asked for on the way: it may be there before the hand lets go
        drag(page, (x, y), aim)
        until_equal(page, lecture.bob_position, pytest.approx(aim, abs=1.5))
    page.mouse.up()
    expect(page).to_have_url(re.compile(r"set=y:[-.\d]+:0%2Cphi:-?[.\d]+:0"))
    page.wait_for_timeout(400)
    assert lecture.bob_position() == pytest.approx(aim, abs=1.5)
    slider = page.locator("[data-slider=initial-phi-value] .decimal").input_value()
    page.reload()
    lecture.bob.wait_for(state="attached")
    until_equal(page, lecture.bob_position, pytest.approx(aim, abs=1.5))
    expect(page.locator("[data-slider=initial-phi-value] .decimal")).to_have_value(slider)


def test_a_place_is_moved_with_keys(lecture: Lecture) -> None:
    """The arrow keys move what has the focus, and turn no page."""
    page = open_at_rest(lecture, "?scene=elastic-pendulum&lang=en")
    before = lecture.bob_position()
    page.locator(".handle[data-place=bob]").focus()
    for _ in range(3):
        page.keyboard.press("ArrowRight")
    expect(page).to_have_url(re.compile("set="))
    until_equal(page, lambda: lecture.bob_position()[0], pytest.approx(before[0] + 24, abs=2))
    expect(lecture.steps).to_have_count(1)


def test_a_dragged_variation_leaves_the_motion_alone(lecture: Lecture) -> None:
    """While the variation is shown, the hand moves the ghost: δq changes, the initial values do not."""
    page = open_at_rest(lecture, "?scene=pendulum&lang=en&vary=phi:0.1,dt:0")
    x, y = lecture.bob_position()
    drag(page, (x, y), (x + 60, y - 20))
    page.mouse.up()
    variation = page.locator("[data-slider=delta-phi] input[type=range]")
    until(page, lambda: float(variation.input_value()), lambda found: found > 0.2)
    expect(page).not_to_have_url(re.compile("vary=phi:0.1,|vary=phi:0.1%2C"))
    assert lecture.bob_position() == (x, y)
    assert "set=" not in page.url


def test_runs_are_compared(lecture: Lecture) -> None:
    """Up to two motions stay beside the present one, in drawing, plots and legend; the address has them."""
    page = open_at_rest(lecture, "?scene=pendulum&lang=en")
    page.locator(".plots.ready").wait_for()
    keep = page.locator(".figure-tools").get_by_role("button", name="Keep this motion")
    length = page.locator("[data-slider=parameter-l-value] .decimal")
    for value in ("0.5", "1.5"):
        keep.click()
        length.fill(value)
        length.press("Tab")
    legend = page.locator(".runs li")
    expect(legend).to_have_count(3)
    expect(legend.nth(0)).to_contain_text("now")
    expect(page.locator("svg.beside .run-0.bob")).to_have_count(1)
    expect(page.locator("svg.beside .run-1.bob")).to_have_count(1)
    page.reload()
    expect(legend).to_have_count(3)
    legend.nth(1).get_by_role("button").click()
    expect(legend).to_have_count(2)
    expect(page.locator("svg.beside .run-1")).to_have_count(0)
    page.locator(".scene select").select_option("double-pendulum")
    expect(legend).to_have_count(0)


def test_energy_bars_paths_and_the_phase_portrait(lecture: Lecture) -> None:
    """Each is switched on by a button and by the address; a click on the curve leads to its moment."""
    page = open_at_rest(lecture, "?scene=pendulum&lang=en&with=bars,paths")
    expect(page.locator(".energies .column")).to_have_count(3)
    expect(page.locator("svg.paths path")).to_have_count(1)
    page.locator(".figure-tools").get_by_role("button", name="Phase portrait").click()
    expect(page).to_have_url(re.compile("with=bars%2Cpaths%2Cphase"))
    expect(page.locator(".phase path.curve")).to_have_count(1)
    portrait = page.locator(".phase")
    frame, curve = at_rest(portrait), at_rest(page.locator(".phase path.curve"))
    # By the portrait, not by the page: the click waits until nothing moves or covers it.
    left = curve["x"] - frame["x"]
    portrait.click(position={"x": left + 2, "y": curve["y"] - frame["y"] + curve["height"] / 2})
    until(page, lambda: middle_of(page.locator(".phase .state")) - at_rest(portrait)["x"], lambda x: abs(x - left) < 8)
    expect(page).to_have_url(re.compile(r"at=\d"))


def test_why_opens_the_law_and_what_changed(lecture: Lecture) -> None:
    """The law with its source, in both languages; sources light up when focused; changed terms are marked."""
    page = open_at_rest(lecture, "?scene=elastic-pendulum&lang=en&step=equation:phi")
    current = page.locator(".step[aria-current]")
    expect(current.locator(".formula .term-sign-turned").first).to_be_attached()
    expect(current.locator(".substeps .term-gone")).to_have_count(2)
    current.locator(".why").click()
    law = current.locator(".law")
    expect(law).to_contain_text("Lagrange’s equation of the second kind")
    expect(law.locator(".source")).to_contain_text("Goldstein")
    expect(law.locator(".changes")).to_contain_text("cancels")
    law.get_by_role("button", name="external force").focus()
    expect(page.locator(".drawing .arrow.load-drive.lit")).to_be_attached()
    expect(current.locator(".formula .load-drive.lit").first).to_be_attached()
    expect(page).to_have_url(re.compile("why=equation:phi"))
    page.locator(".segments [lang=de]").click()
    expect(law).to_contain_text("Lagrangesche Gleichung zweiter Art")


def test_pointing_works_both_ways(lecture: Lecture) -> None:
    """A body in the drawing lights up its terms; a coordinate in a formula lights up its curve and its slider."""
    page = open_at_rest(lecture, "?scene=elastic-pendulum&lang=en&step=equation:phi&with=bars")
    page.locator(".plots.ready").wait_for()
    lecture.bob.dispatch_event("pointerover")
    expect(page.locator(".step[aria-current] .formula .body-bob.lit").first).to_be_attached()
    page.locator(".step[aria-current] .formula .katex-html .q-1").first.dispatch_event("pointerover")
    expect(page.locator(".plots .trace.q-1.lit")).to_have_count(1)
    expect(page.locator(".row.q-1.lit").first).to_be_attached()
    page.locator(".step[aria-current] .formula .katex-html .of-q_1").first.dispatch_event("pointerover")
    expect(page.locator(".drawing .load-drive.lit").first).to_be_attached()  # Q₂ is of the coordinate and its loads
    expect(page.locator(".drawing .q-1.lit").first).to_be_attached()
    page.locator(".energies .energy-kinetic").dispatch_event("pointerover")
    expect(page.locator(".plots .trace.energy-kinetic.lit")).to_have_count(1)


def test_a_multiplier_shows_what_keeps_its_constraint(lecture: Lecture) -> None:
    """Pointing at S lights the rod and its curve, and its reaction appears where the rod pulls; the rod lights S."""
    page = open_at_rest(lecture, "?scene=cartesian-pendulum&lang=en&step=work-of-reaction:rod&with=bars")
    page.locator(".plots.ready").wait_for()
    page.locator(".energies").wait_for(state="attached")
    letter = page.locator(".step[aria-current] .formula .katex-html .q-2.vector-z").first
    letter.dispatch_event("pointerover")
    expect(page.locator(".drawing .rod.constraint-rod.lit").first).to_be_attached()
    expect(page.locator(".plots .trace.q-2.lit")).to_have_count(1)
    expect(page.locator(".vectors .vector-z.constraint-rod")).not_to_have_count(0)
    page.locator(".drawing .rod.constraint-rod").first.dispatch_event("pointerover")
    expect(page.locator(".vectors .vector-z")).to_have_count(0)
    expect(letter).to_have_class(re.compile(r"\blit\b"))


@pytest.mark.smooth
def test_nothing_shifts_while_the_figure_is_used(lecture: Lecture) -> None:
    """Steps with their marks, the instruments that come, a variation: none of them moves what was there."""
    lecture.page.emulate_media(reduced_motion="reduce")
    lecture.open("?scene=elastic-pendulum&lang=en")
    page = lecture.page
    page.locator(".plots.ready").wait_for()
    page.evaluate(
        "window.shift = 0; new PerformanceObserver(list => list.getEntries().forEach(e => window.shift += e.value))"
        ".observe({type: 'layout-shift'})"
    )
    page.locator(".drawing").hover(position={"x": 5, "y": 5})
    page.locator(".figure-tools button").first.wait_for()
    for _ in range(26):
        page.keyboard.press("ArrowRight")
        page.wait_for_timeout(30)
    page.locator(".figure-tools button").first.click()
    page.wait_for_timeout(300)
    assert page.evaluate("window.shift") < 0.02


def test_one_picture_at_a_time(lecture: Lecture) -> None:
    """Steps go on and back by a twenty-fifth of a second, and stop the motion."""
    page = open_at_rest(lecture, "?scene=pendulum&lang=en&at=1")
    page.locator(".plots.ready").wait_for()
    plots = at_rest(page.locator(".plots"))
    # The plots show the moment, too.
    shown = (plots["x"] + 0.1 * plots["width"], plots["x"] + 0.2 * plots["width"])
    until(page, lambda: middle_of(page.locator(".cursor")), lambda x: shown[0] < x < shown[1])
    page.get_by_role("button", name="One picture on").click()
    expect(page.locator(".time")).to_have_text("1.04 s")
    for _ in range(2):
        page.get_by_role("button", name="One picture back").click()
    expect(page.locator(".time")).to_have_text("0.96 s")
    expect(page).to_have_url(re.compile("at=0.96"))


def test_a_number_beyond_the_range_of_the_scene_is_told(lecture: Lecture) -> None:
    lecture.open("?scene=elastic-pendulum&lang=en&set=l:3")
    length = lecture.page.locator("[data-slider=parameter-l-value]")
    expect(length.locator(".hint")).to_have_text("Outside of 0.2 … 2.")
    length.locator(".decimal").fill("7")
    length.locator(".decimal").press("Enter")
    expect(length.locator(".hint")).to_have_text("7 is out of range: 0.2 … 2.")
    expect(length.locator(".decimal")).to_have_value("2")
    length.locator(".decimal").fill("1.5")
    length.locator(".decimal").press("Enter")
    expect(length.locator(".hint")).to_have_text("")


@pytest.mark.parametrize(
    ("query", "stress", "label"),
    [
        pytest.param("scene=pendulum&release=l", "tension", "S", id="a rod hangs"),
        pytest.param("scene=pendulum&release=l&set=phi:3:0", "thrust", "S", id="a rod stands"),
        pytest.param("scene=kapitza&release=y", None, "Z", id="a guide is no rod"),
    ],
)
def test_what_holds_the_released_is_drawn(lecture: Lecture, query: str, stress: str | None, label: str) -> None:
    """The arrow is there without a tool, and the rod has the colour of tension or thrust."""
    lecture.page.emulate_media(reduced_motion="reduce")
    lecture.open(f"?{query}&lang=en")
    page = lecture.page
    expect(page.locator(".drawing .vector-h").first).to_be_attached()
    expect(page.locator(".drawing .stress")).to_have_count(0 if stress is None else 1)
    if stress is not None:
        expect(page.locator(f".drawing .stress.{stress}")).to_have_count(1)
    expect(page.locator(".labels .vector-h").first).to_contain_text(label)
