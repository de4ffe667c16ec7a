"""Many answers checked one by one: bounded each, and others in between."""

from __future__ import annotations

import json
from collections.abc import Awaitable, Callable
from typing import Any

import pytest

from deltaq.api.batches import LONGEST, checked
from deltaq.api.workers.account import QuotaExceeded
from deltaq.api.workers.job import DeadlineExceeded, JobFailed, MemoryExceeded, Overloaded
from deltaq.errors import Problem, UnknownNameError

pytestmark = pytest.mark.anyio


class Clock:
    """A time that is set."""

    def __init__(self) -> None:
        self.now = 0.0

    def __call__(self) -> float:
        return self.now


def checking(fails: dict[int, Exception], clock: Clock, seconds: float = 1.0) -> Callable[[int], Awaitable[bytes]]:
    """A checker that takes some time, and fails at some numbers."""

    async def check(number: int) -> bytes:
        clock.now += seconds
        if number in fails:
            raise fails[number]
        return json.dumps({"outcome": "correct", "number": number}).encode()

    return check


async def codes(fails: dict[int, Exception], count: int = 4, seconds: float = 1.0) -> list[Any]:
    """Of each verdict its number, or the code that says why there is none."""
    clock = Clock()
    answer = json.loads(await checked(range(count), checking(fails, clock, seconds), "en", clock))
    found = []
    for verdict in answer["verdicts"]:
        if verdict["outcome"] == "undecided":
            assert verdict["problems"][0]["message"] in verdict["feedback"]
        found.append(verdict["problems"][0]["code"] if "problems" in verdict else verdict["number"])
    return found


@pytest.mark.parametrize("error", [DeadlineExceeded("no answer"), MemoryExceeded("")], ids=["time", "memory"])
async def test_a_check_that_is_too_large_spoils_no_other(error: Exception) -> None:
    assert await codes({1: error}) == [0, "check-too-large", 2, 3]


async def test_what_comes_after_the_time_is_over_is_left_undecided() -> None:
    found = await codes({}, count=10, seconds=LONGEST / 4)
    assert found == [0, 1, 2, 3, *["batch-out-of-time"] * 6]


@pytest.mark.parametrize("error", [Overloaded("waited too long"), QuotaExceeded("x", 3.0)], ids=["busy", "quota"])
async def test_a_batch_is_refused_at_its_beginning_alone(error: Exception) -> None:
    assert await codes({2: error}) == [0, 1, "batch-out-of-time", "batch-out-of-time"]
    with pytest.raises(type(error)):
        await codes({0: error})


async def test_our_own_mistake_is_not_a_verdict() -> None:
    with pytest.raises(JobFailed):
        await codes({1: JobFailed("bug")})


async def test_a_check_that_makes_no_sense_is_pointed_at() -> None:
    with pytest.raises(UnknownNameError) as caught:
        await codes({2: UnknownNameError(Problem("unknown-task", "/task"))})
    assert [problem.pointer for problem in caught.value.problems] == ["/checks/2/task"]
