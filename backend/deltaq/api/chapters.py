"""The chapters of a derivation as they are asked for: the equations of motion never wait for what is made of them.

One computation gives first the equations, then all. Who asks for the equations leaves it then; who asks for all or for
the rest receives the equations alone, or no chapter, where the rest fails or takes too long. That is not kept.
"""

from __future__ import annotations

import asyncio
import json
import logging
from collections.abc import Awaitable, Callable
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

from ..errors import InputError
from ..narration.outcome import missing
from .cache import Cache
from .flights import OnUpdate, Update
from .packing import pack, unpack
from .problems import report_of
from .workers.account import QuotaExceeded
from .workers.job import DeadlineExceeded, JobError, MemoryExceeded, Overloaded, WorkerKilled

LOGGER = logging.getLogger("deltaq.api")
MOMENT = 0.3  # seconds for which `ready` waits for the rest when it has the equations
LAST = ("model", "canonical")  # the chapters that the equations do not need
TOO_LARGE = (DeadlineExceeded, MemoryExceeded)
PASSING = (QuotaExceeded, Overloaded, WorkerKilled)  # what says nothing of the derivation

Compute = Callable[[OnUpdate], Awaitable[bytes]]


@dataclass(frozen=True)
class Found:
    """An answer, packed, and whether it may be kept under `name`: one that was cut may not."""

    name: str
    answer: bytes
    lasts: bool = True


@dataclass(frozen=True)
class Chapters:
    """Answers of one derivation. `compute` gives the whole and tells its first part; it is kept elsewhere."""

    identifier: str
    language: str
    cache: Cache
    compute: Compute

    async def answer(self, asked: str) -> Found:
        """`all`, `equations`, `model`, or what is `ready`; errors only where not even the equations were found."""
        kept = asked in ("equations", "model")
        known = await self.cache.find(self._key(asked)) if kept else None
        found = Found(asked, known) if known else await self._computed(asked)
        if kept and found.lasts and not known:
            await self.cache.keep(self._key(asked), found.answer)
        return found

    async def _computed(self, asked: str) -> Found:
        first: asyncio.Future[bytes] = asyncio.get_running_loop().create_future()
        heard: list[bytes] = []

        def hear(update: Update) -> None:
            if update.kind == "part":
                heard[:] = [update.data]
                if not first.done() and _has_steps(update.data):
                    first.set_result(update.data)

        whole = asyncio.ensure_future(_awaited(self.compute(hear)))
        try:
            if await self._is_enough(asked, first, whole):
                return await asyncio.to_thread(_equations, first.result())
            return await asyncio.to_thread(_selected, asked, await whole)
        except (JobError, InputError) as error:
            if isinstance(error, PASSING) or not heard:
                raise
            return await asyncio.to_thread(self._cut, asked, heard[0], error)
        finally:
            if asked == "ready":  # the rest will be asked for in a moment
                whole.add_done_callback(_seen)
            else:
                whole.cancel()

    async def _is_enough(self, asked: str, first: asyncio.Future[bytes], whole: asyncio.Future[bytes]) -> bool:
        """Whether the equations are the answer."""
        if asked not in ("equations", "ready"):
            return False
        await asyncio.wait((first, whole), return_when=asyncio.FIRST_COMPLETED)
        if asked == "ready" and not whole.done():
            await asyncio.wait((whole,), timeout=MOMENT)
        return not whole.done()

    def _cut(self, asked: str, newest: bytes, error: Exception) -> Found:
        """What was told last, and why the rest is missing."""
        if not isinstance(error, TOO_LARGE):
            report_of(error)  # is logged
        document = json.loads(newest)
        why = missing("model", "time" if isinstance(error, TOO_LARGE) else "failed", self.language)
        document["left_out"] = [why if each["reason"] == "later" else each for each in document["left_out"]]
        if asked in ("equations", "model"):
            document["chapters"] = _of(asked, document["chapters"])
        return Found("cut", _packed(document), lasts=False)

    def _key(self, asked: str) -> str:
        return f"{self.identifier}.derivation-{asked}"


async def _awaited(compute: Awaitable[bytes]) -> bytes:
    return await compute


def _seen(whole: asyncio.Future[bytes]) -> None:
    """Nobody waits for it; what goes wrong is told to who asks next."""
    with suppress(asyncio.CancelledError):
        whole.exception()


def _selected(asked: str, whole: bytes) -> Found:
    """What is asked for of all."""
    if asked not in ("equations", "model"):
        return Found("all", whole)
    document = json.loads(unpack(whole))
    return Found(asked, _packed({**document, "chapters": _of(asked, document["chapters"])}))


def _equations(part: bytes) -> Found:
    """The first part as an answer, which may be kept if there was time for all its steps."""
    left_out = json.loads(part)["left_out"]
    return Found("equations", pack(part), lasts=all(each["reason"] != "time" for each in left_out))


def _of(asked: str, chapters: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """The chapters that are asked for."""
    return [each for each in chapters if (each["id"] in LAST) is (asked == "model")]


def _has_steps(part: bytes) -> bool:
    """Whether it is more than the results, with which the part of a large scene begins."""
    return all(each["reason"] == "later" or each["part"] != "model" for each in json.loads(part)["left_out"])


def _packed(document: dict[str, Any]) -> bytes:
    return pack(json.dumps(document, ensure_ascii=False, separators=(",", ":")).encode())
