"""The real server and a real browser."""

from __future__ import annotations

import json
import os
import time
import urllib.request
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, expect
from tests.bundling import made
from tests.e2e.browser import NoBrowser, chromium, started
from tests.e2e.lecture import Lecture
from tests.e2e.waiting import PATIENCE
from tests.serving import PATIENT, served


@pytest.fixture(scope="session")
def answers(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder in which the services of all workers of this run keep their answers: each is computed once."""
    own = tmp_path_factory.getbasetemp()
    return (own.parent if "PYTEST_XDIST_WORKER" in os.environ else own) / "answers"


@pytest.fixture(scope="session")
def server(root: Path, answers: Path) -> Iterator[str]:
    """The address of a service with the page as packages have it; from its sources if there is no esbuild."""
    yield from _serving(made(root) or "", answers)


@pytest.fixture(scope="session")
def source_server(answers: Path) -> Iterator[str]:
    """The address of a service with the page from its sources, as who works on it sees it."""
    yield from _serving("", answers)


def _serving(static: Path | str, answers: Path) -> Iterator[str]:
    with served(static=static, cache_folder=answers, **PATIENT) as service:
        _answered(f"{service.address}api/v1/simulations", {"scene": "elastic-pendulum", "t_end": 1.0})
        yield service.address


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


@pytest.fixture(scope="session")
def bench(server: str) -> None:
    """The kernels of all methods are compiled: experiments wait for them, motions only for those of their own."""
    _answered(f"{server}api/v1/experiments/convergence", {"scene": "pendulum", "t_end": 1.0}, 900.0)


def _answered(address: str, question: dict[str, object], patience: float = 240.0) -> None:
    """Ask until there is an answer: the first one of a machine's life compiles kernels."""
    request = urllib.request.Request(address, json.dumps(question).encode(), {"content-type": "application/json"})
    end = time.monotonic() + patience
    while True:
        try:
            urllib.request.urlopen(request, timeout=patience).close()
        except OSError:
            if time.monotonic() > end:
                raise
            time.sleep(0.5)
        else:
            return


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
def page(browser: Browser) -> Iterator[Page]:
    context = browser.new_context(viewport={"width": 1366, "height": 768}, locale="de-DE")
    context.set_default_timeout(PATIENCE)
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
