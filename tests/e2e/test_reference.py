"""The API, read and tried in a real browser."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import expect
from tests.e2e.lecture import Lecture

pytestmark = pytest.mark.e2e


@pytest.fixture
def trial(lecture: Lecture) -> Lecture:
    """The check of an answer, from where it is described to where it is tried."""
    page = lecture.page
    page.goto(f"{lecture.address}docs?lang=en")
    page.get_by_role("link", name="try it: POST /api/v1/checks", exact=True).click()
    expect(page.get_by_role("heading", level=1)).to_have_text("Try the API")
    return lecture


def test_a_sample_is_copied_whole(lecture: Lecture) -> None:
    page = lecture.page
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    page.goto(f"{lecture.address}docs?lang=en")
    page.get_by_role("button", name="Copy: POST /api/v1/scenes/validate", exact=True).click()
    call = page.locator("#validate_scene")
    expect(call.get_by_role("status")).to_have_text("copied")
    assert page.evaluate("navigator.clipboard.readText()") == call.locator("pre").inner_text()
    page.get_by_role("button", name="Python").click()
    expect(call.locator("pre")).to_contain_text("import httpx")


def test_an_example_is_sent_and_answered(trial: Lecture) -> None:
    page = trial.page
    expect(page.locator("textarea")).to_have_value(re.compile(r'"task": "equation:phi"'))
    page.get_by_role("button", name="Send").click()
    expect(page.locator(".outcome")).to_have_text(re.compile(r"^200 · \d+ ms · \d"))
    expect(page.locator(".answer pre")).to_contain_text('"outcome": "correct"')


def test_what_is_written_is_sent_told_as_a_line_and_kept_in_the_address(trial: Lecture) -> None:
    page = trial.page
    written = '{"scene": "pendulum", "task": "kinetic-energy", "answer": {"value": "m*l^2*dot(phi)^2"}}'
    page.locator("textarea").fill(written)
    page.keyboard.press("Control+Enter")
    expect(page.locator(".answer pre")).to_contain_text('"outcome": "wrong"')
    expect(page.locator(".line pre")).to_contain_text('--data-binary \'{"scene":"pendulum","task":"kinetic-energy"')
    page.reload()
    expect(page.locator("textarea")).to_have_value(written)
    page.get_by_role("button", name="Example 1").click()
    expect(page).to_have_url(re.compile(r"#check$"))


def test_a_mistake_is_answered_as_a_program_would_hear_it(trial: Lecture) -> None:
    page = trial.page
    page.locator("textarea").fill('{"scene": "pendulum"')
    page.get_by_role("button", name="Send").click()
    expect(page.locator(".outcome")).to_contain_text("400")
    assert [complaint for complaint in trial.complaints if "400" not in complaint] == []
    trial.complaints.clear()  # a browser counts a refused request as an error


def test_names_in_the_address_and_calls_without_body(trial: Lecture) -> None:
    page = trial.page
    page.locator(".called select").select_option("GET /api/v1/scenes/{identifier}")
    expect(page.locator("textarea")).to_have_count(0)
    page.get_by_role("textbox", name="identifier").fill("double-pendulum")
    page.keyboard.press("Enter")
    expect(page.locator(".answer pre")).to_contain_text('"id": "double-pendulum"')
    expect(page.locator(".line pre")).to_contain_text('curl "$DELTAQ/api/v1/scenes/double-pendulum"')
