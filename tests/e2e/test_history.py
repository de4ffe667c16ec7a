"""Back, forward and undo on the scene page; what is shown when an answer cannot be had."""

from __future__ import annotations

import re
from itertools import pairwise

import pytest
from playwright.sync_api import Locator, expect
from tests.e2e.lecture import Lecture
from tests.e2e.waiting import until, until_equal

SCENE = "?scene=elastic-pendulum&lang=en"


@pytest.fixture
def changed(lecture: Lecture) -> Lecture:
    """Two changes that each can be taken back: another step, and a value moved in one go."""
    page = lecture.page
    lecture.open(f"{SCENE}&step=position:bob")
    page.evaluate("window.loaded = 1")
    page.get_by_role("button", name="Next", exact=True).click()
    until(page, lambda: lecture.current_step, lambda step: step != "position:bob")
    for _ in range(3):
        length(lecture).press("ArrowRight")
    expect(page).to_have_url(re.compile("set=l"))
    return lecture


def length(lecture: Lecture) -> Locator:
    return lecture.page.locator("[data-slider=parameter-l-value] input[type=range]")


def test_changes_are_taken_back_in_turn_and_done_again(changed: Lecture) -> None:
    page = changed.page
    second, moved = changed.current_step, length(changed).input_value()
    assert second != "position:bob"
    page.keyboard.press("Control+z")
    expect(page).not_to_have_url(re.compile("set=l"))
    until_equal(page, lambda: float(length(changed).input_value()), 1.0)
    assert changed.current_step == second
    page.go_back()
    until_equal(page, lambda: changed.current_step, "position:bob")
    page.keyboard.press("Control+z")  # the page is not left
    page.keyboard.press("Control+y")
    until_equal(page, lambda: changed.current_step, second)
    page.go_forward()
    until_equal(page, lambda: length(changed).input_value(), moved)
    assert page.evaluate("window.loaded") == 1


def test_another_scene_is_left_for_the_one_before_with_its_values(changed: Lecture) -> None:
    page = changed.page
    second, moved = changed.current_step, length(changed).input_value()
    page.get_by_label("Choose a scene").select_option("pendulum")
    expect(page).to_have_url(re.compile("scene=pendulum&step="))
    page.go_back()
    expect(page).to_have_url(re.compile("scene=elastic-pendulum"))
    until_equal(page, lambda: changed.current_step, second)
    until_equal(page, lambda: length(changed).input_value(), moved)
    assert page.evaluate("window.loaded") == 1


def test_the_motion_of_before_stays_where_none_can_be_computed(lecture: Lecture) -> None:
    page = lecture.page
    lecture.open(SCENE)
    page.context.set_offline(True)
    length(lecture).press("ArrowRight")
    kept = page.locator(".told .failure")
    expect(kept).to_contain_text("still the motion of the values before")
    expect(page.locator(".figure.failed")).to_have_count(0)
    assert kept.bounding_box()["height"] < 0.25 * page.locator(".drawing").bounding_box()["height"]  # type: ignore[index]
    page.context.set_offline(False)
    kept.get_by_role("button", name="Try again").click()
    expect(kept).to_have_count(0)
    lecture.complaints.clear()  # the browser's own, of the connection


def test_a_family_without_this_member_leads_to_the_nearest(lecture: Lecture) -> None:
    page = lecture.page
    page.goto(f"{lecture.address}scene?scene=chain-pendulum&n=99&lang=en")
    way = page.locator(".failure").get_by_role("link", name="Open it with n = 12")
    expect(way).to_have_attribute("href", re.compile("n=12"))
    lecture.complaints.clear()  # the browser tells of the refusal


def test_an_enlarged_lecture_keeps_its_bar(lecture: Lecture) -> None:
    """Twice as large on 1366 × 768."""
    page = lecture.page
    page.set_viewport_size({"width": 683, "height": 384})
    page.goto(f"{lecture.address}scene{SCENE}&view=lecture")
    expect(page.locator(".lecturing .count")).to_have_text(re.compile(r"1 / \d+"))
    boxes = [part.bounding_box() for part in page.locator(".lecturing > .tool, .lecturing .count").all()]
    edges = sorted((box["x"], box["x"] + box["width"]) for box in boxes if box)
    assert len(edges) == 11
    assert all(end <= start + 0.5 for (_, end), (start, _) in pairwise(edges))
    assert all(box["height"] < 60 for box in boxes if box)
