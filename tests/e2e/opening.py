"""How fast the pages open: `python -m tests.e2e.opening http://127.0.0.1:8000/ [page …]`.

Every page with an empty cache on a processor slowed four times, over the machine's own network and over a slow one
(150 ms to the first byte, 1.6 Mbit/s down, 0.75 up: Lighthouse's "slow 4G"). Prints what Lighthouse prints: first and
largest contentful paint in ms, the layout shift over the first ten seconds, the blocking time (what tasks after the
first paint take beyond 50 ms each), the longest task, requests and kB as sent. Judges nothing.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass

from playwright.sync_api import Browser, Page, Request
from tests.e2e.browser import started
from tests.e2e.waiting import PATIENCE

SLOWER = 4
WATCHED = 10_000  # milliseconds; what is fetched without being asked for has come by then
SLOW_4G = {"offline": False, "latency": 150, "downloadThroughput": 1.6e6 / 8, "uploadThroughput": 0.75e6 / 8}
PAGES = {
    "start": "?lang=en",
    "scene": "scene?scene=elastic-pendulum&lang=en",
    "chapter": "scene?scene=base-pendulum&step=virtual-displacement:bob&lang=en",
    "lecture": "scene?scene=elastic-pendulum&view=lecture&step=virtual-displacement:bob&lang=en",
    "embed": "embed?scene=elastic-pendulum&lang=en",
    "labs": "labs?lang=en",
    "homework": "homework?lang=en",
    "variations": "variations?lang=en",
    "proof": "proof?lang=en",
}
OBSERVE = """() => {
    const seen = (window.seen = {largest: 0, largestIs: '', shift: 0, shifted: [], tasks: []});
    const name = node => node && (node.parentElement?.className || '') + ' > ' + (node.className || node.nodeName);
    const observe = (type, note) =>
        new PerformanceObserver(list => list.getEntries().forEach(note)).observe({type, buffered: true});
    observe('largest-contentful-paint', e => { seen.largest = e.startTime; seen.largestIs = name(e.element); });
    observe('layout-shift', e => {
        if (e.hadRecentInput) return;
        seen.shift += e.value;
        seen.shifted.push(...e.sources.map(source => `${e.value.toFixed(4)} ${name(source.node)}`));
    });
    observe('longtask', e => seen.tasks.push([e.startTime, e.duration]));
}"""
READ = "() => ({...seen, first: performance.getEntriesByName('first-contentful-paint')[0]?.startTime ?? NaN})"


@dataclass(frozen=True)
class Opening:
    """What opening a page took; times in milliseconds."""

    first: float
    largest: float
    largest_is: str
    shift: float
    shifted: list[str]
    blocked: float
    longest: float
    requests: int
    kilobytes: float

    def __str__(self) -> str:
        return (
            f"{self.first:7.0f} {self.largest:7.0f} {self.shift:8.4f} {self.blocked:9.0f} {self.longest:8.0f}"
            f" {self.requests:9d} {self.kilobytes:7.0f}   {self.largest_is}"
        )


def open_page(browser: Browser, address: str, network: dict[str, object] | None) -> Opening:
    """The page at `address`, opened for the first time."""
    context = browser.new_context(viewport={"width": 1366, "height": 768})
    context.set_default_timeout(PATIENCE)
    page = context.new_page()
    page.add_init_script(f"({OBSERVE})()")
    sent: list[Request] = []

    def note(request: Request) -> None:
        sent.append(request)

    page.on("requestfinished", note)
    session = context.new_cdp_session(page)
    session.send("Emulation.setCPUThrottlingRate", {"rate": SLOWER})
    if network:
        session.send("Network.enable")
        session.send("Network.emulateNetworkConditions", network)
    page.goto(address)
    page.wait_for_timeout(WATCHED)
    found = _found(page, sent)
    context.close()
    return found


def _found(page: Page, sent: list[Request]) -> Opening:
    seen = page.evaluate(READ)
    sizes = [request.sizes() for request in sent]
    return Opening(
        first=seen["first"],
        largest=seen["largest"],
        largest_is=seen["largestIs"],
        shift=seen["shift"],
        shifted=seen["shifted"],
        blocked=sum(duration - 50 for start, duration in seen["tasks"] if start + duration > seen["first"]),
        longest=max((duration for _, duration in seen["tasks"]), default=0.0),
        requests=len(sent),
        kilobytes=sum(size["responseBodySize"] + size["responseHeadersSize"] for size in sizes) / 1000,
    )


def main(address: str, *names: str) -> None:
    print(f"{'':20} {'first':>7} {'largest':>7} {'shift':>8} {'blocking':>9} {'longest':>8} {'requests':>9} {'kB':>7}")
    with started() as browser:
        for network, conditions in (("own", None), ("slow 4G", SLOW_4G)):
            for name in names or PAGES:
                opening = open_page(browser, address + PAGES[name], conditions)
                print(f"{name:12} {network:7} {opening}", *opening.shifted, sep="\n    ", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
