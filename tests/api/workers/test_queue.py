"""Who comes next."""

from __future__ import annotations

from threading import Thread

import pytest

from deltaq.api.workers.account import Account
from deltaq.api.workers.job import Job, Overloaded, Pace
from deltaq.api.workers.queue import FairQueue
from deltaq.api.workers.task import Task

ANY: tuple[Pace, ...] = ("fast", "slow")


def task(name: str, client: str = "", pace: Pace = "fast") -> Task:
    return Task(Job(name, 1.0, pace=pace), b"", account=Account(client))


def taken(queue: FairQueue, count: int, *paces: Pace) -> str:
    tasks = (queue.take(paces or ANY) for _ in range(count))
    return " ".join(one.job.target for one in tasks if one)


@pytest.mark.parametrize(
    ("waiting", "order"),
    [
        pytest.param(["a1", "a2", "a3"], "a1 a2 a3", id="one client: in the order of asking"),
        pytest.param(["a1", "a2", "a3", "b1", "b2"], "a1 b1 a2 b2 a3", id="two clients take turns"),
        pytest.param(["a1", "b1", "c1", "a2", "c2"], "a1 b1 c1 a2 c2", id="three clients"),
    ],
)
def test_clients_take_turns(waiting: list[str], order: str) -> None:
    queue = FairQueue(10)
    for name in waiting:
        queue.put(task(name, name[0]))
    assert taken(queue, len(waiting)) == order
    assert len(queue) == 0


def test_slow_jobs_do_not_keep_fast_ones_waiting() -> None:
    queue = FairQueue(10)
    for name, pace in (("s1", "slow"), ("s2", "slow"), ("f1", "fast"), ("s3", "slow"), ("f2", "fast")):
        queue.put(task(name, pace=pace))  # type: ignore[arg-type]
    assert taken(queue, 2, "fast") == "f1 f2"
    assert taken(queue, 3) == "s1 s2 s3"


def test_client_with_slow_jobs_alone_is_passed_over() -> None:
    queue = FairQueue(10)
    queue.put(task("s1", "patient", "slow"))
    queue.put(task("f1", "hasty"))
    assert taken(queue, 1, "fast") == "f1"
    assert taken(queue, 1) == "s1"


def test_full_queue() -> None:
    queue = FairQueue(2)
    for client in "ab":
        queue.put(task("x", client))
    with pytest.raises(Overloaded, match=r"^the queue is full$"):
        queue.put(task("x", "c"))


def test_one_client_holds_half_of_the_places_at_most() -> None:
    queue = FairQueue(6)
    for _ in range(3):
        queue.put(task("x", "greedy"))
    with pytest.raises(Overloaded):
        queue.put(task("x", "greedy"))
    queue.put(task("x", "modest"))
    assert len(queue) == 4


def test_task_that_nobody_waits_for_frees_its_place() -> None:
    queue = FairQueue(3)
    tasks = [task("x"), task("x"), task("x")]
    for one in tasks:
        queue.put(one)
    queue.discard(tasks[1])
    queue.discard(tasks[1])
    assert [queue.take(ANY), queue.take(ANY), len(queue)] == [tasks[0], tasks[2], 0]


def test_closing_gives_back_what_waits_and_ends_the_waiting() -> None:
    queue, ends = FairQueue(4), list[Task | None]()
    waiting = Thread(target=lambda: ends.append(queue.take(("fast",))))
    waiting.start()
    queue.put(task("slow", pace="slow"))
    assert [one.job.target for one in queue.close()] == ["slow"]
    waiting.join(5.0)
    assert ends == [None]
    with pytest.raises(Overloaded):
        queue.put(task("late"))


def test_takers_wait_for_their_pace() -> None:
    queue, got = FairQueue(4), list[Task | None]()
    waiting = Thread(target=lambda: got.append(queue.take(("fast",))))
    waiting.start()
    queue.put(task("slow", pace="slow"))
    queue.put(fast := task("fast"))
    waiting.join(5.0)
    assert got == [fast]
    assert len(queue) == 1
