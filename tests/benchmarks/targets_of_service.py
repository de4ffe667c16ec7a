"""Rows of the table of targets: pages in a real browser, three hundred students, hostile texts."""

from __future__ import annotations

import asyncio
import statistics
from collections.abc import Iterator
from time import perf_counter

import httpx
from playwright.sync_api import Browser
from tests.api.hostile import LINES, Walk, ask, judged
from tests.benchmarks import bench_load
from tests.benchmarks.targets import REPEATS, Target
from tests.e2e import frames
from tests.e2e.browser import started
from tests.e2e.lecture import Lecture
from tests.serving import PATIENT, served

MOVING = ("pendulum", "double-pendulum", "elastic-pendulum")
HOSTILE = 3000  # texts, spread over all places of all calls but the experiments


def pages() -> Iterator[Target]:
    """A warm service and a real browser."""
    with served(**PATIENT) as service, started() as browser:
        first_step(browser, service.address)
        first = statistics.median(first_step(browser, service.address) for _ in range(REPEATS))
        yield Target("first step readable", "< 1 s", f"{first:.2f} s", first < 1.0, "python -m tests.e2e.opening")
        for scene in MOVING:
            found = [frames.moving(browser, service.address, scene) for _ in range(REPEATS)]
            p95 = statistics.median(each.p95 for each in found)
            told = f"{p95:.1f} ms ({', '.join(f'{each.p95:.1f}' for each in found)})"
            what = f"frames of {scene}, processor slowed 4 ×, 95th percentile"
            yield Target(what, "< 20 ms", told, p95 < 20.0, "python -m tests.e2e.frames")


def first_step(browser: Browser, address: str) -> float:
    """Seconds until an empty cache shows a formula."""
    page = browser.new_page(viewport={"width": 1366, "height": 768})
    start = perf_counter()
    page.goto(f"{address}scene?scene=elastic-pendulum&lang=en")
    page.locator(".steps .katex").first.wait_for()
    seconds = perf_counter() - start
    page.close()
    return seconds


def before_the_first_plot() -> Iterator[Target]:
    """Everything but Plotly that a page has fetched when its plots stand."""
    with served(**PATIENT) as service, started() as browser:
        lecture = Lecture(browser.new_page(), service.address)
        size = sum(lecture.bytes_before_the_first_plot().values())
    what, command = "bytes before the first plot", "pytest tests/e2e -k bytes"
    yield Target(what, "< 300 kB", f"{size / 1000:.0f} kB", size < 300_000, command)


def load() -> Iterator[Target]:
    """Three hundred students at one moment."""
    found = asyncio.run(bench_load.measured())
    p99, failed = statistics.median(each.p99 for each in found), sum(each.failed for each in found)
    told = f"{p99:.2f} s ({', '.join(f'{each.p99:.2f}' for each in found)}), {failed} failed"
    yield Target("300 students at one moment, p99", "< 1 s", told, p99 < 1.0 and not failed, "deltaq bench load")


async def answers(address: str) -> list[tuple[httpx.Response, float, str]]:
    """Answers, seconds and what is wrong: one text after the other, so that none waits for another."""
    found = []
    async with httpx.AsyncClient(base_url=address.rstrip("/"), timeout=60) as client:
        document = (await client.get("/api/v1/openapi.json")).json()
        slots = [slot for slot in Walk(document).slots() if "/experiments/" not in slot.path]
        for n in range(HOSTILE):
            text = LINES[n * 37 % len(LINES)]
            start = perf_counter()
            answer = await ask(client.request, slots[n % len(slots)], text)
            found.append((answer, perf_counter() - start, judged(answer, text)))
    return found


def hostile() -> Iterator[Target]:
    """What attackers and slips would send; a text that does no harm where it stands, as in a title, is no error."""
    with served(**PATIENT) as service:
        found = asyncio.run(answers(service.address))
    refused = [seconds for answer, seconds, _ in found if 400 <= answer.status_code < 500]
    wrong = sum(bool(what) for *_, what in found)
    told = f"{len(refused)} of {len(found)} texts refused, the slowest in {max(refused):.2f} s; {wrong} with harm"
    yield Target(
        "hostile texts", "refused in < 1 s", told, max(refused) < 1.0 and not wrong, "python -m tests.api.hostile"
    )
