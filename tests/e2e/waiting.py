"""Waiting for what a page comes to, where playwright's own expectations do not reach."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TypeVar

from playwright.sync_api import FloatRect, Locator, Page

Found = TypeVar("Found")
# Milliseconds until a page that does not come to what is expected is called broken. Waiting costs nothing where all is
# well, and a busy machine is not an error: this is the one place where browser tests say how long is too long.
PATIENCE = 300_000.0
PAUSE = 50.0  # milliseconds between two looks


def until(page: Page, read: Callable[[], Found], wanted: Callable[[Found], bool]) -> Found:
    """What is read as soon as it is as wanted; what was read last is told if it never is."""
    end = time.monotonic() + PATIENCE / 1000
    while not wanted(found := read()):
        assert time.monotonic() < end, f"still {found!r}"
        page.wait_for_timeout(PAUSE)
    return found


def until_equal(page: Page, read: Callable[[], Found], wanted: object) -> None:
    until(page, read, lambda found: found == wanted)


def at_rest(part: Locator) -> FloatRect:
    """Where it stands once it no longer moves: a hand that is sent to a place read before may miss what it was for."""
    boxes: list[FloatRect | None] = [None]

    def looked() -> bool:
        boxes.append(part.bounding_box())
        return boxes[-1] is not None and boxes[-1] == boxes[-2]

    until(part.page, looked, bool)
    box = boxes[-1]
    assert box is not None
    return box


def frames(page: Page, count: int) -> None:
    """So many pictures of the page: what moves by itself has moved by then."""
    page.evaluate(
        """count => new Promise(done => {
            const frame = () => count-- > 0 ? requestAnimationFrame(frame) : done();
            frame();
        })""",
        count,
    )
