"""Frame times of the moving page: `python -m tests.e2e.frames http://127.0.0.1:8000/ [scene …]`.

The plots are open, the processor is slowed four times, as in the target of 60 frames per second. Prints, in
milliseconds between two frames, the median, the 95th percentile and the longest; judges nothing.
"""

from __future__ import annotations

import sys
from itertools import pairwise
from statistics import quantiles

from playwright.sync_api import Browser, sync_playwright
from tests.e2e.browser import FLAGS, chromium
from tests.e2e.lecture import Lecture

SLOWER, FRAMES = 4, 240
SCENES = ("elastic-pendulum", "double-pendulum", "heavy-top")
# Distances of the frames' own stamps; the first second is left out, in which the page may still be finishing.
STAMPS = """count => new Promise(done => {
    const stamps = [];
    const stamp = now => stamps.push(now) < count ? requestAnimationFrame(stamp) : done(stamps);
    setTimeout(() => requestAnimationFrame(stamp), 1000);
})"""


def frame_times(browser: Browser, address: str, scene: str) -> list[float]:
    """Milliseconds between frames while the scene moves beside its plots."""
    page = browser.new_page(viewport={"width": 1366, "height": 768})
    Lecture(page, address).open(f"?scene={scene}&lang=en&duration=20")
    page.locator(".plots.ready").wait_for()
    page.context.new_cdp_session(page).send("Emulation.setCPUThrottlingRate", {"rate": SLOWER})
    stamps = page.evaluate(STAMPS, FRAMES)
    page.close()
    return [later - earlier for earlier, later in pairwise(stamps)]


def main(address: str, *scenes: str) -> None:
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium(), args=list(FLAGS))
        for scene in scenes or SCENES:
            times = frame_times(browser, address, scene)
            cuts = quantiles(times, n=100)
            print(f"{scene:20} median {cuts[49]:5.1f}   p95 {cuts[94]:5.1f}   longest {max(times):5.1f} ms", flush=True)
        browser.close()


if __name__ == "__main__":
    main(*sys.argv[1:])
