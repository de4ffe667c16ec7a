from __future__ import annotations

import asyncio
from typing import Any

import pytest

from deltaq.api.cache import OVERHEAD, Cache, content_hash

pytestmark = pytest.mark.anyio


class Counter:
    """A computation that counts how often it is run."""

    def __init__(self, answer: bytes = b"answer", error: Exception | None = None) -> None:
        self.answer = answer
        self.error = error
        self.runs = 0
        self.may_end = asyncio.Event()
        self.may_end.set()

    async def __call__(self) -> bytes:
        self.runs += 1
        await self.may_end.wait()
        if self.error:
            raise self.error
        return self.answer


async def test_second_question_is_answered_from_memory() -> None:
    cache, compute = Cache(10_000), Counter()
    assert [await cache.get("k", compute) for _ in range(3)] == [b"answer"] * 3
    assert (compute.runs, cache.hits, cache.misses, len(cache)) == (1, 2, 1, 1)
    assert cache.peek("k") == b"answer"
    assert cache.peek("other") is None


async def test_all_who_ask_at_once_share_one_computation() -> None:
    cache, compute = Cache(10_000), Counter()
    compute.may_end.clear()
    asking = [asyncio.create_task(cache.get("k", compute)) for _ in range(300)]
    await asyncio.sleep(0)
    compute.may_end.set()
    assert await asyncio.gather(*asking) == [b"answer"] * 300
    assert compute.runs == 1


async def test_error_reaches_all_who_wait_and_is_not_kept() -> None:
    cache, compute = Cache(10_000), Counter(error=ValueError("no"))
    compute.may_end.clear()
    asking = [asyncio.create_task(cache.get("k", compute)) for _ in range(3)]
    await asyncio.sleep(0)
    compute.may_end.set()
    outcomes = await asyncio.gather(*asking, return_exceptions=True)
    assert [str(outcome) for outcome in outcomes] == ["no"] * 3
    assert (compute.runs, len(cache)) == (1, 0)
    compute.error = None
    assert await cache.get("k", compute) == b"answer"


async def test_others_still_get_the_answer_when_the_first_goes_away() -> None:
    cache, compute = Cache(10_000), Counter()
    compute.may_end.clear()
    first, second = (asyncio.create_task(cache.get("k", compute)) for _ in range(2))
    await asyncio.sleep(0)
    first.cancel()
    await asyncio.sleep(0)
    compute.may_end.set()
    assert await second == b"answer"
    assert compute.runs == 1


async def test_least_recently_used_answers_go_first() -> None:
    cache = Cache(3 * (100 + OVERHEAD))
    for key in "abc":
        await cache.get(key, Counter(b"x" * 100))
    await cache.get("a", Counter())
    await cache.get("d", Counter(b"x" * 100))
    assert {key for key in "abcd" if cache.peek(key)} == {"a", "c", "d"}
    assert cache.used == 3 * (100 + OVERHEAD)


async def test_size_is_never_exceeded() -> None:
    cache = Cache(5_000)
    for number in range(200):
        await cache.get(str(number), Counter(b"x" * (number * 37 % 1000)))
        assert cache.used <= cache.size
    assert cache.used == sum(
        len(cache.peek(str(n)) or b"") + OVERHEAD for n in range(200) if cache.peek(str(n)) is not None
    )


async def test_answer_larger_than_the_cache_is_given_but_not_kept() -> None:
    cache = Cache(1_000)
    await cache.get("small", Counter())
    assert await cache.get("large", Counter(b"x" * 2_000)) == b"x" * 2_000
    assert cache.peek("large") is None
    assert cache.peek("small") == b"answer"


@pytest.mark.parametrize(
    ("one", "other", "same"),
    [
        pytest.param({"a": 1, "b": 2}, {"b": 2, "a": 1}, True, id="order of members"),
        pytest.param([1, 2], [2, 1], False, id="order of elements"),
        pytest.param({"a": 1}, {"a": "1"}, False, id="number and text"),
        pytest.param(1, True, False, id="number and truth"),
        pytest.param("é", "e\u0301", False, id="Unicode forms"),
    ],
)
async def test_content_hash(one: Any, other: Any, same: bool) -> None:
    assert (content_hash(one) == content_hash(other)) is same


async def test_content_hash_separates_its_parts() -> None:
    assert content_hash("a", "b") != content_hash("ab")
