"""A table of answers marked row by row: none holds a worker for longer than one may, and between two others get theirs.

One row is under way at a time, so a table waits its turn in the queue as a single check does. Each verdict is cached
by itself, without the name of who gave the answer: what many students wrote is judged once, and whoever asks again
where the service was busy, or time was over, gets further.
"""

from __future__ import annotations

import asyncio
import json
import time
from collections.abc import AsyncGenerator, AsyncIterator, Awaitable, Callable
from dataclasses import asdict, dataclass, fields
from typing import Any

from ..contract.check import RowQuestion
from ..contract.verdict import RowVerdict
from ..errors import InputError, Problem
from ..homework.gradebook import Document, Gradebook, Plan, refusal
from ..homework.platforms import canvas_csv, moodle_csv
from ..homework.results import Graded, results_csv, totals
from ..narration.catalog import message, text
from ..vocabulary import Language
from .batches import OUT_OF_TIME, TOO_LARGE
from .streams import event
from .workers.account import QuotaExceeded
from .workers.job import DeadlineExceeded, MemoryExceeded, Overloaded

LONGEST = 1800.0  # seconds after which no other row of a stream is begun
TOTALS_PAUSE = 0.5  # seconds between two totals of a stream, and as many more as there are thousands of rows
BUSY_PAUSE = 3.0  # seconds after which a busy service is asked again
HIDDEN = ("person", "target")  # what a row of the answer leaves out

Told = tuple[str, Document]  # the kind of an event and its data


@dataclass(frozen=True)
class Wait:
    """A question that is to be asked again after so many seconds."""

    seconds: float
    question: RowQuestion


class Marking:
    """One table on its way: `events` marks it, `result` says what came of it."""

    def __init__(
        self,
        plan: Plan,
        verdict_on: Callable[[RowQuestion], Awaitable[RowVerdict]],
        language: Language,
        longest: float,
        clock: Callable[[], float] = time.monotonic,
        sleep: Callable[[float], Awaitable[object]] = asyncio.sleep,
    ) -> None:
        self._plan = plan
        self._verdict_on = verdict_on
        self._language = language
        self._clock = clock
        self._sleep = sleep
        self._end = clock() + longest
        self._graded: dict[int, Graded] = {}

    async def events(self) -> AsyncIterator[Told]:
        """`begun` with the number of `rows`; `refused` with the `files` that could not be taken; `row` for each when it
        is marked; `waiting` with `seconds` where the service is busy or the client has used its share; `totals` of what
        is done, now and again.

        What is too large, or comes after the time is over, is left undecided; what makes no sense is told in its row.
        """
        yield "begun", {"rows": len(self._plan.rows)}
        if self._plan.refused:
            yield "refused", {"files": self._refused()}
        book, next_totals = Gradebook(self._plan), self._clock()
        for index in self._plan.order:
            row = self._plan.rows[index]
            question = book.question(row)
            found = refusal(row.refused) if question is None else await self._try(question)
            while isinstance(found, Wait):
                yield "waiting", {"seconds": round(found.seconds, 1)}
                await self._sleep(found.seconds)
                found = await self._try(found.question)
            self._graded[index] = book.enter(row, found)
            yield "row", row_document(index, self._graded[index])
            if self._clock() >= next_totals:
                yield "totals", await asyncio.to_thread(self._totals)  # half a second of 20,000 rows
                next_totals = self._clock() + TOTALS_PAUSE + len(self._plan.rows) / 1000

    def result(self) -> Document:
        """Totals and the table of results, once all is marked."""
        found = self._totals()
        return {**found, **self._platforms(found), "csv": self.csv().decode(), "refused": self._refused()}

    def _platforms(self, found: Document) -> Document:
        """The points as course platforms import them; they know assignments only."""
        if self._plan.of is None:
            return {}
        title = self._plan.title or text(self._language, "homework.platforms.title")
        moodle, canvas = moodle_csv(found, title, self._language), canvas_csv(found, self._plan.of, title)
        return {"moodle": moodle.decode(), "canvas": canvas.decode()}

    def _refused(self) -> list[Document]:
        return [asdict(one) for one in self._plan.refused]

    def csv(self) -> bytes:
        """The results as a file, written as the table was."""
        return results_csv(self._in_order(), self._plan.style, dated=self._plan.dated)

    def rows(self) -> list[Document]:
        """The rows in the order of the table."""
        return [row_document(index, graded) for index, graded in sorted(self._graded.items())]

    def _in_order(self) -> list[Graded]:
        return [graded for _, graded in sorted(self._graded.items())]

    def _totals(self) -> Document:
        return totals(self._in_order(), self._plan.of, self._language)

    async def _try(self, question: RowQuestion) -> RowVerdict | Wait:
        """The verdict; or after how many seconds to try again."""
        left = self._end - self._clock()
        try:
            return await self._verdict_on(question) if left > 0.0 else self._undecided(OUT_OF_TIME)
        except (DeadlineExceeded, MemoryExceeded):
            return self._undecided(TOO_LARGE)
        except InputError as error:
            return refusal(" ".join(message(self._language, problem) for problem in error.problems))
        except QuotaExceeded as error:
            wait = Wait(error.seconds, question)
        except Overloaded:
            wait = Wait(BUSY_PAUSE, question)
        return wait if wait.seconds < left else self._undecided(OUT_OF_TIME)

    def _undecided(self, why: Problem) -> RowVerdict:
        """The verdict on an answer that has not been looked at to the end."""
        outcome = text(self._language, "homework.outcomes.undecided")
        return refusal(f"{outcome} {message(self._language, why)}", "undecided")


def row_document(index: int, graded: Graded) -> Document:
    """A marked row as the API tells it."""
    told: dict[str, Any] = {one.name: getattr(graded, one.name) for one in fields(graded) if one.name not in HIDDEN}
    return {"index": index, **told}


async def streamed(marking: Marking, failure: Callable[[Exception], Document]) -> AsyncGenerator[bytes]:
    """The events of a marking, then `result`, or `problem` with a problem document. When the client goes away, what is
    under way is cancelled, and the rest is not begun.
    """
    try:
        async for kind, data in marking.events():
            yield _event(kind, data)
        yield _event("result", await asyncio.to_thread(marking.result))
    except Exception as error:  # noqa: BLE001  the head has been sent, so a failure is an event
        yield _event("problem", failure(error))


def _event(kind: str, data: Document) -> bytes:
    return event(kind, json.dumps(data, ensure_ascii=False).encode(errors="replace"))
