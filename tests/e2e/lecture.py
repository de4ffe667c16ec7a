"""The page in the hands of a lecturer: what tests do with it and read from it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

from playwright.sync_api import Locator, Page, Request

ROWS = re.compile(r"/(view/rows|assets/rows-\w+)\.js$")  # how long formulas are set, in the sources and in the bundle
VIOLATIONS = "document.addEventListener('securitypolicyviolation', e => console.error('CSP ' + e.violatedDirective))"


@dataclass
class Lecture:
    """A page of the server at `address`; `complaints` are console errors, exceptions and policy violations."""

    page: Page
    address: str
    complaints: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.page.add_init_script(VIOLATIONS)
        self.page.on("console", self._hear)
        self.page.on("pageerror", lambda error: self.complaints.append(f"exception: {error}"))

    def _hear(self, message: Any) -> None:
        if message.type in ("error", "warning"):
            self.complaints.append(f"{message.type}: {message.text}")

    def open(self, query: str = "?scene=elastic-pendulum&lang=de") -> None:
        """Load a place and wait for its first step, its drawing and the chapter that comes last."""
        self.page.goto(f"{self.address}scene{query}")
        self.steps.first.wait_for(state="attached")
        self.bob.wait_for(state="attached")
        self.await_last_chapter()

    def await_last_chapter(self) -> None:
        """The equations are shown first: before the chapter behind them has come, the last step is another one."""
        self.page.locator("#derivation[aria-busy=false]").wait_for(state="attached")

    @contextmanager
    def asked(self) -> Iterator[list[str]]:
        """The addresses that the page asks the server for meanwhile, but for those from its cache."""
        network = self.page.context.new_cdp_session(self.page)
        addresses: dict[str, str] = {}
        kept: set[str] = set()  # in memory

        def note(event: dict[str, Any]) -> None:
            answer = event["response"]
            if answer["url"].startswith(self.address) and not answer.get("fromDiskCache"):
                addresses[event["requestId"]] = answer["url"]

        network.on("Network.responseReceived", note)
        network.on("Network.requestServedFromCache", lambda event: kept.add(event["requestId"]))
        network.send("Network.enable")
        found: list[str] = []
        yield found
        network.detach()
        found.extend(address for one, address in addresses.items() if one not in kept)

    def bytes_before_the_first_plot(self) -> dict[str, int]:
        """By address, what the page has fetched when its plots stand, but for the library that draws them."""
        received: dict[str, int] = {}

        def count(request: Request) -> None:
            sizes = request.sizes()
            size = sizes["responseBodySize"] + sizes["responseHeadersSize"]
            received[request.url] = received.get(request.url, 0) + size

        self.page.on("requestfinished", count)
        self.open()
        self.page.locator(".plots.ready").wait_for()
        self.page.wait_for_load_state("networkidle")
        return {address: size for address, size in received.items() if "plotly" not in address}

    @property
    def steps(self) -> Locator:
        return self.page.locator(".steps > .step")

    @property
    def bob(self) -> Locator:
        return self.page.locator(".drawing path.bob").first

    @property
    def current_step(self) -> str:
        return self.page.locator(".step[aria-current]").get_attribute("data-step") or ""

    def bob_position(self) -> tuple[float, float]:
        """Pixels of the bob in the drawing."""
        place = re.search(r"translate\(([-\d.]+) ([-\d.]+)\)", self.bob.get_attribute("transform") or "")
        assert place is not None
        return float(place[1]), float(place[2])

    def number_of_steps(self) -> int:
        return int((self.page.locator(".progress .count").text_content() or "").split("/")[1])

    def pause_at(self, seconds: float) -> None:
        """Stop the motion at a moment, by the slider."""
        scrub = self.page.locator(".scrub")
        scrub.evaluate("(e, t) => { e.value = t; e.dispatchEvent(new Event('input', {bubbles: true})) }", seconds)
