"""The main job, in a real browser: read, reveal, watch, change, share."""

from __future__ import annotations

import re
from urllib.parse import parse_qs, urlsplit

import pytest
from playwright.sync_api import Page, Request, expect
from tests.e2e.lecture import Lecture
from tests.e2e.waiting import at_rest, frames, until, until_equal

pytestmark = pytest.mark.e2e

BYTES_BEFORE_FIRST_PLOT = 300_000
STATED_AND_NOT = {"multiplier:edge": 1, "left-out:integrals": 0}
SCENES = ("elastic-pendulum", "base-pendulum", "guided-pendulum", "pendulum")


def query_of(page: Page) -> dict[str, str]:
    return {key: values[0] for key, values in parse_qs(urlsplit(page.url).query).items()}


def parameters_of(request: Request) -> object:
    """What a simulation was asked for with; None for any other request."""
    if not request.url.endswith("/api/v1/simulations"):
        return None
    return (request.post_data_json or {}).get("parameters")


@pytest.mark.one_in(2)
@pytest.mark.parametrize("scene", SCENES)
def test_all_steps_are_revealed_and_typeset(lecture: Lecture, scene: str) -> None:
    lecture.open(f"?scene={scene}&lang=de")
    total = lecture.number_of_steps()
    assert total > 5
    expect(lecture.steps).to_have_count(1)
    for shown in range(2, total + 1):
        lecture.page.keyboard.press("ArrowRight")
        expect(lecture.steps).to_have_count(shown)
    until(lecture.page, lecture.page.locator(".step .formula .katex").count, lambda count: count >= total - 2)
    expect(lecture.page.locator(".untypeset, .katex-error, .step .doubtful")).to_have_count(0)


def test_no_formula_is_wider_than_its_column(lecture: Lecture) -> None:
    """Not even when it was measured before its fonts had come; far steps and closed details are typeset in the end."""
    lecture.open("?scene=elastic-pendulum&lang=en&theme=projector&step=equation:phi")
    cut = "e => e.scrollWidth > e.clientWidth + 1"
    lecture.page.wait_for_function(f"() => ![...document.querySelectorAll('.step:not(.far) .formula')].some({cut})")
    empty = lecture.page.locator(".formula:empty, .step .math:empty")
    expect(empty).to_have_count(0)
    details = lecture.page.locator(".step:not(.far) details").last
    details.locator("summary").first.click()
    expect(details.locator(".formula .katex").first).to_be_visible()


# Formulas that are cut, and letters that nobody can read; lines in fractions have letters without width.
UNREADABLE = """(step) => [...step.querySelectorAll('.formula')].filter(e => e.checkVisibility()).flatMap((formula) => {
    const letters = [...formula.querySelectorAll('.katex-html .mord')].filter((one) => !one.children.length);
    const smallest = Math.min(...letters.map((one) => parseFloat(getComputedStyle(one).fontSize)));
    const over = formula.scrollWidth - formula.clientWidth;
    return over > 1 || smallest < 7.5 ? [`${over} px too wide, letters of ${smallest} px`] : [];
})"""


@pytest.mark.one_in(4)
@pytest.mark.parametrize("width", [1366, 390])
@pytest.mark.parametrize("step", ["constraint-rates", "augmented-system"])
@pytest.mark.parametrize(
    ("scene", "constraint"),
    [
        pytest.param("four-bar", "loopx", id="four-bar"),
        pytest.param("slider-crank", "across", id="slider-crank"),
        pytest.param("double-pendulum-by-rods", "rod2", id="rods"),
        pytest.param("cartesian-pendulum", "rod", id="rod"),
        pytest.param("chaplygin-sleigh", "edge", id="sleigh"),
        pytest.param("rolling-disc-in-space", "rollx", id="disc"),
    ],
)
def test_formulas_of_constraints_fit_and_can_be_read(
    lecture: Lecture, scene: str, constraint: str, step: str, width: int
) -> None:
    """Of columns that are narrow, in the language whose words are long."""
    lecture.page.set_viewport_size({"width": width, "height": 844})
    named = step if step == "augmented-system" else f"{step}:{constraint}"
    lecture.page.goto(f"{lecture.address}scene?scene={scene}&lang=de&step={named}")
    lecture.await_last_chapter()
    shown = lecture.page.locator(f'[data-step="{named}"]')
    expect(shown.locator(".formula .katex").first).to_be_visible()
    until_equal(lecture.page, lambda: shown.evaluate(UNREADABLE), [])


def test_nothing_shifts_when_steps_appear(lecture: Lecture) -> None:
    lecture.page.emulate_media(reduced_motion="reduce")
    lecture.open()
    lecture.page.locator(".plots.ready").wait_for()
    lecture.page.evaluate(
        "window.shift = 0; new PerformanceObserver(list => list.getEntries().forEach(e => window.shift += e.value))"
        ".observe({type: 'layout-shift'})"
    )
    for shown in range(2, 10):
        lecture.page.keyboard.press("ArrowRight")
        expect(lecture.steps.nth(shown - 1).locator(".katex").first).to_be_attached()
        frames(lecture.page, 4)
    assert lecture.page.evaluate("window.shift") < 0.01


def test_keys_as_in_a_lecture(lecture: Lecture) -> None:
    lecture.open()
    press = lecture.page.keyboard.press
    for key, shown in (("Space", 2), ("n", 3), ("ArrowRight", 4), ("p", 3), ("ArrowLeft", 2), ("Home", 1)):
        press(key)
        expect(lecture.steps).to_have_count(shown)
    press("End")
    expect(lecture.steps).to_have_count(lecture.number_of_steps())
    press("b")
    expect(lecture.page.locator(".black")).to_be_visible()
    press("b")
    expect(lecture.page.locator(".black")).to_have_count(0)
    press("Escape")
    expect(lecture.page.locator("dialog.overview")).to_be_visible()
    press("Escape")
    expect(lecture.page.locator("dialog.overview")).to_have_count(0)


def test_keys_in_a_field_belong_to_the_field(lecture: Lecture) -> None:
    lecture.open()
    lecture.page.locator("[data-slider=parameter-l-value] input[type=range]").press("ArrowRight")
    lecture.page.locator("[data-slider=parameter-l-value] .decimal").press("n")
    expect(lecture.steps).to_have_count(1)


def test_the_bob_moves_and_rests(lecture: Lecture) -> None:
    lecture.open()
    expect(lecture.bob).not_to_have_attribute("transform", lecture.bob.get_attribute("transform") or "")
    lecture.page.keyboard.press("k")
    frames(lecture.page, 1)
    resting = lecture.bob_position()
    frames(lecture.page, 12)
    assert lecture.bob_position() == resting


# Written while the motion runs: classes and nodes outside the drawing, for which the whole page finds its styles anew.
WRITTEN = """seconds => new Promise(done => {
    const found = new Set();
    const note = ({type, target, attributeName}) => {
        const drawn = target.closest?.('.drawing > svg, .labels');
        if (!drawn && (type === 'childList' || attributeName === 'class')) found.add(`${type} ${target.className}`);
    };
    const observer = new MutationObserver(records => records.forEach(note));
    observer.observe(document.body, {subtree: true, childList: true, attributes: true});
    setTimeout(() => { observer.disconnect(); done([...found]) }, 1000 * seconds);
})"""


def test_a_moving_picture_leaves_the_styles_of_the_page_alone(lecture: Lecture) -> None:
    """With the plots and the instruments open, frames only move things, and write digits into texts that are there."""
    lecture.open()
    lecture.page.locator(".plots.ready").wait_for()
    lecture.page.locator(".drawing").hover(position={"x": 5, "y": 5})
    lecture.page.locator(".figure-tools button").first.wait_for()
    before = lecture.bob_position()
    # The page may still be finishing: what every frame writes is found again and again.
    assert any(lecture.page.evaluate(WRITTEN, 0.4) == [] for _ in range(20))
    assert lecture.bob_position() != before


def test_reduced_motion_begins_at_rest(lecture: Lecture) -> None:
    lecture.page.emulate_media(reduced_motion="reduce")
    lecture.open()
    lecture.page.locator(".plots.ready").wait_for()
    before = lecture.bob_position()
    frames(lecture.page, 12)
    assert lecture.bob_position() == before


def test_a_slider_changes_the_trajectory(lecture: Lecture) -> None:
    lecture.open()
    lecture.pause_at(0.0)
    start = lecture.bob_position()
    slider = lecture.page.locator("[data-slider=parameter-l-value] .decimal")
    # What was asked for when the page opened may still come in.
    with lecture.page.expect_response(lambda answer: parameters_of(answer.request) == {"l": 0.5}):
        slider.fill("0.5")
        slider.press("Tab")
    expect(lecture.bob).not_to_have_attribute("transform", f"translate({start[0]:.2f} {start[1]:.2f})")
    with lecture.page.expect_response("**/api/v1/simulations"):
        lecture.page.locator(".values .heading button").click()
    expect(lecture.bob).to_have_attribute("transform", f"translate({start[0]:.2f} {start[1]:.2f})")


def test_a_number_that_is_being_typed_stays_whatever_comes_in_between(lecture: Lecture) -> None:
    lecture.open("?scene=pendulum&lang=en")
    field = lecture.page.locator("[data-slider=parameter-l-value] .decimal")
    field.fill("0.5")
    lecture.page.emulate_media(color_scheme="dark")  # the page is rendered anew
    expect(lecture.page.locator("html")).to_have_attribute("data-theme", "dark")
    expect(field).to_have_value("0.5")
    # What was asked for when the page opened, and again with more samples, may still come in.
    wanted = "/api/v1/simulations"
    with lecture.page.expect_request(lambda asked: asked.url.endswith(wanted) and '"l":0.5' in (asked.post_data or "")):
        field.press("Tab")


def test_a_deep_link_leads_to_the_same_place(lecture: Lecture) -> None:
    lecture.open("?scene=guided-pendulum&lang=en")
    for _ in range(4):
        lecture.page.keyboard.press("ArrowRight")
    expect(lecture.steps).to_have_count(5)
    step = lecture.current_step
    until_equal(lecture.page, lambda: query_of(lecture.page), {"scene": "guided-pendulum", "step": step, "lang": "en"})
    address = lecture.page.url
    lecture.page.goto("about:blank")
    lecture.page.goto(address)
    expect(lecture.steps).to_have_count(5)
    expect(lecture.page.locator(".step[aria-current]")).to_have_attribute("data-step", step)
    expect(lecture.page.locator(".step[aria-current] .title")).to_be_in_viewport()


def test_what_is_only_said_is_not_called_verified(lecture: Lecture) -> None:
    lecture.open("?scene=chaplygin-sleigh&lang=en&step=left-out:integrals")
    verdicts = {name: lecture.page.locator(f".step[data-step='{name}'] .verdict") for name in STATED_AND_NOT}
    for name, verdict in verdicts.items():
        expect(lecture.page.locator(f".step[data-step='{name}']")).to_be_attached()
        expect(verdict).to_have_count(STATED_AND_NOT[name])


def test_the_language_changes_everything_and_keeps_the_place(lecture: Lecture) -> None:
    lecture.open("?scene=elastic-pendulum&lang=de&step=kinetic-energy")
    step = lecture.current_step
    title = lecture.page.locator(".step[aria-current] .title span").first
    german = title.text_content() or ""
    expect(lecture.page.locator(".pager .main")).to_contain_text("Weiter")
    lecture.page.locator(".segments [lang=en]").click()
    expect(lecture.page.locator(".pager .main")).to_contain_text("Next")
    expect(title).not_to_have_text(german)
    expect(lecture.page.locator("html")).to_have_attribute("lang", "en")
    expect(lecture.page.locator(".step[aria-current]")).to_have_attribute("data-step", step)


def test_another_scene_begins_at_its_first_step(lecture: Lecture) -> None:
    lecture.open("?scene=elastic-pendulum&lang=de&step=kinetic-energy")
    lecture.page.locator(".scene select").select_option("pendulum")
    expect(lecture.steps).to_have_count(1)
    expect(lecture.page).to_have_url(re.compile("scene=pendulum"))
    expect(lecture.page.locator(".readouts > div")).to_have_count(1)


def test_a_formula_that_is_scrolled_to_fits_its_column(lecture: Lecture) -> None:
    """Out of sight it has no width yet."""
    lecture.open("?scene=elastic-pendulum&lang=en&theme=projector&step=equation:phi")
    lecture.page.locator(".formula:empty").first.wait_for(state="detached")
    steps = lecture.page.locator(".step.far")
    for index in range(steps.count()):
        steps.nth(index).evaluate("e => e.scrollIntoView()")
        formula = steps.nth(index).locator("> .formula").first.element_handle()
        lecture.page.wait_for_function("e => e.scrollWidth <= e.clientWidth + 1", arg=formula)


def test_the_plot_and_the_drawing_share_a_clock(lecture: Lecture) -> None:
    lecture.page.emulate_media(reduced_motion="reduce")  # nothing moves by itself
    lecture.open()
    lecture.page.locator(".plots.ready").wait_for()
    assert lecture.page.locator(".plots .scatterlayer .trace").count() >= 5
    box = at_rest(lecture.page.locator(".plots"))
    time = lecture.page.locator(".time")
    for part in (0.3, 0.8):
        before, place = time.text_content() or "", lecture.bob.get_attribute("transform") or ""
        lecture.page.mouse.click(box["x"] + box["width"] * part, box["y"] + box["height"] * 0.5)
        expect(time).not_to_have_text(before)
        expect(lecture.bob).not_to_have_attribute("transform", place)


def test_one_quantity_has_one_colour(lecture: Lecture) -> None:
    lecture.open()
    lecture.page.locator(".plots.ready").wait_for()
    # Found and asked in one go, in the first frame that has it: the drawing may replace a path at any time.
    colour = """place => new Promise(done => {
        const look = () => {
            const found = document.querySelector(place);
            if (found) done(getComputedStyle(found).color); else requestAnimationFrame(look);
        };
        look();
    })"""
    places = (".formula .q-1", ".labels .q-1", ".drawing path.q-1", ".legend .q-1", ".row.q-1", ".readouts .q-1")
    colours = {place: lecture.page.evaluate(colour, place) for place in places}
    assert len(set(colours.values())) == 1, colours


def test_a_phone_does_not_scroll_sideways(lecture: Lecture) -> None:
    lecture.page.set_viewport_size({"width": 360, "height": 740})
    lecture.open()
    lecture.page.keyboard.press("End")
    for panel in range(3):
        lecture.page.locator(".panels button").nth(panel).click()
        until_equal(lecture.page, lambda: lecture.page.evaluate("document.documentElement.scrollWidth"), 360)
        expect(lecture.bob).to_be_in_viewport()
    wide = "[...document.querySelectorAll('#page *')].filter(e => e.getBoundingClientRect().right > 361 "
    wide += "&& !e.closest('.chapters, .formula, .unseen, dialog')).map(e => e.className)"
    until_equal(lecture.page, lambda: lecture.page.evaluate(wide), [])


@pytest.mark.parametrize("lang", ["de", "en"])
def test_what_is_chosen_can_be_read(lecture: Lecture, lang: str) -> None:
    """No list that shows its choice cuts it off; the scene's title has lines of its own."""
    lecture.open(f"?scene=chaplygin-sleigh&lang={lang}")
    expect(lecture.page.locator(".release .chosen")).to_be_visible()
    cut = """() => [...document.querySelectorAll('.choice:not(.scene *)')].map((choice) => {
        const list = choice.querySelector('select'), shown = choice.querySelector('.chosen') ?? list;
        const style = getComputedStyle(shown), text = list === shown ? list.selectedOptions[0].text : shown.textContent;
        const context = document.createElement('canvas').getContext('2d');
        context.font = style.font;
        const room = shown.clientWidth - parseFloat(style.paddingLeft) - parseFloat(style.paddingRight);
        return [text, choice.offsetWidth ? context.measureText(text).width - room : 0];
    }).filter(([, over]) => over > 1)"""
    for width in (390, 1024, 1366, 1920):
        lecture.page.set_viewport_size({"width": width, "height": 800})
        frames(lecture.page, 2)
        until_equal(lecture.page, lambda: lecture.page.evaluate(cut), [])


def test_an_unknown_scene_is_said_in_sentences(page: Page, server: str) -> None:
    page.goto(f"{server}scene?scene=no-such-scene&lang=de")
    failure = page.locator(".derivation .failure")
    expect(failure.locator("h2")).to_contain_text("Diese Szene gibt es nicht")
    failure.get_by_text("Mathematisches Pendel").click()
    expect(page.locator(".steps > .step")).to_have_count(1)
    expect(failure).to_have_count(0)


@pytest.mark.usefixtures("bundle")
def test_bytes_before_the_first_plot(lecture: Lecture) -> None:
    before = lecture.bytes_before_the_first_plot()
    total = sum(before.values())
    print(f"{len(before)} requests, {total} bytes before the first plot")
    assert len(before) > 10
    assert total < BYTES_BEFORE_FIRST_PLOT, sorted(before.items(), key=lambda entry: -entry[1])


@pytest.mark.usefixtures("bundle")
def test_requests_of_a_first_and_of_a_second_visit(lecture: Lecture) -> None:
    """On the second visit what names its content or its version is not asked for again."""
    visits = []
    for _ in range(2):
        with lecture.asked() as asked:
            lecture.open()
            lecture.page.locator(".plots.ready").wait_for()
            lecture.page.wait_for_load_state("networkidle")
        visits.append(asked)
    first, second = visits
    print(f"{len(first)} requests, then {len(second)}")
    assert 10 < len(first) <= 40, first
    assert 0 < len(second) <= 5, second


def test_a_chain_of_another_length_is_another_scene(lecture: Lecture) -> None:
    lecture.open("?scene=chain-pendulum&lang=en&n=3")
    size = lecture.page.locator("[data-slider='size'] .decimal")
    expect(size).to_have_value("3")
    expect(lecture.page.locator("svg .bob")).to_have_count(3)
    size.fill("2")
    size.press("Enter")
    expect(lecture.page.locator("svg .bob")).to_have_count(2)
    expect(lecture.page.locator(".top h1")).to_contain_text("Chain pendulum of 2 links")
    expect(lecture.page).to_have_url(re.compile("n=2"))


def test_two_formulations_with_addresses(lecture: Lecture) -> None:
    """Hamilton's principle is one choice away, can be linked to, and ends in the same equations."""
    lecture.open("?scene=elastic-pendulum&lang=en&step=equation:phi")
    expect(lecture.page.locator(".step[aria-current]")).to_have_attribute("data-step", "equation:phi")
    # What it says: which terms are marked depends on the step before, and that on the formulation.
    equation = lecture.page.locator("[data-step='equation:phi'] .formula").first
    by_work = equation.get_attribute("aria-label")
    assert by_work
    lecture.page.locator(".formulation select").select_option("hamilton")
    chapters = lecture.page.locator(".chapters")
    expect(chapters).to_contain_text("Hamilton’s principle")
    expect(lecture.page).to_have_url(re.compile("formulation=hamilton"))
    until_equal(lecture.page, lambda: equation.get_attribute("aria-label"), by_work)
    lecture.page.reload()
    expect(chapters).to_contain_text("Hamilton’s principle")
    expect(lecture.page.locator(".formulation select")).to_have_value("hamilton")


def test_terms_light_up_what_they_come_from(lecture: Lecture) -> None:
    """A term of the equation of motion points at its load or body in the drawing."""
    lecture.open("?scene=elastic-pendulum&lang=en&step=equation:phi")
    equation = lecture.page.locator("[data-step='equation:phi'] .formula .katex-html").first
    drawing = lecture.page.locator(".drawing")
    for source in ("load-drive", "body-bob"):
        equation.locator(f".{source}").last.dispatch_event("pointerover")
        expect(drawing.locator(f".lit.{source}").first).to_be_attached()
    expect(drawing.locator(".lit.load-drive")).to_have_count(0)
