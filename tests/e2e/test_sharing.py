"""Sharing, frames in other pages, the handout and files, in a real browser."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from playwright.sync_api import Page, Route, expect
from tests.e2e.lecture import ROWS, Lecture
from tests.e2e.waiting import frames, until, until_equal

pytestmark = pytest.mark.e2e


@pytest.fixture
def shared(lecture: Lecture) -> Lecture:
    """A step of the elastic pendulum with the dialog that shares it."""
    lecture.open("?scene=elastic-pendulum&lang=en&step=virtual-displacement:bob&theme=dark")
    lecture.page.get_by_role("button", name="Share and take away").click()
    expect(lecture.page.locator("dialog.share")).to_be_visible()
    return lecture


def test_the_address_leads_back_and_has_a_code(shared: Lecture) -> None:
    page = shared.page
    expect(page).to_have_url(page.get_by_label("Address of this state").input_value())
    code = page.locator(".qr")
    expect(code).to_be_visible()
    view_box = [float(number) for number in (code.get_attribute("viewBox") or "").split()]
    modules = view_box[2] - 8
    assert (modules - 21) % 4 == 0, "the size of a QR code is 21, 25, 29 …"
    assert view_box[2] * 4 < (code.bounding_box() or {"width": 0})["width"], "each module has four pixels or more"
    page.keyboard.press("Escape")
    expect(page.locator("dialog")).to_have_count(0)


@pytest.mark.one_in(3)
@pytest.mark.parametrize(
    ("name", "file", "holds"),
    [
        pytest.param("LaTeX file", "elastic-pendulum.tex", r"\begin{document}", id="latex"),
        pytest.param("Markdown file", "elastic-pendulum.md", "## Variation", id="markdown"),
        pytest.param("Python program", "elastic-pendulum.py", "F0 = 3.0", id="python"),
    ],
)
def test_files_hold_what_is_shown(lecture: Lecture, name: str, file: str, holds: str) -> None:
    page = lecture.page
    lecture.open("?scene=elastic-pendulum&lang=en")
    force = page.locator("[data-slider=parameter-F0-value] .decimal")
    force.fill("3")
    force.press("Tab")
    page.get_by_role("button", name="Share and take away").click()
    with page.expect_download() as download:
        page.get_by_role("button", name=name).click()
    assert download.value.suggested_filename == file
    assert holds in Path(download.value.path()).read_text(encoding="utf-8")


COURSE = """<!doctype html><title>Course</title><body>{snippet}<script>
addEventListener('message', ({{data, source}}) => {{
  const frame = document.querySelector('iframe');
  if (source === frame.contentWindow && data.type === 'deltaq.height') {{
    frame.height = data.height; window.heard = data;
  }}
}})</script>"""


NOTHING_TO_SCROLL = """() => {
    const inner = document.querySelector('iframe').contentDocument.documentElement;
    return inner.scrollHeight <= inner.clientHeight;
}"""


def course(page: Page, address: str, snippet: str) -> None:
    """A page of the same origin that shows the frame."""
    body = COURSE.format(snippet=snippet)
    page.route("**/course.html", lambda route: route.fulfill(body=body, content_type="text/html; charset=utf-8"))
    page.goto(f"{address}course.html")


@pytest.mark.parametrize(
    ("show", "seen", "hidden"),
    [
        pytest.param("derivation and motion", (".steps", ".drawing"), (".top", ".plots"), id="both"),
        pytest.param("the motion alone", (".drawing",), (".steps", ".top"), id="figure"),
        pytest.param("the derivation alone", (".steps",), (".drawing", ".top"), id="derivation"),
    ],
)
def test_the_line_of_html_shows_the_place_at_its_height(
    shared: Lecture, show: str, seen: tuple[str, ...], hidden: tuple[str, ...]
) -> None:
    page = shared.page
    snippet = page.get_by_label(show).input_value()
    assert "\n" not in snippet
    course(page, shared.address, snippet)
    frame = page.frame_locator("iframe")
    for part in seen:
        expect(frame.locator(part).first).to_be_visible()
    for part in hidden:
        expect(frame.locator(part).first).to_be_hidden()
    page.wait_for_function("() => window.heard && window.heard.step === 'virtual-displacement:bob'")
    page.wait_for_function(NOTHING_TO_SCROLL)
    assert page.evaluate("window.heard.height") > 150
    expect(frame.locator(".home a")).to_have_attribute("href", re.compile(r"/scene\?scene=elastic-pendulum"))


def test_the_proof_goes_into_a_course_page(lecture: Lecture) -> None:
    page = lecture.page
    page.goto(f"{lecture.address}proof?lang=en&step=general-product-rule&theme=dark")
    page.locator(".steps .katex").first.wait_for()
    page.locator(".tools .tool").first.click()
    snippet = page.get_by_label("Embed in a course page").input_value()
    course(page, lecture.address, snippet)
    frame = page.frame_locator("iframe")
    expect(frame.locator(".step[aria-current]")).to_have_attribute("data-step", "general-product-rule")
    expect(frame.locator(".top")).to_be_hidden()
    expect(frame.locator("html")).to_have_attribute("data-theme", "dark")
    page.wait_for_function(
        "() => window.heard && window.heard.step === 'general-product-rule' && window.heard.height > 700"
    )
    before = page.evaluate("window.heard.height")
    frame.locator(".pager .main").click()
    page.wait_for_function(f"() => window.heard.height > {before}")
    page.wait_for_function(NOTHING_TO_SCROLL)
    expect(frame.locator(".home a")).to_have_attribute("href", re.compile(r"/proof\?step=(?!general-product-rule)"))


def test_a_frame_grows_with_its_steps(shared: Lecture) -> None:
    page = shared.page
    course(page, shared.address, page.get_by_label("derivation and motion").input_value())
    page.wait_for_function("() => window.heard && window.heard.step === 'virtual-displacement:bob'")
    page.wait_for_function(NOTHING_TO_SCROLL)
    before = page.evaluate("window.heard.height")
    page.frame_locator("iframe").locator(".pager .main").click()
    page.wait_for_function(f"() => window.heard.height > {before}")


@pytest.mark.parametrize("path", ["embed?scene=pendulum", "embed/proof"])
def test_another_origin_may_not_show_it(lecture: Lecture, path: str) -> None:
    page = lecture.page
    elsewhere = "http://course.test/"
    page.route(
        f"{elsewhere}**",
        lambda route: route.fulfill(body=f'<iframe src="{lecture.address}{path}"></iframe>', content_type="text/html"),
    )
    page.goto(elsewhere)
    refused = ["chrome-error://chromewebdata/"]
    until_equal(page, lambda: [frame.url for frame in page.frames[1:]], refused)


def test_a_handout_is_whole_and_printed_in_light(lecture: Lecture, tmp_path: Path) -> None:
    page = lecture.page
    page.goto(f"{lecture.address}handout?scene=guided-pendulum&lang=en&theme=dark")
    expect(page.locator(".paper .drawing path.bob")).to_be_attached()
    steps = page.locator(".paper .step")
    with page.expect_response("**/api/v1/derivations"):
        page.reload()
    expect(steps.last).to_be_visible()
    until(page, steps.count, lambda count: count >= 15)
    expect(page.locator(".paper .part").first).to_be_visible()
    page.get_by_label("with intermediate steps").uncheck()
    expect(page.locator(".paper .part")).to_have_count(0)
    expect(page).to_have_url(re.compile("substeps=no"))
    page.reload()
    expect(page.get_by_label("with intermediate steps")).not_to_be_checked()
    until(page, steps.count, lambda count: count >= 15)
    expect(page.locator(".untypeset, .katex-error")).to_have_count(0)
    page.emulate_media(media="print")
    expect(page.locator(".top")).to_be_hidden()
    paper = page.evaluate("getComputedStyle(document.querySelector('.paper')).backgroundColor")
    ink = page.evaluate("getComputedStyle(document.querySelector('.paper h1')).color")
    assert (paper, ink) == ("rgb(255, 255, 255)", "rgb(28, 27, 25)")
    wide = "[...document.querySelectorAll('.paper .formula')].filter(e => e.scrollWidth > e.clientWidth + 1).length"
    until_equal(page, lambda: page.evaluate(wide), 0)
    file = tmp_path / "handout.pdf"
    page.pdf(path=str(file), prefer_css_page_size=True)
    pages = re.findall(rb"/MediaBox \[([^\]]+)\]", file.read_bytes())
    assert len(pages) >= 3
    width, height = (float(number) for number in pages[0].split()[2:])
    assert (width, height) == pytest.approx((595.3, 841.9), abs=1.5)


def test_a_sheet_that_is_printed_at_once_is_not_made_small(lecture: Lecture, tmp_path: Path) -> None:
    """The browser makes a whole page smaller, when only one formula is wider than the paper."""
    page = lecture.page
    page.goto(f"{lecture.address}handout?scene=triple-pendulum&lang=en")
    page.locator(".paper .katex").first.wait_for()
    wide = "[...document.querySelectorAll('.formula')].filter(e => e.scrollWidth > e.clientWidth + 1 || !e.firstChild)"
    page.evaluate(f"addEventListener('beforeprint', () => {{ window.wide = {wide}.length }})")
    page.pdf(path=str(tmp_path / "handout.pdf"), prefer_css_page_size=True)
    assert page.evaluate("window.wide") == 0
    page.evaluate(f"window.print = () => {{ window.small = {wide}.length }}")
    page.get_by_role("button", name="Print").click()
    page.wait_for_function("() => window.small === 0")


@pytest.mark.one_in(2)
def test_a_sheet_is_shown_when_it_can_be_printed(either: Lecture, tmp_path: Path) -> None:
    """Not before it has come how long formulas are set, whose rows would be missing on paper."""
    page, held = either.page, list[Route]()

    def hold(route: Route) -> None:
        held.append(route)

    page.route(ROWS, hold)
    with page.expect_response("**/api/v1/derivations") as derived:
        page.goto(f"{either.address}handout?scene=triple-pendulum&lang=en")
    derived.value.finished()
    frames(page, 10)
    expect(page.locator(".paper")).to_have_count(0)
    held[0].continue_()
    page.locator(".paper .katex").first.wait_for()
    empty = "[...document.querySelectorAll('.formula')].filter(e => !e.firstChild).length"
    page.evaluate(f"addEventListener('beforeprint', () => {{ window.empty = {empty} }})")
    page.pdf(path=str(tmp_path / "handout.pdf"))
    assert page.evaluate("window.empty") == 0


def test_the_general_proof_has_an_address_a_code_and_a_handout(lecture: Lecture) -> None:
    page = lecture.page
    page.goto(f"{lecture.address}proof?lang=de")
    page.locator(".steps .katex").first.wait_for()  # the first proof of a server takes its time
    page.locator(".tools .tool").first.click()
    expect(page.locator(".qr")).to_be_visible()
    expect(page).to_have_url(page.get_by_label("Adresse dieses Standes").input_value())
    page.locator("dialog .files a").click()
    expect(page.locator(".paper h1")).to_have_text("Allgemeiner Beweis")
    expect(page.locator(".paper .step")).to_have_count(20)
    expect(page.locator(".paper footer a")).to_have_attribute("href", re.compile(r"/proof\?lang=de$"))
    page.reload()
    expect(page.locator(".paper .step")).to_have_count(20)
    wide = "[...document.querySelectorAll('.paper .formula')].filter(e => e.scrollWidth > e.clientWidth + 1).length"
    until_equal(page, lambda: page.evaluate(wide), 0)


def test_the_speed_of_the_motion_is_part_of_the_address(lecture: Lecture) -> None:
    page = lecture.page
    lecture.open("?scene=pendulum&lang=en")
    speed = page.get_by_label("Speed")
    speed.select_option("0.25")
    expect(page).to_have_url(re.compile(r"[?&]speed=0\.25"))
    page.reload()
    lecture.bob.wait_for(state="attached")
    expect(speed).to_have_value("0.25")
    page.keyboard.press("k")
    lecture.pause_at(1.0)
    page.locator(".drawing").hover()
    page.get_by_role("button", name="One picture on").click()
    expect(page.locator(".player .time")).to_have_text("1.01 s")
    page.get_by_role("button", name="Share and take away").click()
    expect(page.get_by_label("the motion alone")).to_have_value(re.compile("speed=0.25"))
    page.keyboard.press("Escape")
    speed.select_option("1")
    expect(page).not_to_have_url(re.compile("speed="))


def test_on_a_phone_the_menu_has_what_the_header_has_no_room_for(lecture: Lecture) -> None:
    page = lecture.page
    page.set_viewport_size({"width": 360, "height": 740})
    lecture.open("?scene=pendulum&lang=en")
    page.locator(".menu").click()
    page.get_by_role("button", name="Share and take away").click()
    expect(page.locator("dialog.share")).to_be_visible()
    page.keyboard.press("Escape")
    page.locator(".menu").click()
    page.get_by_role("button", name="Lecture mode").click()
    expect(page.locator(".slide .step")).to_be_visible()
    assert page.evaluate("document.documentElement.scrollWidth") == 360
