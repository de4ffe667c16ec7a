"""Own lectures: made of places, arranged, and given without a network and with a second screen."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path

import pytest
from playwright.sync_api import FilePayload, Page, expect
from tests.e2e.lecture import Lecture
from tests.e2e.waiting import at_rest, until_equal

pytestmark = pytest.mark.e2e

POLL = {"question": "What is $\\delta x$?", "choices": ["$v$", "$\\dot{x}$", "$0$"], "right": 1}
STOPS = [
    {"place": "proof?step=general-motion", "title": "Motion", "notes": "Slowly."},
    {"place": "proof?step=gateaux-definition", "title": "Variation", "hide": True, "poll": POLL},
    {"place": "variations?expression=x%5E2", "title": "A square", "hide": True},
    {"place": "proof?step=general-motion", "title": "Again"},
]
STEP = "() => document.querySelector('iframe.front')?.contentDocument.querySelector('.slide [data-step]')?.dataset.step"


def file(stops: list[dict[str, object]]) -> FilePayload:
    text = json.dumps({"format": "deltaq-lecture/1", "title": "A test", "stops": stops})
    return {"name": "lecture.json", "mimeType": "application/json", "buffer": text.encode()}


def opened(lecture: Lecture, stops: list[dict[str, object]]) -> Page:
    """The outline of a lecture that came as a file."""
    page = lecture.page
    page.goto(f"{lecture.address}lecture?lang=en")
    page.locator("input[type=file]").set_input_files(file(stops))
    return page


def given(lecture: Lecture, stops: list[dict[str, object]]) -> Page:
    """The hall, with all that it needs."""
    page = opened(lecture, stops)
    page.get_by_role("button", name="Start", exact=True).click()
    expect(page.locator(".hall iframe.front")).to_be_visible()
    until_equal(page, lambda: page.locator(".hall .ready").inner_text(), "")
    return page


def titles(page: Page) -> list[str]:
    found: list[str] = page.locator(".stop-title").evaluate_all("all => all.map(one => one.value)")
    return found


def test_places_become_a_lecture_that_is_arranged_and_saved(lecture: Lecture) -> None:
    page = lecture.page
    page.goto(f"{lecture.address}proof?step=single-force&lang=en&view=lecture")
    page.locator(".slide .katex").first.wait_for()
    page.keyboard.press("a")
    note, content = page.locator(".added").bounding_box(), page.locator(".slide .scroll").bounding_box()
    assert note is not None
    assert content is not None
    assert note["y"] + note["height"] <= content["y"]
    page.goto(f"{lecture.address}labs?lab=chaos&lang=en")
    page.locator(".purpose").wait_for(state="attached")
    page.get_by_role("button", name="Add this place to my lecture").click()
    expect(page.locator(".added")).to_be_visible()
    page.locator(".added a").click()
    first = "Single force · General proof"
    until_equal(page, lambda: [title.split()[0] for title in titles(page)], ["Single", "Chaos"])
    assert titles(page)[0] == first
    page.locator(".stop-title").first.focus()
    page.keyboard.press("Alt+ArrowDown")
    until_equal(page, lambda: titles(page)[1], first)
    expect(page.locator(".stop-title").nth(1)).to_be_focused()
    page.get_by_role("button", name="Remove stop 1").click()
    expect(page.locator(".stop")).to_have_count(1)
    page.get_by_role("button", name="Undo").click()
    expect(page.locator(".stop")).to_have_count(2)
    page.get_by_label("Title", exact=True).fill("Chaos and forces")
    page.reload()
    until_equal(page, lambda: titles(page)[1:], [first])
    with page.expect_download() as download:
        page.get_by_role("button", name="Save as file").click()
    saved = json.loads(Path(download.value.path()).read_text(encoding="utf-8"))
    assert download.value.suggested_filename == "chaos-and-forces.json"
    assert [stop["place"].split("?")[0] for stop in saved["stops"]] == ["labs", "proof"]
    page.locator("input[type=file]").set_input_files(file([{"place": "//evil.example", "title": "x"}]))
    expect(page.locator(".failure code")).to_have_text("/stops/0/place")
    expect(page.locator(".stop")).to_have_count(2)


def test_a_lecture_is_given_without_a_network(lecture: Lecture) -> None:
    page = given(lecture, STOPS)
    page.context.set_offline(True)
    at = page.locator(".hall .count")
    formula = page.frame_locator("iframe.front").locator(".slide .formula").first
    for step in ("difference-quotient", "directional-derivative"):
        page.keyboard.press("PageDown")
        until_equal(page, lambda: page.evaluate(STEP), step)
        expect(at).to_have_text("1 / 4")
    page.keyboard.press("PageDown")
    expect(at).to_have_text("2 / 4")
    expect(page.locator(".poll [data-right]")).to_have_count(0)
    expect(formula).to_be_hidden()
    page.keyboard.press(" ")
    expect(page.locator(".poll [data-right]")).to_contain_text("A")
    expect(formula).to_be_visible()
    page.frame_locator("iframe.front").locator(".slide .title").first.click()  # the keys go to the frame now
    page.keyboard.press(" ")
    expect(page.locator(".poll")).to_have_count(0)
    page.keyboard.press("ArrowRight")
    expect(page.locator(".cover")).to_have_text("A square")
    page.keyboard.press("b")
    expect(page.locator(".stage .black")).to_be_visible()
    for _ in range(3):
        page.keyboard.press("n")  # light, result, the next stop
    expect(at).to_have_text("4 / 4")
    until_equal(page, lambda: page.evaluate(STEP), "general-motion")
    page.keyboard.press("Home")
    expect(at).to_have_text("1 / 4")
    page.context.set_offline(False)
    page.keyboard.press("l")
    expect(page.locator(".stop")).to_have_count(4)


def test_a_lecture_is_complete_when_its_measurements_are(lecture: Lecture) -> None:
    """The hall says how much is missing until a lab has its results: without a network there would be none."""
    page = given(lecture, [{"place": "labs?lab=stability&scene=pendulum", "title": "Stability"}])
    page.context.set_offline(True)
    measured = page.frame_locator("iframe.front").locator(".measured")
    assert measured.get_attribute("aria-busy") == "false"
    expect(measured.locator(".canvas").first).to_be_visible()
    page.context.set_offline(False)


def stroke(page: Page, board: str) -> Callable[[], int]:
    """Draws a line over the slide; how many lines there are."""
    box = at_rest(page.locator(board))
    left, top = box["x"] + box["width"] / 4, box["y"] + box["height"] / 2
    page.mouse.move(left, top)
    page.mouse.down()
    page.mouse.move(left + box["width"] / 3, top + 20, steps=4)
    page.mouse.up()
    return page.locator(f"{board} path").count


def test_pen_light_and_notes_are_on_both_screens(lecture: Lecture) -> None:
    page = given(lecture, STOPS[:2])
    with page.expect_popup() as window:
        page.keyboard.press("s")
    desk = window.value
    expect(desk.locator(".notes")).to_contain_text("Slowly.")
    expect(desk.locator(".next")).to_contain_text("Variation")
    page.keyboard.press("d")
    count = stroke(page, ".hall .ink")
    until_equal(desk, desk.locator(".ink path").count, count())
    desk.get_by_role("button", name="Pen").click()
    stroke(desk, ".small-stage .ink")
    expect(page.locator(".ink path")).to_have_count(2)
    drawn = [one.locator(".ink path").last.get_attribute("d") for one in (page, desk)]
    assert drawn[0] == drawn[1]
    desk.get_by_role("button", name="Spotlight").click()
    desk.locator(".small-stage").hover()
    expect(page.locator(".spotlight")).to_have_attribute("style", re.compile("--x"))
    desk.get_by_role("button", name="Next").click()
    until_equal(page, lambda: page.evaluate(STEP), "difference-quotient")
    expect(page.locator(".ink path")).to_have_count(0)
    desk.close()
