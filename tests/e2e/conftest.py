"""The real server and a real browser."""

from __future__ import annotations

import os
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect
from tests.e2e.browser import NoBrowser, chromium, started
from tests.e2e.lecture import Lecture
from tests.e2e.waiting import PATIENCE

# A browser without a graphics card draws with the processor: at sixty pictures a second half of one goes to a pendulum
# that nobody looks at. The first comes at once and four a second follow, which show all that tests look for; those of
# the motion itself are marked `smooth`.
FEWER_PICTURES = """{
  const next = window.requestAnimationFrame.bind(window);
  let drawn = -Infinity;
  window.requestAnimationFrame = (draw) =>
    setTimeout(() => next((now) => draw((drawn = now))), Math.max(0, drawn + 250 - performance.now()));
  window.cancelAnimationFrame = clearTimeout;
}"""


@pytest.fixture(params=["sources", "bundle"])
def either(request: pytest.FixtureRequest, page: Page) -> Iterator[Lecture]:
    """The page from its sources, and from the bundle."""
    lecture = Lecture(page, request.getfixturevalue("source_server" if request.param == "sources" else "server"))
    yield lecture
    assert lecture.complaints == []


@pytest.fixture
def sources(page: Page, source_server: str) -> Iterator[Lecture]:
    """The page from its sources."""
    lecture = Lecture(page, source_server)
    yield lecture
    assert lecture.complaints == []


expect.set_options(timeout=PATIENCE)


def pytest_runtest_setup(item: pytest.Item) -> None:
    """Without a browser the end of a run says so once, with the number of tests; a fixture would say it for each."""
    if "browser" not in getattr(item, "fixturenames", ()):
        return
    try:
        chromium()
    except NoBrowser as error:
        end = pytest.fail if "CHROMIUM_PATH" in os.environ else pytest.skip
        end(f"NO BROWSER, SO THE PAGE IS NOT TESTED: {error}")


@pytest.fixture(scope="module")  # its event loop must have ended before asynchronous tests begin in the same process
def browser() -> Iterator[Browser]:
    with started() as browser:
        yield browser


@pytest.fixture
def page(browser: Browser, request: pytest.FixtureRequest) -> Iterator[Page]:
    context = browser.new_context(viewport={"width": 1366, "height": 768}, locale="de-DE")
    context.set_default_timeout(PATIENCE)
    if not request.node.get_closest_marker("smooth"):
        context.add_init_script(FEWER_PICTURES)
    yield context.new_page()
    context.unroute_all(behavior="ignoreErrors")  # what a test answered in the service's place may still be under way
    for page in context.pages:
        page.unroute_all(behavior="ignoreErrors")
    context.close()


@pytest.fixture
def lecture(page: Page, server: str) -> Iterator[Lecture]:
    """The page with what went wrong on it: every test ends by looking at that."""
    lecture = Lecture(page, server)
    yield lecture
    assert lecture.complaints == []
