"""Many answers checked one by one: none holds a worker for longer than one may, and between two of them others get it.

Each verdict is cached by itself. So whoever asks again where the service was busy, or time was over, gets further.
"""

from __future__ import annotations

import time
from collections.abc import AsyncIterator, Awaitable, Callable, Sequence
from typing import TypeVar

from ..contract.verdict import VerdictAnswer, VerdictProblem
from ..errors import InputError, Problem
from ..narration.catalog import message, text
from ..vocabulary import Language
from .workers.account import QuotaExceeded
from .workers.job import DeadlineExceeded, MemoryExceeded, Overloaded

Question = TypeVar("Question")

LONGEST = 40.0  # seconds after which no other check is begun
TOO_LARGE, OUT_OF_TIME = Problem("check-too-large"), Problem("batch-out-of-time")


async def checked(
    questions: Sequence[Question],
    check: Callable[[Question], Awaitable[bytes]],
    language: Language,
    clock: Callable[[], float] = time.monotonic,
) -> bytes:
    """The JSON of the verdicts in order; what is too large, or comes after the time is over, is left undecided.

    InputError with the place of a check that makes no sense. Overloaded and QuotaExceeded if not even the first got a
    worker; after that the batch is not refused, its time is over. Other errors of a check are those of the batch.
    """
    verdicts = [verdict async for verdict in _verdicts(questions, check, language, clock)]
    return b'{"verdicts":[%b]}' % b",".join(verdicts)


async def _verdicts(
    questions: Sequence[Question],
    check: Callable[[Question], Awaitable[bytes]],
    language: Language,
    clock: Callable[[], float],
) -> AsyncIterator[bytes]:
    end = clock() + LONGEST
    for number, question in enumerate(questions):
        if clock() >= end:
            yield _undecided(OUT_OF_TIME, language)
            continue
        try:
            yield await check(question)
        except (DeadlineExceeded, MemoryExceeded):
            yield _undecided(TOO_LARGE, language)
        except (Overloaded, QuotaExceeded):
            if number == 0:
                raise
            end = clock()
            yield _undecided(OUT_OF_TIME, language)
        except InputError as error:
            raise type(error)(*(problem.below(f"/checks/{number}") for problem in error.problems)) from None


def _undecided(why: Problem, language: Language) -> bytes:
    """The verdict on an answer that has not been looked at to the end."""
    told = message(language, why)
    verdict = VerdictAnswer(
        outcome="undecided",
        understood_as="",
        feedback=f"{text(language, 'homework.outcomes.undecided')} {told}",
        remark=None,
        misconception=None,
        misconceptions=(),
        slip=None,
        parts=(),
        problems=(VerdictProblem(code=why.code, offset=None, length=None, message=told),),
        offset=None,
        counterexample=None,
    )
    return verdict.model_dump_json().encode()
