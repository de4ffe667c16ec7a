from __future__ import annotations

import asyncio
from typing import Any

import pytest

from deltaq.api import flights
from deltaq.api.cache import Cache, content_hash
from deltaq.api.flights import OnUpdate, Update
from deltaq.api.stores.memory import Memory

pytestmark = pytest.mark.anyio


class Counter:
    """A computation that counts how often it is run."""

    def __init__(self, answer: bytes = b"answer", error: Exception | None = None) -> None:
        self.answer = answer
        self.error = error
        self.runs = 0
        self.may_end = asyncio.Event()
        self.may_end.set()

    async def __call__(self, tell: OnUpdate) -> bytes:
        self.runs += 1
        tell(Update("part", f"part of {self.runs}".encode()))
        await self.may_end.wait()
        if self.error:
            raise self.error
        return self.answer


async def test_second_question_is_answered_from_memory() -> None:
    cache, compute = Cache(Memory(10_000)), Counter()
    assert [await cache.get("k", compute) for _ in range(3)] == [b"answer"] * 3
    assert (compute.runs, cache.hits, cache.misses, len(cache.memory)) == (1, {"memory": 2}, 1, 1)
    assert await cache.find("k") == b"answer"
    assert await cache.find("other") is None


async def test_all_who_ask_at_once_share_one_computation() -> None:
    cache, compute = Cache(Memory(10_000)), Counter()
    compute.may_end.clear()
    asking = [asyncio.create_task(cache.get("k", compute)) for _ in range(300)]
    await asyncio.sleep(0)
    compute.may_end.set()
    assert await asyncio.gather(*asking) == [b"answer"] * 300
    assert compute.runs == 1


async def test_error_reaches_all_who_wait_and_is_not_kept() -> None:
    cache, compute = Cache(Memory(10_000)), Counter(error=ValueError("no"))
    compute.may_end.clear()
    asking = [asyncio.create_task(cache.get("k", compute)) for _ in range(3)]
    await asyncio.sleep(0)
    compute.may_end.set()
    outcomes = await asyncio.gather(*asking, return_exceptions=True)
    assert [str(outcome) for outcome in outcomes] == ["no"] * 3
    assert (compute.runs, len(cache.memory)) == (1, 0)
    compute.error = None
    assert await cache.get("k", compute) == b"answer"


async def test_others_still_get_the_answer_when_the_first_goes_away() -> None:
    cache, compute = Cache(Memory(10_000)), Counter()
    compute.may_end.clear()
    first, second = (asyncio.create_task(cache.get("k", compute)) for _ in range(2))
    await asyncio.sleep(0)
    first.cancel()
    await asyncio.sleep(0)
    compute.may_end.set()
    assert await second == b"answer"
    assert compute.runs == 1


async def test_computation_ends_when_nobody_waits_any_more(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(flights, "GRACE", 0.01)
    cache, compute = Cache(Memory(10_000)), Counter()
    compute.may_end.clear()
    asking = [asyncio.create_task(cache.get("k", compute)) for _ in range(2)]
    await asyncio.sleep(0)
    for one in asking:
        one.cancel()
    await asyncio.sleep(0.05)
    compute.may_end.set()
    again = Counter(b"again")
    assert await cache.get("k", again) == b"again"
    assert (compute.runs, again.runs) == (1, 1)


async def test_who_asks_while_a_computation_is_given_up_gets_another(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(flights, "GRACE", 0.0)
    cache, again, ended = Cache(Memory(10_000)), Counter(b"again"), asyncio.Event()

    async def slow_to_end(_tell: OnUpdate) -> bytes:
        try:
            await asyncio.Event().wait()
        finally:
            ended.set()
            await asyncio.sleep(0.02)
        return b"never"

    gone = asyncio.create_task(cache.get("k", slow_to_end))
    await asyncio.sleep(0)
    gone.cancel()
    await ended.wait()
    again.may_end.clear()
    asking = asyncio.create_task(cache.get("k", again))
    await asyncio.sleep(0.05)  # the end of the first is no end of the second
    late = asyncio.create_task(cache.get("k", again))
    await asyncio.sleep(0)
    again.may_end.set()
    assert await asyncio.gather(asking, late) == [b"again", b"again"]
    assert again.runs == 1


async def test_who_asks_again_at_once_gets_the_computation_under_way(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(flights, "GRACE", 0.05)
    cache, compute = Cache(Memory(10_000)), Counter()
    compute.may_end.clear()
    reloaded = asyncio.create_task(cache.get("k", compute))
    await asyncio.sleep(0)
    reloaded.cancel()
    await asyncio.sleep(0)
    again = asyncio.create_task(cache.get("k", compute))
    await asyncio.sleep(0.1)
    compute.may_end.set()
    assert await again == b"answer"
    assert compute.runs == 1


async def test_all_who_wait_hear_the_parts_and_who_comes_late_hears_the_newest() -> None:
    cache = Cache(Memory(10_000))
    may_go_on = [asyncio.Event() for _ in range(3)]

    async def compute(tell: OnUpdate) -> bytes:
        for number, event in enumerate(may_go_on):
            tell(Update("part", b"%d" % number))
            await event.wait()
        return b"answer"

    heard: list[list[Update]] = [[], [], []]
    early = asyncio.create_task(cache.get("k", compute, heard[0].append))
    await asyncio.sleep(0.01)
    may_go_on[0].set()
    await asyncio.sleep(0.01)
    late = asyncio.create_task(cache.get("k", compute, heard[1].append))
    gone = asyncio.create_task(cache.get("k", compute, heard[2].append))
    await asyncio.sleep(0.01)
    gone.cancel()
    await asyncio.sleep(0.01)
    for event in may_go_on:
        event.set()
    assert await asyncio.gather(early, late) == [b"answer"] * 2
    assert [[update.data for update in each] for each in heard] == [[b"0", b"1", b"2"], [b"1", b"2"], [b"1"]]


async def test_renewed_answer_takes_the_place_of_the_kept_one() -> None:
    store = Slow(10_000)
    cache, old, new = Cache(Memory(10_000), store), Counter(b"old"), Counter(b"new")
    await cache.get("k", old)
    assert await cache.renew("k", new) == b"new"
    assert [await cache.get("k", old), store.load("k"), old.runs, new.runs] == [b"new", b"new", 1, 1]


async def test_one_under_way_is_new_enough() -> None:
    cache, compute = Cache(Memory(10_000)), Counter()
    compute.may_end.clear()
    asking = [asyncio.create_task(ask("k", compute)) for ask in (cache.get, cache.renew, cache.renew)]
    await asyncio.sleep(0.01)
    compute.may_end.set()
    assert await asyncio.gather(*asking) == [b"answer"] * 3
    assert compute.runs == 1


class Slow(Memory):
    """A store behind the memory."""

    name = "slow"


async def test_answer_is_found_in_a_store_behind() -> None:
    store = Slow(10_000)
    first, second = Cache(Memory(10_000), store), Cache(Memory(10_000), store)
    compute = Counter()
    await first.get("k", compute)
    assert [await second.get("k", compute) for _ in range(3)] == [b"answer"] * 3
    assert (compute.runs, second.hits, second.misses) == (1, {"memory": 2, "slow": 1}, 0)


async def test_stores_behind_are_asked_for_what_is_found_by_name() -> None:
    store = Slow(10_000)
    store.save("k", b"answer")
    cache = Cache(Memory(10_000), store)
    assert await cache.find("k") == b"answer"
    assert cache.memory.load("k") == b"answer"


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
