"""Makes the README's picture of the page: `python -m tests.e2e.picture http://127.0.0.1:8000/ .github/picture.png`."""

from __future__ import annotations

import re
import sys

from playwright.sync_api import expect
from tests.e2e.browser import started
from tests.e2e.lecture import Lecture

PLACE = "?scene=elastic-pendulum&lang=en&theme=light&step=virtual-displacement:bob"
WELL = re.compile(r"^4\.[0-5]\d s")  # the time of the motion at which the pendulum stands well


def take(address: str, file: str) -> None:
    """The elastic pendulum in the middle of its motion, beside the variation of its position."""
    with started() as browser:
        page = browser.new_page(viewport={"width": 1366, "height": 768})
        Lecture(page, address).open(PLACE)
        page.locator(".js-plotly-plot").first.wait_for()
        expect(page.locator("output.time")).to_have_text(WELL)
        page.screenshot(path=file)


if __name__ == "__main__":
    take(*sys.argv[1:3])
