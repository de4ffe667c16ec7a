"""Pictures of every page to look at: `python -m tests.e2e.gallery http://127.0.0.1:8000/ folder [words of names …]`.

Each place is taken in each language, appearance and size that changes what is seen; scenes are taken in motion.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from playwright.sync_api import Browser, Page, sync_playwright
from tests.e2e.browser import FLAGS, chromium

PHONE, TABLET, LAPTOP, DESKTOP, WALL = (360, 740), (768, 1024), (1366, 768), (1920, 1080), (3840, 2160)
PATIENCE = 60_000.0
MOTION = 1700.0  # milliseconds until a pendulum stands well


@dataclass(frozen=True)
class View:
    """One combination of language, appearance and size."""

    language: str
    theme: str
    size: tuple[int, int]

    @property
    def name(self) -> str:
        return f"{self.size[0]}-{self.theme}-{self.language}"


# Each size, each language and each appearance meets each of the others at least once.
VIEWS = (
    View("de", "light", PHONE),
    View("en", "dark", PHONE),
    View("de", "projector", TABLET),
    View("en", "light", LAPTOP),
    View("de", "dark", LAPTOP),
    View("en", "projector", DESKTOP),
    View("de", "light", DESKTOP),
    View("en", "dark", WALL),
)


@dataclass(frozen=True)
class Place:
    """A page, what must be there before it is taken, and what is done first."""

    name: str
    address: str
    ready: str = "main"
    first: Callable[[Page], object] = lambda _: None
    full: bool = False  # the whole length of the page


def key(name: str) -> Callable[[Page], object]:
    return lambda page: page.keyboard.press(name)


def click(selector: str, shown: str) -> Callable[[Page], object]:
    def press(page: Page) -> None:
        page.locator(selector).first.dispatch_event("click")
        page.locator(shown).first.wait_for(timeout=PATIENCE)

    return press


def answer(page: Page) -> None:
    """A wrong answer with its verdict and the motion it would mean."""
    page.locator(".answer-head .segments button").nth(1).click()
    page.locator("textarea.entry").fill("l*ddot(phi) = g*sin(phi)")
    page.locator(".answering button.main").click()
    page.locator(".verdict-card .acts button").first.click(timeout=PATIENCE)
    page.locator(".motions").wait_for(timeout=PATIENCE)


SCENE = "scene?scene=elastic-pendulum"
BOB = ".drawing path.bob"
PLACES = (
    Place("start", "?", ".hero path.bob"),
    Place("scene", f"{SCENE}&step=virtual-displacement:bob", BOB),
    Place("scene-plots", f"{SCENE}&panel=plots&step=generalized-forces", ".js-plotly-plot"),
    Place("scene-values", f"{SCENE}&panel=values", BOB),
    Place("scene-varied", f"{SCENE}&vary=on&panel=values&step=virtual-work", BOB),
    Place("scene-runs", "scene?scene=double-pendulum&with=phase&panel=plots&step=equation:phi2", BOB),
    Place("scene-why", f"{SCENE}&step=virtual-displacement:bob&why=virtual-displacement:bob", BOB),
    Place("scene-long", "scene?scene=triple-pendulum&step=equation:phi1", BOB),
    Place("scene-unknown", "scene?scene=nothing", ".failure"),
    Place("scene-overview", f"{SCENE}&step=virtual-work", BOB, key("o")),
    Place("scene-help", f"{SCENE}&step=virtual-work", BOB, key("?")),
    Place("scene-share", f"{SCENE}&step=virtual-work", BOB, click(".tools .tool:nth-of-type(2)", "dialog.share")),
    Place("editor", "scene?scene=pendulum&edit=form", ".editor .field .katex"),
    Place("lecture", f"{SCENE}&view=lecture&step=virtual-displacement:bob&part=2", ".slide .katex"),
    Place("lecture-plots", f"{SCENE}&view=lecture&step=lagrangian&beside=plots", ".slide .katex"),
    Place("proof", "proof?step=general-product-rule", ".steps .katex"),
    Place("proof-lecture", "proof?view=lecture&step=general-product-rule", ".slide .katex"),
    Place("presenter", "presenter?x=1", ".notice"),
    Place("handout", "handout?scene=elastic-pendulum", ".paper path.bob"),
    Place("embed", "embed?scene=elastic-pendulum&step=virtual-displacement:bob", BOB),
    Place("embed-proof", "embed/proof?step=general-product-rule", ".steps .katex"),
    Place("variations", "variations?", ".steps .katex", full=True),
    Place("labs", "labs?", ".question button.main"),
    Place(
        "labs-done",
        "labs?lab=convergence&scene=pendulum&t=1",
        "main",
        click("button.main:enabled", "p.files"),
        full=True,
    ),
    Place("homework", "homework?", "main .katex"),
    Place("homework-answered", "homework?scene=pendulum&task=equation:phi", ".question h2", answer, full=True),
    Place("homework-class", "homework?scene=pendulum&side=class", ".classroom .pick"),
    Place("help", "help?", "main h2"),
    Place("docs", "docs?", ".calls article"),
    Place("help", "help?", ".guide article", full=True),
    Place("docs-try", "docs/try?", ".trial textarea", click("button.main", ".answer pre")),
)


def chosen(words: list[str]) -> Iterator[tuple[Place, View]]:
    for place in PLACES:
        for view in VIEWS:
            name = f"{place.name}-{view.name}"
            if not words or any(word in name for word in words):
                yield place, view


def take(browser: Browser, address: str, folder: Path, place: Place, view: View) -> None:
    """One picture; what was not there in time is said and taken as it is."""
    width, height = view.size
    page = browser.new_page(viewport={"width": width, "height": height})
    separator = "" if place.address.endswith("?") else "&"
    page.goto(f"{address}{place.address}{separator}lang={view.language}&theme={view.theme}")
    try:
        page.locator(place.ready).first.wait_for(state="attached", timeout=PATIENCE)
        place.first(page)
    except Exception as error:  # noqa: BLE001 - a picture of the trouble says more
        print(f"{place.name}-{view.name}: {str(error).splitlines()[0]}")
    page.wait_for_timeout(MOTION)
    page.screenshot(path=folder / f"{place.name}-{view.name}.png", full_page=place.full)
    page.close()


def main(address: str, folder: Path, words: list[str]) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium(), args=list(FLAGS))
        for place, view in chosen(words):
            take(browser, address, folder, place, view)
        browser.close()


if __name__ == "__main__":
    main(sys.argv[1], Path(sys.argv[2]), sys.argv[3:])
