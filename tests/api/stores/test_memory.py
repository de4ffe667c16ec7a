from __future__ import annotations

from deltaq.api.stores.memory import OVERHEAD, Memory


def test_least_recently_used_answers_go_first() -> None:
    memory = Memory(3 * (100 + OVERHEAD))
    for key in "abc":
        memory.save(key, b"x" * 100)
    memory.load("a")
    memory.save("d", b"x" * 100)
    assert {key for key in "abcd" if memory.load(key)} == {"a", "c", "d"}
    assert memory.used == 3 * (100 + OVERHEAD)


def test_size_is_never_exceeded() -> None:
    memory = Memory(5_000)
    for number in range(200):
        memory.save(str(number), b"x" * (number * 37 % 1000))
        assert memory.used <= memory.size
    left = [memory.load(str(number)) for number in range(200)]
    assert memory.used == sum(len(one) + OVERHEAD for one in left if one is not None)


def test_answer_larger_than_all_the_room_is_not_kept() -> None:
    memory = Memory(1_000)
    memory.save("small", b"answer")
    memory.save("large", b"x" * 2_000)
    assert (memory.load("large"), memory.load("small")) == (None, b"answer")


def test_answer_takes_the_place_of_the_one_before() -> None:
    memory = Memory(1_000)
    for answer in (b"first", b"second"):
        memory.save("k", answer)
    assert (memory.load("k"), memory.used) == (b"second", len(b"second") + OVERHEAD)
    memory.save("k", b"x" * 2_000)
    assert (memory.load("k"), memory.used) == (None, 0)


def test_the_same_answer_counts_once() -> None:
    memory = Memory(10_000)
    for _ in range(2):
        memory.save("k", b"answer")
    assert memory.used == len(b"answer") + OVERHEAD
