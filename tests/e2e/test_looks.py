"""What a designer would see at once, on every page, from a phone to a projector."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Browser, Page, expect
from tests.e2e.lecture import Lecture
from tests.e2e.waiting import PATIENCE, frames, until, until_equal

pytestmark = pytest.mark.e2e

SIZES = ((360, 740), (768, 1024), (1000, 700), (1280, 720), (1920, 1080))
# The scene with the longest title.
LONG = "scene=elastic-pendulum"
PAGES = [
    pytest.param("?", ".hero path.bob", id="start"),
    pytest.param(f"scene?{LONG}&step=work-of-force:weight", ".steps .katex", id="scene"),
    pytest.param(f"scene?{LONG}&view=lecture&step=virtual-displacement:bob", ".slide .katex", id="lecture mode"),
    pytest.param("scene?scene=pendulum&edit=form", ".editor .field .katex", id="editor"),
    pytest.param("variations?", ".steps .katex", id="variations"),
    pytest.param("proof?", ".steps .katex", id="proof"),
    pytest.param("labs?", ".question button.main:enabled", id="labs"),
    pytest.param(f"homework?{LONG}", ".question h2", id="homework"),
    pytest.param(f"homework?{LONG}&side=sheet", ".catalogue .katex", id="sheet in the making"),
    pytest.param("lecture?shipped=1", ".stop", id="outline of a lecture"),
    pytest.param("docs?", ".calls article", id="reference"),
    pytest.param("docs/try?", ".trial textarea", id="trial"),
    pytest.param("problems/invalid-request?", ".top ~ .problem pre", id="problem"),
    pytest.param("help?", ".guide article", id="help"),
    pytest.param(f"handout?{LONG}", ".paper .katex", id="handout"),
    pytest.param("presenter?x=1", ".notice", id="presenter"),
]
# Words that go on behind an edge where nothing scrolls.
CUT = """() => {
    const LABELS = 'h1:not(:has(select)), h2, h3, h1 .chosen, button, summary, legend, label, nav a';
    const has = (style, ...kinds) => kinds.includes(style.overflowX) || kinds.includes(style.overflowY);
    const seen = (node) => !node.parentElement.closest('.unseen, .katex-mathml, select') && node.data.trim();
    function rectsOf(element) {
        const walker = document.createTreeWalker(element, NodeFilter.SHOW_TEXT);
        const range = document.createRange();
        const rects = [];
        while (walker.nextNode()) {
            if (!seen(walker.currentNode)) continue;
            range.selectNodeContents(walker.currentNode);
            rects.push(...range.getClientRects());
        }
        return rects;
    }
    const beyond = (frame) => (text) => text.right > frame.right + 1.5 || text.left < frame.left - 1.5
        || text.bottom > frame.bottom + text.height / 4 || text.top < frame.top - text.height / 4;
    function cut(element) {
        const rects = rectsOf(element);
        for (let around = element; around && around !== document.body; around = around.parentElement) {
            const style = getComputedStyle(around);
            if (has(style, 'hidden', 'clip')) return rects.some(beyond(around.getBoundingClientRect()));
            if (has(style, 'auto', 'scroll')) return false;
        }
        return rects.some((text) => text.right > innerWidth + 1 || text.left < -1);
    }
    return [...document.querySelectorAll(LABELS)]
        .filter((element) => element.checkVisibility() && !element.closest('.unseen') && cut(element))
        .map((element) => `${element.tagName} ${element.className}: ${element.textContent.trim()}`);
}"""

# Menus cut off what hangs below a line that is hardly higher than its letters.
TIGHT = """() => [...document.querySelectorAll('select')].filter((element) => {
    const { lineHeight, fontSize } = getComputedStyle(element);
    return element.checkVisibility() && !element.closest('h1') && parseFloat(lineHeight) < 1.2 * parseFloat(fontSize);
}).map((element) => element.outerHTML.slice(0, 80))"""


@pytest.mark.one_in(8)
@pytest.mark.parametrize("language", ["de", "en"])
@pytest.mark.parametrize(("place", "ready"), PAGES)
def test_no_heading_and_no_label_is_cut(lecture: Lecture, place: str, ready: str, language: str) -> None:
    page = lecture.page
    page.emulate_media(reduced_motion="reduce")
    page.goto(f"{lecture.address}{place}&lang={language}")
    page.locator(ready).first.wait_for(state="attached")
    for width, height in SIZES:
        page.set_viewport_size({"width": width, "height": height})
        frames(page, 2)
        until_equal(page, lambda: page.evaluate(CUT), [])
    assert page.evaluate(TIGHT) == []


def test_a_cut_title_is_found(lecture: Lecture) -> None:
    """The test above is able to fail."""
    lecture.open(f"?{LONG}&lang=en")
    lecture.page.add_style_tag(content=".chosen { max-width: 5rem }")
    assert "SPAN chosen: Elastically suspended pendulum with an external force" in lecture.page.evaluate(CUT)


def rows_of(page: Page, keys: str) -> list[int]:
    """How many keys stand in each row, from the first to the last."""
    tops: list[float] = page.locator(keys).evaluate_all("keys => keys.map(key => key.getBoundingClientRect().top)")
    return [tops.count(top) for top in sorted(set(tops))]


@pytest.mark.one_in(2)
@pytest.mark.parametrize("task", ["equation:phi", "position:bob", "eigenfrequencies"])
def test_no_key_stands_alone(lecture: Lecture, task: str) -> None:
    page = lecture.page
    page.goto(f"{lecture.address}homework?scene=pendulum&task={task}&lang=en")
    page.locator(".keyboard .katex").first.wait_for()
    for width in (360, 412, 768, 1366):
        page.set_viewport_size({"width": width, "height": 800})
        frames(page, 2)
        until(page, lambda: rows_of(page, ".keyboard > .keys .key-cap"), lambda rows: min(rows) > 1)


def test_a_dialog_on_a_phone_keeps_its_margins(lecture: Lecture) -> None:
    page = lecture.page
    page.set_viewport_size({"width": 360, "height": 740})
    lecture.open(f"?{LONG}&lang=de")
    for key, dialog in (("g", "jump"), ("o", "overview"), ("?", "help")):
        page.keyboard.press(key)
        opened = page.locator(f"dialog.{dialog}")
        expect(opened).to_be_visible()
        assert opened.evaluate("e => [e.scrollLeft, e.scrollWidth - e.clientWidth]") == [0, 0], dialog
        page.keyboard.press("Escape")
        expect(page.locator("dialog")).to_have_count(0)


def test_a_page_without_its_texts_waits_for_them_and_shows_its_name(page: Page, server: str) -> None:
    catalogs = "**/api/v1/catalogs/**"
    page.route(catalogs, lambda route: route.abort())
    page.goto(f"{server}homework?lang=en")
    page.wait_for_timeout(1500)
    name = "getComputedStyle(document.getElementById('page'), '::before')"
    assert page.evaluate(f"{name}.content") == '"δq"'
    until_equal(page, lambda: page.evaluate(f"{name}.opacity"), "1")
    page.unroute(catalogs)
    expect(page.locator(".question h2")).to_be_visible()
    assert page.evaluate(f"{name}.content") == "none"


# What is pressed, and how far the press reaches: a part drawn around it takes it, too.
REACH = """() => {
    const reach = (element) => {
        const box = element.getBoundingClientRect();
        const after = getComputedStyle(element, '::after');
        const more = (side) => after.position === 'absolute' ? Math.max(0, -parseFloat(after[side]) || 0) : 0;
        return Math.round(box.height + more('top') + more('bottom'));
    };
    return [...document.querySelectorAll('button:not(.handle), summary, .choice select, input[type=range]')]
        .filter((element) => element.checkVisibility() && !element.closest('.unseen, h1') && reach(element) < 42)
        .map((element) => `${element.className} ${element.textContent.trim().slice(0, 20)}: ${reach(element)}`);
}"""


@pytest.mark.one_in(7)
@pytest.mark.parametrize(("place", "ready"), PAGES)
def test_a_thumb_meets_what_it_presses(browser: Browser, server: str, place: str, ready: str) -> None:
    context = browser.new_context(viewport={"width": 360, "height": 740}, has_touch=True, is_mobile=True)
    context.set_default_timeout(PATIENCE)
    page = context.new_page()
    page.goto(f"{server}{place}&lang=de")
    page.locator(ready).first.wait_for(state="attached")
    until_equal(page, lambda: page.evaluate(REACH), [])
    context.close()


# Boxes to tick, and arrows of lists, in the size of the text beside them.
SIZE_OF_CONTROLS = """() => {
    const text = (element) => parseFloat(getComputedStyle(element).fontSize);
    const tick = document.querySelector('.labs .tick input');
    const list = document.querySelector('.labs .side select');
    return [tick.getBoundingClientRect().height / text(tick.parentElement),
        parseFloat(getComputedStyle(list).backgroundSize) / text(list), text(list)];
}"""


def test_boxes_and_arrows_grow_with_the_text(lecture: Lecture) -> None:
    seen = []
    for width, height in ((1366, 768), (3840, 2160)):
        lecture.page.set_viewport_size({"width": width, "height": height})
        lecture.page.goto(f"{lecture.address}labs?lab=bifurcation&scene=driven-pendulum")
        lecture.page.locator(".labs .side select").wait_for()
        tick, arrow, text = lecture.page.evaluate(SIZE_OF_CONTROLS)
        assert (tick > 1, arrow) == (True, pytest.approx(0.4, rel=0.02))
        seen.append(text)
    assert seen[1] > 2 * seen[0]


@pytest.mark.parametrize("place", ["?", "scene?", "proof?", "labs?", "homework?", "handout?", "variations?"])
def test_a_page_wears_its_theme_before_it_has_its_texts(page: Page, server: str, place: str) -> None:
    """In a dark hall nothing flashes."""
    page.route("**/api/v1/catalogs/**", lambda route: route.abort())
    page.goto(f"{server}{place}&lang=de&theme=dark")
    expect(page.locator("html")).to_have_attribute("data-theme", "dark")


@pytest.mark.one_in(2)
@pytest.mark.parametrize(
    ("place", "width"),
    [
        pytest.param("scene?scene=string-pendulum", 390, id="phone"),
        pytest.param("scene?scene=string-pendulum&view=lecture", 1366, id="lecture mode"),
        pytest.param("embed?scene=string-pendulum", 800, id="frame"),
    ],
)
def test_what_is_said_of_a_motion_covers_nothing_of_it(lecture: Lecture, place: str, width: int) -> None:
    page = lecture.page
    page.set_viewport_size({"width": width, "height": 768})
    page.goto(f"{lecture.address}{place}&lang=de")
    expect(page.locator(".doubt")).to_contain_text("Der Faden wird schlaff")
    boxes = [page.locator(one).bounding_box() for one in (".drawing", ".doubt", ".player")]
    drawing, said, player = (box for box in boxes if box)
    assert drawing["height"] > 150
    assert drawing["y"] + drawing["height"] <= said["y"] + 0.5
    assert said["y"] + said["height"] <= player["y"] + 0.5


def test_chapters_stand_in_line_with_the_choices_beside_them(browser: Browser, server: str) -> None:
    context = browser.new_context(viewport={"width": 390, "height": 844}, has_touch=True)
    page = context.new_page()
    page.goto(f"{server}scene?scene=pendulum&lang=en")
    middle = """e => {
        const range = document.createRange();
        range.selectNodeContents(e);
        const { top, bottom } = range.getBoundingClientRect();
        return (top + bottom) / 2;
    }"""
    chapter = page.locator(".chapters a").first.evaluate(middle)
    assert chapter == pytest.approx(page.locator(".release .chosen").evaluate(middle), abs=2)
    context.close()


# Numbers with a point, not of a section, a step or a date, and not 1.000 for a thousand; and where they stand.
POINTS = r"""() => {
    const POINT = /(?<![\d.§]|[Ss]chritt )\b\d+\.(?!000\b)\d+(?![\d.])/;
    const CODE = 'script, style, code, pre, annotation, option:not(:checked), :is(.step, .paper, nav) .number';
    const found = [];
    const look = (where, text) => POINT.test(text ?? '') && found.push(`${where}: ${text.trim().slice(0, 90)}`);
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    while (walker.nextNode()) {
        const { data, parentElement: around } = walker.currentNode;
        if (!around.closest(CODE)) look(`${around.tagName} ${around.getAttribute('class')}`, data);
    }
    for (const element of document.querySelectorAll('main *')) {
        for (const name of ['aria-label', 'aria-valuetext', 'title', 'placeholder'])
            look(`${name} of ${element.tagName}`, element.getAttribute(name));
        if (element.matches('input.decimal, input[inputmode]')) look(element.id || element.ariaLabel, element.value);
        if (element.matches('input[type=range]:not([aria-valuetext])')) look(element.ariaLabel, element.value);
    }
    return found;
}"""
NUMBERED = [
    pytest.param("scene?scene=cartesian-pendulum&with=phase,bars&at=1.25", ".plots.ready .reading", id="scene"),
    pytest.param("scene?scene=stick-slip&panel=plots&t=2.5&at=1.5", ".plots.ready .reading", id="friction"),
    pytest.param("scene?scene=rolling-disc&vary=s:0.25&at=1.5", ".virtual-panel .decimal", id="variation"),
    pytest.param("scene?scene=four-bar&view=lecture&beside=plots&at=1.5", ".slide .katex", id="lecture mode"),
    pytest.param("scene?scene=pendulum&edit=form", ".editor .field .katex", id="editor"),
    pytest.param("handout?scene=four-bar", ".paper .history path.curve", id="handout"),
    pytest.param("homework?side=sheet&scene=pendulum", ".catalogue .katex", id="sheet in the making"),
    pytest.param("labs?lab=basins", ".question .decimal", id="lab"),
    pytest.param("labs?lab=stability", ".question .decimal", id="lab with a slider"),
]


@pytest.mark.one_in(4)
@pytest.mark.parametrize(("place", "ready"), NUMBERED)
def test_a_german_reader_sees_decimal_commas(lecture: Lecture, place: str, ready: str) -> None:
    """In texts, on axes, in fields, and in what is only heard."""
    page = lecture.page
    page.emulate_media(reduced_motion="reduce")
    page.goto(f"{lecture.address}{place}&lang=de")
    page.locator(ready).first.wait_for(state="attached")
    if place.startswith("labs"):
        page.locator(".question button.main:enabled").click()
        page.locator("p.files").wait_for()
    frames(page, 2)
    assert page.evaluate(POINTS) == []


@pytest.mark.parametrize(
    ("lang", "typed", "shown", "asked"),
    [("de", "0,75", "0,75", "l:0.75"), ("de", "0.75", "0,75", "l:0.75"), ("en", "0,75", "0.75", "l:0.75")],
)
def test_a_number_is_typed_with_a_comma_or_a_point(
    lecture: Lecture, lang: str, typed: str, shown: str, asked: str
) -> None:
    page = lecture.page
    lecture.open(f"?scene=pendulum&lang={lang}")
    field = page.locator("[data-slider=parameter-l-value] .decimal")
    field.fill(typed)
    field.press("Enter")
    expect(field).to_have_value(shown)
    expect(page).to_have_url(re.compile(asked))
    field.press("ArrowUp")  # a step of the slider
    expect(page).not_to_have_url(re.compile(asked))
    field.fill("wide")
    field.press("Tab")
    assert field.input_value() != "wide"
