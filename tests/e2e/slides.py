"""How large the formulas of slides are: `python -m tests.e2e.slides http://127.0.0.1:8000/ [scene …]`.

At each size of projector, for all steps of all scenes (or of those named): how many have letters of at least 5 % of the
height of the screen, how many do not fit on one screen or scroll sideways, and how small the smallest are. Judges
nothing.
"""

from __future__ import annotations

import json
import sys
import urllib.request
from collections.abc import Iterator
from dataclasses import dataclass

from playwright.sync_api import Browser, Page
from tests.e2e.browser import started
from tests.e2e.waiting import PATIENCE

SIZES = ((1024, 768), (1280, 800), (1366, 768), (1920, 1080), (2560, 1440), (3840, 2160))
ENOUGH = 0.05
MEASURE = """() => {
    const [slide, scroll] = [document.querySelector('.slide'), document.querySelector('.slide .scroll')];
    const formulas = [...slide.querySelectorAll('.result .formula, .newest .formula')];
    const letters = formulas.flatMap(one => [...one.querySelectorAll('.katex')])
        .map(one => parseFloat(getComputedStyle(one).fontSize));
    const size = letters.length ? Math.max(...letters) : 0;
    return {step: slide.querySelector('.step').dataset.step, size: size / innerHeight,
        fits: scroll.scrollHeight <= scroll.clientHeight + 1,
        sideways: [...slide.querySelectorAll('.scroll, .given ul, .given .formula, .scroll .formula')]
            .filter(one => one.scrollWidth > one.clientWidth + 1).length,
        root: parseFloat(getComputedStyle(document.documentElement).fontSize)};
}"""
# With the tools, which come after the first formula: they tell what the marks on terms mean.
AT_REST = """step =>
    document.querySelector('.slide[data-filled] .step, .slide .step:not(:has(.formula))')?.dataset.step === step
    && document.querySelector('.slide .why') !== null
"""


@dataclass(frozen=True)
class Slide:
    """A step as it is shown: its letters as a part of the height of the screen (0 without a formula).

    `sideways` counts what scrolls sideways, premises among it.
    """

    step: str
    size: float
    fits: bool
    sideways: int
    root: float


def steps_of(address: str, scene: str) -> list[str]:
    """The steps of a scene in their order."""
    body = json.dumps({"scene": scene, "lang": "en"}).encode()
    request = urllib.request.Request(f"{address}api/v1/derivations", body, {"content-type": "application/json"})
    with urllib.request.urlopen(request, timeout=PATIENCE / 1000) as answer:
        return [step["id"] for chapter in json.load(answer)["chapters"] for step in chapter["steps"]]


def opened(page: Page, address: str, scene: str, step: str = "") -> None:
    """A scene in lecture mode, complete."""
    page.goto(f"{address}scene?scene={scene}&lang=en&view=lecture&step={step}")
    page.locator("#derivation[aria-busy=false] .katex").first.wait_for()


def slides(page: Page, steps: list[str]) -> Iterator[Slide]:
    """Each of the steps that follow each other, from the one that is shown."""
    for step in steps:
        page.wait_for_function(AT_REST, arg=step)
        page.evaluate("document.fonts.ready")
        yield Slide(**page.evaluate(MEASURE))
        page.keyboard.press("PageDown")


def share(found: list[Slide]) -> float:
    """Of the slides with formulas, those with letters that are large enough."""
    sizes = [slide.size for slide in found if slide.size]
    return sum(size >= ENOUGH for size in sizes) / max(1, len(sizes))


def survey(browser: Browser, address: str, scenes: list[str], width: int, height: int) -> None:
    context = browser.new_context(viewport={"width": width, "height": height}, reduced_motion="reduce")
    context.set_default_timeout(PATIENCE)
    page = context.new_page()
    found: list[Slide] = []
    for scene in scenes:
        opened(page, address, scene)
        own = list(slides(page, steps_of(address, scene)))
        found += own
        least = min(own, key=lambda slide: slide.size or 1)
        over = [slide.step for slide in own if not slide.fits]
        aside = [slide.step for slide in own if slide.sideways]
        print(
            f"  {scene:32} {share(own):4.0%} of {len(own)}  least {least.size:.1%} {least.step}"
            f"  {over or ''}  {'sideways' if aside else ''} {aside or ''}",
            flush=True,
        )
    over = sum(not slide.fits for slide in found)
    aside = sum(slide.sideways > 0 for slide in found)
    print(
        f"{width}×{height}: {share(found):.0%} of {len(found)} slides ≥ {ENOUGH:.0%}; "
        f"{over} higher than the screen, {aside} scroll sideways",
        flush=True,
    )
    context.close()


def main(address: str, *scenes: str) -> None:
    with urllib.request.urlopen(f"{address}api/v1/scenes") as answer:
        known = [scene["id"] for scene in json.load(answer)["scenes"]]
    with started() as browser:
        for width, height in SIZES:
            survey(browser, address, list(scenes) or known, width, height)


if __name__ == "__main__":
    main(*sys.argv[1:])
