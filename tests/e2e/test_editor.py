"""Writing a scene of one's own, in a real browser."""

from __future__ import annotations

import re
from importlib.resources import files
from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page, Request, expect
from tests.e2e.lecture import Lecture
from tests.e2e.waiting import PATIENCE

pytestmark = pytest.mark.e2e
POSITION = "/bodies/0/position/0"


def field(page: Page, pointer: str) -> Locator:
    return page.locator(f"[data-pointer='{pointer}']")


def type_into(page: Page, pointer: str, text: str) -> None:
    field(page, pointer).locator("input").fill(text)


def valid(page: Page) -> None:
    expect(page.locator(".verdict-bar")).to_have_class(re.compile(r"\bvalid\b"))


@pytest.fixture
def editor(lecture: Lecture) -> Lecture:
    """The editor with a copy of the pendulum."""
    lecture.open("?scene=pendulum&lang=en")
    lecture.page.locator(".values .row").first.wait_for()
    lecture.page.locator(".pen").click()
    valid(lecture.page)
    return lecture


def test_a_mistake_stands_at_its_field_and_goes(editor: Lecture) -> None:
    page = editor.page
    expect(field(page, POSITION).locator(".preview .katex")).to_be_visible()
    type_into(page, POSITION, "l*sin(phy)")
    wrong = field(page, POSITION)
    expect(wrong.locator(".wrong")).to_contain_text("“phy” is not known here")
    expect(wrong.locator("mark")).to_have_text("phy")
    expect(wrong.locator("input")).to_have_attribute("aria-invalid", "true")
    expect(page.locator(".verdict-bar .main")).to_be_disabled()
    type_into(page, POSITION, "2*l*sin(phi)")
    expect(page.locator(".wrong")).to_have_count(0)
    valid(page)


def _first_value(request: Request) -> float | None:
    """The initial value a simulation was asked with; None for any other request."""
    if not request.url.endswith("/api/v1/simulations"):
        return None
    scene = (request.post_data_json or {})["scene"]
    return None if isinstance(scene, str) else float(scene["coordinates"][0]["value"])


def test_it_is_derived_and_moves_at_once(editor: Lecture) -> None:
    page = editor.page
    expect(page.locator(".equations .katex").first).to_be_visible()
    with page.expect_response(lambda answer: _first_value(answer.request) == 0.3):
        type_into(page, "/coordinates/0/value", "0.3")
    page.locator(".verdict-bar .main").click()
    expect(editor.steps.first).to_be_visible()
    expect(editor.bob).not_to_have_attribute("transform", editor.bob.get_attribute("transform") or "")


def test_a_file_is_opened_and_the_list_closes(editor: Lecture, tmp_path: Path) -> None:
    page = editor.page
    file = tmp_path / "scene.toml"
    file.write_text((files("deltaq") / "scenes" / "atwood.toml").read_text(encoding="utf-8"), encoding="utf-8")
    page.locator(".files summary").click()
    with page.expect_file_chooser() as chooser:
        page.locator(".files .load").click()
    chooser.value.set_files(file)
    expect(field(page, "/title").locator("input")).to_have_value("Atwood’s machine")
    expect(page.locator(".files")).not_to_have_attribute("open", "")
    type_into(page, "/parameters/0/value", "")
    expect(field(page, "/parameters/0/value").locator("input")).to_have_attribute("placeholder", "1")
    valid(page)


def test_a_reload_loses_nothing(editor: Lecture) -> None:
    page = editor.page
    type_into(page, POSITION, "l*sin(phy")
    expect(field(page, POSITION).locator(".wrong")).to_be_visible()
    page.reload()
    expect(field(page, POSITION).locator("input")).to_have_value("l*sin(phy")
    editor.complaints.clear()  # the browser reports that the server refused the faulty scene


def test_json_that_cannot_be_read_is_kept(editor: Lecture) -> None:
    page = editor.page
    page.get_by_role("button", name="JSON", exact=True).click()
    page.locator("textarea").fill('{"format": 1,')
    expect(page.locator(".source .wrong")).to_be_visible()
    page.get_by_role("button", name="Form").click()
    expect(page.locator(".form")).to_have_attribute("inert", "")
    page.reload()
    page.get_by_role("button", name="JSON", exact=True).click()
    expect(page.locator("textarea")).to_have_value('{"format": 1,')


@pytest.mark.parametrize(
    ("clipboard", "told"),
    [
        pytest.param("undefined", "address above", id="none, as over plain HTTP"),
        pytest.param("{writeText: () => Promise.reject(new Error())}", "address above", id="refused"),
        pytest.param("{writeText: async text => window.copied = text}", "The link is copied", id="allowed"),
    ],
)
def test_whether_a_link_was_copied_is_told(lecture: Lecture, clipboard: str, told: str) -> None:
    page = lecture.page
    page.add_init_script(f"Object.defineProperty(navigator, 'clipboard', {{value: {clipboard}}})")
    page.goto(f"{lecture.address}scene?scene=own&edit=form&lang=en")
    page.locator(".menu button").first.click()
    expect(page.locator(".editor .warning")).to_contain_text(told)


def test_a_link_opens_the_same_scene_elsewhere(editor: Lecture) -> None:
    page = editor.page
    type_into(page, "/title", "Long pendulum")
    type_into(page, "/parameters/1/value", "1.75")
    valid(page)
    expect(page.locator(".values .row", has_text="m").first).to_be_visible()
    browser = page.context.browser
    assert browser is not None
    context = browser.new_context(locale="en-GB")
    context.set_default_timeout(PATIENCE)
    other = Lecture(context.new_page(), editor.address)
    other.page.goto(page.url)
    expect(field(other.page, "/title").locator("input")).to_have_value("Long pendulum")
    expect(field(other.page, "/parameters/1/value").locator("input")).to_have_value("1.75")
    valid(other.page)
    assert other.complaints == []
    context.close()


def test_a_scene_from_nothing(lecture: Lecture) -> None:
    page = lecture.page
    page.goto(f"{lecture.address}scene?lang=en#edit")
    page.locator("[data-section=coordinates] .add").click()
    type_into(page, "/coordinates/0/name", "x")
    page.locator("[data-section=bodies] .add").click()
    type_into(page, "/bodies/0/mass", "2")
    type_into(page, f"{POSITION}", "x")
    type_into(page, "/bodies/0/position/1", "0")
    valid(page)
    expect(lecture.bob).to_be_visible()
    page.locator(".menu select").select_option("empty:")
    page.get_by_role("button", name="Bring it back").click()
    expect(field(page, POSITION).locator("input")).to_have_value("x")


def test_a_scene_file_is_opened(editor: Lecture) -> None:
    page = editor.page
    text = (files("deltaq") / "scenes" / "atwood.toml").read_bytes()
    page.locator(".files summary").click()
    page.locator(".files input").set_input_files({"name": "a.toml", "mimeType": "application/toml", "buffer": text})
    expect(field(page, "/id").locator("input")).to_have_value("atwood")
    valid(page)
    page.locator(".files input").set_input_files(
        {"name": "a.toml", "mimeType": "application/toml", "buffer": b"a == 1"}
    )
    expect(page.locator(".editor .warning")).to_contain_text("line 1, column 4")
    editor.complaints.clear()  # the browser reports that the server refused the text
