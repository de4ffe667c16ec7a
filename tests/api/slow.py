"""Derivations whose last chapter takes too long, fails, or takes its time; their equations are the real ones."""

from __future__ import annotations

import time
from typing import Any

from deltaq.api.jobs import Parts, derive

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


def unhurried(document: Document) -> Parts:
    parts = derive(document)
    yield next(parts)
    time.sleep(PAUSE)
    return (yield from parts)
