"""Pictures of every page to look at: `python -m tests.e2e.gallery http://127.0.0.1:8000/ folder [words of names …]`.

Each place is taken in each language, appearance and size that changes what is seen; scenes are taken in motion.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from playwright.sync_api import Browser, Page
from tests.e2e.browser import started
from tests.e2e.places import PLACES, Place
from tests.e2e.waiting import PATIENCE

PHONE, TABLET, LAPTOP, DESKTOP, WALL = (360, 740), (768, 1024), (1366, 768), (1920, 1080), (3840, 2160)
MOTION = 1700.0  # milliseconds until a pendulum stands well
# How high a window must be, so that what scrolls in it is seen as a whole.
LENGTH = """() => innerHeight + Math.max(0, ...[document.scrollingElement, ...document.querySelectorAll('#page *')]
    .map(e => e.scrollHeight - e.clientHeight).filter(Number.isFinite))"""
LONGEST = 8000


@dataclass(frozen=True)
class View:
    """One combination of language, appearance and size."""

    language: str
    theme: str
    size: tuple[int, int]

    @property
    def name(self) -> str:
        return f"{self.size[0]}-{self.theme}-{self.language}"

    @property
    def touched(self) -> bool:
        return self.size in (PHONE, TABLET)


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
LOCALES = {"de": "de-DE", "en": "en-GB"}
FEW_VIEWS = (View("de", "light", PHONE), View("en", "dark", LAPTOP), View("de", "projector", DESKTOP))


def chosen(words: list[str]) -> Iterator[tuple[Place, View]]:
    for place in PLACES:
        for view in FEW_VIEWS if place.seldom else VIEWS:
            name = f"{place.name}-{view.name}"
            if not words or any(word in name for word in words):
                yield place, view


def opened(page: Page, address: str, place: Place, view: View) -> Page:
    """The page to be taken; what was not there in time is said and taken as it is."""
    separator = "" if place.address.endswith("?") else "&"
    page.goto(f"{address}{place.address}{separator}lang={view.language}&theme={view.theme}")
    try:
        page.locator(place.ready).first.wait_for(state="attached")
        return place.first(page) or page
    except Exception as error:  # noqa: BLE001 - a picture of the trouble says more
        print(f"{place.name}-{view.name}: {str(error).splitlines()[0]}")
        return page


def take(browser: Browser, address: str, folder: Path, place: Place, view: View) -> None:
    width, height = view.size
    context = browser.new_context(
        viewport={"width": width, "height": height}, has_touch=view.touched, locale=LOCALES[view.language]
    )
    context.set_default_timeout(PATIENCE)
    page = opened(context.new_page(), address, place, view)
    page.wait_for_timeout(MOTION)
    if place.full:
        page.set_viewport_size({"width": width, "height": max(height, min(page.evaluate(LENGTH), LONGEST))})
        page.wait_for_timeout(MOTION)
    page.screenshot(path=folder / f"{place.name}-{view.name}.png")
    context.unroute_all(behavior="ignoreErrors")
    context.close()


def main(address: str, folder: Path, words: list[str]) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    with started() as browser:
        for place, view in chosen(words):
            take(browser, address, folder, place, view)


if __name__ == "__main__":
    main(sys.argv[1], Path(sys.argv[2]), sys.argv[3:])
