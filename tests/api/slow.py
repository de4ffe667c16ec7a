"""Jobs that take too long, fail, or take their time, derivations in their last chapter; what comes before is real."""

from __future__ import annotations

import time
from typing import Any

from deltaq.api.jobs import Parts, derive, ensemble_in_blocks, export
from deltaq.narration.derive import TimeIsUp

Document = dict[str, Any]
PAUSE = 1.5


def endless(document: Document) -> Parts:
    yield next(derive(document))
    while True:
        pass


def failing(document: Document) -> Parts:
    yield next(derive(document))
    raise ArithmeticError("of the last chapter")


def hopeless(_: Document) -> Document:
    while True:
        pass


def never_ready(_connection: object, _memory: int, _niceness: int) -> None:
    """A worker that does not come up."""
    time.sleep(3600.0)


def unhurried(document: Document) -> Parts:
    parts = derive(document)
    yield next(parts)
    time.sleep(PAUSE)
    return (yield from parts)


def broken_ensemble(document: Document) -> Parts:
    for block in ensemble_in_blocks(document):
        if block["first"] != 64:
            yield block
    raise ArithmeticError("of one block")


def without_steps(document: Document) -> Parts:
    """A large scene whose time is over when its equations are there."""
    parts = derive(document)
    yield next(parts)
    yield next(parts)
    raise TimeIsUp


def file_without_steps(document: Document) -> Parts:
    """A file for which there was no time but for its equations."""
    return (yield from export({**document, "seconds": 1e-9}))


def hurried(document: Document) -> Parts:
    return (yield from derive({**document, "seconds": 1e-9}))
