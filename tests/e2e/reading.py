"""Long derivations in the hand: `python -m tests.e2e.reading http://127.0.0.1:8000/ [query …]`.

On a processor slowed four times, the motion at rest: the longest task of the page, in ms, and how many take more than
50, while steps are turned one by one, while all are revealed at once, while the list is scrolled through from end to
end, and when a link leads to the last step. Judges nothing.
"""

from __future__ import annotations

import sys
from collections.abc import Callable

from playwright.sync_api import Browser, Page
from tests.e2e.browser import started
from tests.e2e.lecture import Lecture
from tests.e2e.waiting import PATIENCE

SLOWER, TURNS, STRIDES, SETTLED = 4, 20, 40, 2500
QUERIES = ("?scene=elastic-pendulum", "?scene=triple-pendulum", "?scene=chain-pendulum&n=5")
OBSERVE = """() => {
    window.tasks = [];
    const note = list => window.tasks.push(...list.getEntries().map(e => e.duration));
    new PerformanceObserver(note).observe({type: 'longtask'});
}"""


def turn(page: Page) -> None:
    for _ in range(TURNS):
        page.keyboard.press("ArrowRight")
        page.wait_for_timeout(120)


def reveal(page: Page) -> None:
    page.locator(".pager .minor").click()


def scroll(page: Page) -> None:
    page.evaluate("window.list = document.querySelector('.scroll')")
    page.evaluate("list.scrollTo(0, 0)")
    for _ in range(STRIDES):
        page.evaluate("n => list.scrollBy(0, list.scrollHeight / n)", STRIDES)
        page.wait_for_timeout(60)


def link(page: Page) -> None:
    page.reload()
    page.locator(".step[aria-current]").wait_for()


def watch(page: Page, act: Callable[[Page], None]) -> str:
    """What an act costs, together with what it leaves to be done afterwards."""
    page.evaluate("window.tasks = []")
    act(page)
    page.wait_for_timeout(SETTLED)
    tasks: list[float] = page.evaluate("window.tasks")
    return f"{max(tasks, default=0):6.0f} ({len(tasks):2d})"


def read(browser: Browser, address: str, query: str) -> str:
    context = browser.new_context(viewport={"width": 1366, "height": 768}, reduced_motion="reduce")
    context.set_default_timeout(PATIENCE)
    page = context.new_page()
    page.add_init_script(f"({OBSERVE})()")
    page.context.new_cdp_session(page).send("Emulation.setCPUThrottlingRate", {"rate": SLOWER})
    Lecture(page, address).open(f"{query}&lang=en")
    page.locator(".plots.ready").wait_for()
    page.wait_for_timeout(SETTLED)
    found = [watch(page, act) for act in (turn, reveal, scroll)]
    found.append(watch(page, link))
    steps = page.locator(".steps > .step").count()
    context.close()
    acts = zip(("turning", "revealing", "scrolling", "linked"), found, strict=True)
    return f"{query:28} {steps:3d} steps   " + "   ".join(f"{name} {cost}" for name, cost in acts)


def main(address: str, *queries: str) -> None:
    with started() as browser:
        for query in queries or QUERIES:
            print(read(browser, address, query), flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
