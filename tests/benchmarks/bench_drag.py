"""A body taken in hand: milliseconds from the pointer's move to the drawing that follows, and to the new motion.

Run it from the checkout: `python -m tests.benchmarks.bench_drag [--rounds 20] [--scene double-pendulum]`. It starts a
service and a browser of its own. One move at a time: the first frame in which the drawing has changed, and that in
which the plots have the curves of the motion that begins there; how much of this the request took. Then the hand keeps
moving: motions shown in a second. Medians and the slowest of ten. Prints; judges nothing.
"""

from __future__ import annotations

import argparse
import os
from statistics import median, quantiles

from playwright.sync_api import Page, expect
from tests.e2e.browser import started
from tests.e2e.lecture import Lecture
from tests.serving import PATIENCE, served

WATCH = """() => {
  const marks = (window.marks = { moves: [], drawn: [], curves: [] });
  const note = (name) => requestAnimationFrame(() => setTimeout(() => marks[name].push(performance.now())));
  document.addEventListener("pointermove", () => marks.moves.push(performance.now()), true);
  const everything = { subtree: true, childList: true, attributes: true };
  new MutationObserver(() => note("drawn")).observe(document.querySelector(".drawing"), everything);
  const isCurve = ({ target, attributeName }) => attributeName === "d" && target.closest(".scatterlayer");
  new MutationObserver((found) => found.some(isCurve) && note("curves")).observe(document.querySelector(".plots"), {
    subtree: true, attributes: true, attributeFilter: ["d"] });
}"""
CLEAR = "() => { for (const each of Object.values(marks)) each.length = 0; performance.clearResourceTimings(); }"
SEEN = "() => marks.moves.length && marks.drawn.length && marks.curves.length"
FOUND = """() => ({ ...marks, requests: performance.getEntriesByType("resource")
  .filter(({ name }) => name.endsWith("/simulations"))
  .map(({ startTime, responseEnd }) => responseEnd - startTime) })"""
STILL = 500  # milliseconds after which nothing is under way any more
SECONDS, EVERY = 4.0, 16.0  # of the hand that keeps moving; milliseconds between its moves


def told(name: str, values: list[float]) -> None:
    print(f"{name:52}{median(values):7.0f} ms, slowest tenth{quantiles(values, n=10)[-1]:6.0f} ms", flush=True)


def one_by_one(page: Page, at: tuple[float, float], rounds: int) -> None:
    """Single moves, each after all is still."""
    drawn, curves, requests = list[float](), list[float](), list[float]()
    for number in range(rounds):
        page.wait_for_timeout(STILL)
        page.evaluate(CLEAR)
        page.mouse.move(at[0] + 20 + 3 * (number % 7), at[1] - 5 * (number % 5))
        page.wait_for_function(SEEN)
        found = page.evaluate(FOUND)
        drawn.append(found["drawn"][0] - found["moves"][0])
        curves.append(found["curves"][0] - found["moves"][0])
        requests.append(found["requests"][0])
    told("pointer to the drawing", drawn)
    told("pointer to the curves of the new motion", curves)
    told("  of that the request", requests)


def moving(page: Page, at: tuple[float, float]) -> None:
    """A hand that keeps moving."""
    page.wait_for_timeout(STILL)
    page.evaluate(CLEAR)
    for number in range(int(1e3 * SECONDS / EVERY)):
        page.mouse.move(at[0] + 20 + number % 40, at[1] - number % 23)
        page.wait_for_timeout(EVERY)
    found = page.evaluate(FOUND)
    seconds = 1e-3 * (found["moves"][-1] - found["moves"][0])
    for name, key in (("drawing", "drawn"), ("curves", "curves")):
        frames = sorted({round(each) for each in found[key]})
        print(f"a hand that keeps moving: {name} {len(frames) / seconds:.1f} times a second")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=20)
    parser.add_argument("--scene", default="double-pendulum")
    asked = parser.parse_args()
    print(f"{asked.scene}, load {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")
    with served() as service, started() as browser:
        page = browser.new_page(viewport={"width": 1366, "height": 768})
        page.set_default_timeout(1e3 * PATIENCE)
        page.emulate_media(reduced_motion="reduce")  # nothing moves by itself
        page.goto(f"{service.address}scene?scene={asked.scene}&lang=en")
        page.locator(".js-plotly-plot").first.wait_for()
        Lecture(page, service.address).await_last_chapter()
        page.locator(".drawing").hover()  # what takes bodies in hand is loaded when somebody points at them
        handle = page.locator(".handle").last
        expect(handle).to_be_attached()
        box = handle.bounding_box()
        assert box is not None
        at = (box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
        page.evaluate(WATCH)
        page.mouse.move(*at)
        page.mouse.down()
        one_by_one(page, at, asked.rounds)
        moving(page, at)


if __name__ == "__main__":
    main()
