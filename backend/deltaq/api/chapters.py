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

        def hear(update: Update) -> None:
            if update.kind == "part" and not first.done():
                first.set_result(update.data)

        whole = asyncio.ensure_future(_awaited(self.compute(hear)))
        try:
            if await self._is_enough(asked, first, whole):
                return Found("equations", await asyncio.to_thread(pack, first.result()))
            return await asyncio.to_thread(_selected, asked, await whole)
        except (JobError, InputError) as error:
            if isinstance(error, PASSING) or not first.done():
                raise
            return await asyncio.to_thread(self._cut, asked, first.result(), error)
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

    def _cut(self, asked: str, equations: bytes, error: Exception) -> Found:
        """The equations, and why the rest is missing."""
        if not isinstance(error, TOO_LARGE):
            report_of(error)  # is logged
        document = json.loads(equations)
        why = missing("model", "time" if isinstance(error, TOO_LARGE) else "failed", self.language)
        document["left_out"] = [why if each["part"] == "model" else each for each in document["left_out"]]
        if asked == "model":
            document["chapters"] = []
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
    chapters = [each for each in document["chapters"] if (each["id"] in LAST) is (asked == "model")]
    return Found(asked, _packed({**document, "chapters": chapters}))


def _packed(document: dict[str, Any]) -> bytes:
    return pack(json.dumps(document, ensure_ascii=False, separators=(",", ":")).encode())
