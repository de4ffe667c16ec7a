"""Frame times of the moving page: `python -m tests.e2e.frames http://127.0.0.1:8000/ [scene …]`.

The plots are open, the processor is slowed four times, as in the target of 60 frames per second. Prints, in
milliseconds between two frames, the median, the 95th percentile and the longest; before them what a frame takes of
the page's thread when nothing is slowed, which other work on the machine hardly changes: four times this must fit into
16.7. First of all the same for a bare page with one moving circle, the least there can be. Judges nothing.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from itertools import pairwise
from statistics import quantiles

from playwright.sync_api import Browser, CDPSession, Page
from tests.e2e.browser import started
from tests.e2e.lecture import Lecture
from tests.e2e.waiting import PATIENCE

SLOWER, FRAMES = 4, 240
SCENES = ("pendulum", "elastic-pendulum", "double-pendulum", "heavy-top")
# Distances of the frames' own stamps; the first second is left out, in which the page may still be finishing.
STAMPS = """count => new Promise(done => {
    const stamps = [];
    const stamp = now => stamps.push(now) < count ? requestAnimationFrame(stamp) : done(stamps);
    setTimeout(() => requestAnimationFrame(stamp), 1000);
})"""
BARE = """<style>div { width: 40px; height: 40px; border-radius: 50%; background: #222; will-change: transform }</style>
<div></div><script>
const circle = document.querySelector("div");
const move = now => {
    circle.style.transform = `translate(${300 + 200 * Math.sin(now / 500)}px, 300px)`;
    requestAnimationFrame(move);
};
move(0);
</script>"""


def thread_time(session: CDPSession) -> float:
    """Milliseconds that the page's thread has worked."""
    metrics = session.send("Performance.getMetrics")["metrics"]
    return 1000 * float(next(metric["value"] for metric in metrics if metric["name"] == "TaskDuration"))


@dataclass(frozen=True)
class Frames:
    """What a frame takes of the page's thread unslowed, and the times between slowed frames, in milliseconds."""

    work: float
    median: float
    p95: float
    longest: float

    def __str__(self) -> str:
        between = f"median {self.median:5.1f}   p95 {self.p95:5.1f}   longest {self.longest:5.1f} ms"
        return f"work {self.work:4.1f}   {between}"


def measure(page: Page) -> Frames:
    session = page.context.new_cdp_session(page)
    session.send("Performance.enable", {"timeDomain": "threadTicks"})
    page.evaluate(STAMPS, 2)
    begun = thread_time(session)
    page.evaluate(STAMPS, FRAMES)
    # The waiting second before the stamps is made of frames, too.
    work = (thread_time(session) - begun) / (FRAMES + 60)
    session.send("Performance.disable")
    session.send("Emulation.setCPUThrottlingRate", {"rate": SLOWER})
    times = [later - earlier for earlier, later in pairwise(page.evaluate(STAMPS, FRAMES))]
    cuts = quantiles(times, n=100)
    return Frames(work, cuts[49], cuts[94], max(times))


def bare(browser: Browser) -> Frames:
    """The least that a frame takes."""
    page = browser.new_page(viewport={"width": 1366, "height": 768})
    page.set_default_timeout(PATIENCE)
    page.set_content(BARE)
    found = measure(page)
    page.close()
    return found


def moving(browser: Browser, address: str, scene: str) -> Frames:
    """The scene moves beside its plots."""
    page = browser.new_page(viewport={"width": 1366, "height": 768})
    page.set_default_timeout(PATIENCE)
    Lecture(page, address).open(f"?scene={scene}&lang=en&duration=20")
    page.locator(".plots.ready").wait_for()
    found = measure(page)
    page.close()
    return found


def main(address: str, *scenes: str) -> None:
    with started() as browser:
        print(f"{'one circle':20} {bare(browser)}", flush=True)
        for scene in scenes or SCENES:
            print(f"{scene:20} {moving(browser, address, scene)}", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
