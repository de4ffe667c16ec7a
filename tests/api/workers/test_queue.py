"""Who comes next, who has to wait, and for how long."""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Iterable
from threading import Thread

import pytest

from deltaq.api.workers.account import Account
from deltaq.api.workers.job import Job, Overloaded, Pace
from deltaq.api.workers.occupancy import Durations, Slots
from deltaq.api.workers.queue import FairQueue, Place
from deltaq.api.workers.task import Task

MANY = Slots(100, 100)


class Clock:
    """A time that is set."""

    def __init__(self) -> None:
        self.now = 0.0

    def __call__(self) -> float:
        return self.now


def task(name: str, client: str = "", pace: Pace = "fast") -> Task:
    return Task(Job(name, 1.0, pace=pace), b"", account=Account(client), key=name)


def filled(tasks: Iterable[Task], slots: Slots = MANY, length: int = 1000) -> FairQueue:
    queue = FairQueue(length, slots)
    for one in tasks:
        queue.put(one)
    return queue


def taken(queue: FairQueue, count: int) -> list[Task]:
    """So many tasks, each over before the next is taken."""
    found = []
    for _ in range(count):
        one = queue.take()
        assert one is not None
        queue.done(one)
        found.append(one)
    return found


def started(queue: FairQueue) -> list[Task]:
    """All that begin now."""
    return list(iter(queue.take_now, None))


def names(tasks: Iterable[Task]) -> str:
    return " ".join(one.job.target for one in tasks)


@pytest.mark.parametrize(
    ("waiting", "order"),
    [
        pytest.param(["a1", "a2", "a3"], "a1 a2 a3", id="one client: in the order of asking"),
        pytest.param(["a1", "a2", "a3", "b1", "b2"], "a1 b1 a2 b2 a3", id="two clients take turns"),
        pytest.param(["a1", "b1", "c1", "a2", "c2"], "a1 b1 c1 a2 c2", id="three clients"),
    ],
)
def test_clients_take_turns(waiting: list[str], order: str) -> None:
    queue = filled(task(name, name[0]) for name in waiting)
    assert names(taken(queue, len(waiting))) == order
    assert len(queue) == 0


def test_slow_jobs_leave_a_slot_to_fast_ones() -> None:
    queue = filled(
        (task(name, pace="slow" if name < "t" else "fast") for name in ("s1", "s2", "s3", "t1")), Slots(3, 2)
    )
    assert names(started(queue)) == "s1 s2 t1"


def test_nobody_has_all_slots() -> None:
    queue = filled((task(f"g{n}", "greedy", "slow" if n % 2 else "fast") for n in range(8)), Slots(4, 3))
    greedy = started(queue)
    assert names(greedy) == "g0 g1 g2"  # two of the three slots for slow jobs would be free, had it not three of all
    queue.put(task("s", "modest", "slow"))
    assert names(started(queue)) == "s"
    queue.done(greedy[0])
    assert names(started(queue)) == "g3"


def test_nobody_has_all_slots_of_slow_jobs() -> None:
    queue = filled((task(f"g{n}", "greedy", "slow") for n in range(4)), Slots(3, 2))
    assert names(started(queue)) == "g0"
    for name, pace in (("s", "slow"), ("f", "fast")):
        queue.put(task(name, "modest", pace))  # type: ignore[arg-type]
    assert names(started(queue)) == "s f"


def test_who_asks_from_the_machine_itself_may_have_all_slots() -> None:
    queue = filled((task(f"s{n}", "", "slow") for n in range(4)), Slots(3, 2))
    queue.put(task("f"))
    assert names(started(queue)) == "s0 s1 f"


@pytest.mark.parametrize("slots", [Slots(1, 1), Slots(2, 1), Slots(3, 2), Slots(5, 4)], ids=str)
@pytest.mark.parametrize("seed", range(5))
def test_whatever_is_asked_for_slots_are_shared(slots: Slots, seed: int) -> None:
    draw, queue = random.Random(seed), FairQueue(1000, slots)
    running: list[Task] = []
    waiting: list[Task] = []
    overtaken: Counter[Task] = Counter()
    for number in range(300):
        if running and draw.random() < 0.5:
            queue.done(running.pop(draw.randrange(len(running))))
        else:
            client = draw.choice("ggggabc")
            waiting.append(task(str(number), client, "fast" if client != "g" and draw.random() < 0.7 else "slow"))
            queue.put(waiting[-1])
        for one in started(queue):
            waiting.remove(one)
            served = {each.account.client for each in running}
            overtaken.update(each for each in fast_first(waiting) if each.account.client not in served)
            running.append(one)
        assert is_shared(running, slots)
        assert not any(is_kept_waiting(one, running, slots) for one in waiting)
    assert max(overtaken.values(), default=0) <= 4  # once by each client, who may have been before it in turn


def slow_among(tasks: list[Task]) -> list[Task]:
    return [one for one in tasks if one.job.pace == "slow"]


def is_shared(running: list[Task], slots: Slots) -> bool:
    """Where all slots are taken, or all for slow jobs, more than one client has them."""
    groups = ((running, slots.all), (slow_among(running), slots.slow))
    return all(
        len(group) < size or (len(group) == size and (size == 1 or len({one.account.client for one in group}) > 1))
        for group, size in groups
    )


def is_kept_waiting(task: Task, running: list[Task], slots: Slots) -> bool:
    """Whether there is a slot for it though its client has none."""
    if any(one.account.client == task.account.client for one in running) or len(running) == slots.all:
        return False
    return task.job.pace == "fast" or len(slow_among(running)) < slots.slow


def fast_first(waiting: list[Task]) -> list[Task]:
    """The fast tasks that are the first of their clients."""
    firsts = {one.account.client: one for one in reversed(waiting)}
    return [one for one in firsts.values() if one.job.pace == "fast"]


def test_fast_job_that_takes_long_goes_on_where_a_slow_one_has_a_place() -> None:
    queue = filled((task("f", "a"), task("g", "b"), task("s", "b", "slow")), Slots(3, 2))
    f, g, s = started(queue)
    assert names((f, g, s)) == "f g s"
    assert queue.go_on_as_slow(s)  # it is a slow one already
    assert queue.go_on_as_slow(f)
    assert not queue.go_on_as_slow(g)
    queue.done(s)
    assert queue.go_on_as_slow(g)


def test_what_is_put_back_waits_as_a_slow_job_before_its_clients_others() -> None:
    queue = filled((task("s", "a", "slow"), task("f", "b")), Slots(2, 1))
    slow, fast = started(queue)
    for name in ("f2", "f3"):
        queue.put(task(name, "b"))
    assert not queue.go_on_as_slow(fast)
    queue.done(fast)
    queue.put_back(fast)
    assert names(started(queue)) == "f2"  # the slot is not for slow jobs
    queue.done(slow)
    assert names(started(queue)) == ""  # its client has as many slots as it may have
    assert queue.discard(fast)
    assert not queue.discard(fast)


def test_put_back_when_the_service_stops() -> None:
    queue = filled([task("f")])
    (fast,) = started(queue)
    queue.close()
    with pytest.raises(Overloaded, match="stopping"):
        queue.put_back(fast)


def test_full_queue() -> None:
    queue = filled((task("x", client) for client in "ab"), length=2)
    with pytest.raises(Overloaded, match=r"^the queue is full$"):
        queue.put(task("x", "c"))


def test_one_client_holds_half_of_the_places_at_most() -> None:
    queue = filled((task("x", "greedy") for _ in range(3)), length=6)
    with pytest.raises(Overloaded):
        queue.put(task("x", "greedy"))
    queue.put(task("x", "modest"))
    assert len(queue) == 4


def test_task_that_nobody_waits_for_frees_its_place() -> None:
    tasks = [task("x"), task("x"), task("x")]
    queue = filled(tasks, length=3)
    assert queue.discard(tasks[1])
    assert not queue.discard(tasks[1])
    assert [*taken(queue, 2), len(queue)] == [tasks[0], tasks[2], 0]


def test_closing_gives_back_what_waits_and_ends_the_waiting() -> None:
    queue, ends = FairQueue(4, Slots(2, 1)), list[Task | None]()
    queue.put(task("slow", pace="slow"))
    assert queue.take() is not None
    waiting = Thread(target=lambda: ends.append(queue.take()))
    waiting.start()
    queue.put(task("another", pace="slow"))
    assert names(queue.close()) == "another"
    waiting.join(5.0)
    assert ends == [None]
    with pytest.raises(Overloaded):
        queue.put(task("late"))


def test_lane_that_waits_is_told_when_a_place_is_free() -> None:
    queue, got = FairQueue(4, Slots(2, 1)), list[Task | None]()
    queue.put(first := task("first", pace="slow"))
    queue.put(second := task("second", pace="slow"))
    assert queue.take() is first
    waiting = Thread(target=lambda: got.append(queue.take()))
    waiting.start()
    queue.done(first)
    waiting.join(5.0)
    assert got == [second]


def test_last_to_become_idle_is_the_first_to_take() -> None:
    queue, order = FairQueue(4, Slots(3, 3)), list[int]()

    def waiter(number: int) -> None:
        if queue.take() is not None:
            order.append(number)

    threads = [Thread(target=waiter, args=(number,)) for number in range(3)]
    for number, thread in enumerate(threads):
        thread.start()
        while len(queue._idle) <= number:
            pass
    for left in (2, 1, 0):
        queue.put(task("x"))
        threads[left].join(5.0)
    assert order == [2, 1, 0]


def test_place_and_time_of_what_waits() -> None:
    clock = Clock()
    queue = FairQueue(10, Slots(1, 1), clock)
    for _ in range(2):  # two jobs of four seconds, and one of ten
        queue.put(known := task("short", "a"))
        queue.take()
        clock.now += 4.0
        queue.done(known, answered=True)
    queue.put(known := task("long", "a"))
    queue.take()
    clock.now += 10.0
    queue.done(known, answered=True)
    tasks = [task(name, client) for name, client in (("long", "a"), ("short", "a"), ("long", "a"), ("new", "b"))]
    for one in tasks:
        queue.put(one)
    assert queue.take() is tasks[0]
    clock.now += 3.0
    # The client of the one that runs has had its turn, and of what is new nothing is known but the mean of all.
    assert [queue.place_of(one) for one in tasks] == [None, Place(2, 14.0), Place(3, 18.0), Place(1, 7.0)]
    told = []
    for _ in range(4):  # it takes longer and longer, and nobody is told that it is over at any moment
        clock.now += 10.0
        place = queue.place_of(tasks[3])
        assert place is not None
        told.append(place.seconds)
    assert 0.0 < told[0] < told[1] < told[2] < told[3] < 43.0


def test_durations() -> None:
    durations = Durations()
    first = durations.usual("a")
    durations.note("a", 1.0)
    durations.note("b", 3.0)
    assert first > 0.0
    assert [durations.usual(kind) for kind in "abc"] == [1.0, 3.0, 2.0]
    for _ in range(30):
        durations.note("a", 5.0)
    assert durations.usual("a") == pytest.approx(5.0, rel=1e-3)


def test_what_was_given_up_tells_nothing_of_durations() -> None:
    clock = Clock()
    queue = FairQueue(10, Slots(1, 1), clock)
    queue.put(given_up := task("x"))
    queue.take()
    clock.now += 0.1
    before = queue._running.durations.usual("x")
    queue.done(given_up)
    assert queue._running.durations.usual("x") == before


def test_what_two_ask_for_waits_at_the_better_place_and_is_run_once() -> None:
    """Whoever has asked for much before, the other one does not stand behind all of it."""
    draw = random.Random(5)
    for _ in range(50):
        queue = filled(task(f"a{n}", "a") for n in range(20))
        shared = f"a{draw.randrange(2, 20)}"
        before = draw.randrange(3)
        taken(queue, before)
        queue.share(shared, Account("b"))
        queue.share(shared, Account("b"))
        order = taken(queue, 20 - before)
        assert sorted(one.job.target for one in order) == sorted(f"a{n}" for n in range(before, 20))
        place = next(n for n, one in enumerate(order) if one.job.target == shared)
        assert place <= 1
        assert len(queue) == 0


def test_who_has_his_turn_pays_for_what_two_ask_for() -> None:
    queue = filled([task("a0", "a"), task("a1", "a"), task("a2", "a")])
    queue.share("a2", Account("b"))
    assert [(one.job.target, one.account.client) for one in taken(queue, 3)] == [("a0", "a"), ("a2", "b"), ("a1", "a")]


def test_a_place_of_what_two_ask_for_is_free_when_one_of_them_leaves() -> None:
    first, shared = task("a0", "a"), task("a1", "a")
    queue = filled([first, shared])
    queue.share("a1", Account("b"))
    assert (len(queue), queue.place_of(shared)) == (3, Place(2, pytest.approx(0.1)))
    queue.leave("a1", "b")
    queue.leave("a0", "a")  # nobody else waits for it: it goes with its task
    assert (len(queue), names(taken(queue, 2))) == (2, "a0 a1")
    queue = filled([first, shared])
    queue.share("a1", Account("b"))
    assert queue.discard(shared)
    assert (len(queue), names(taken(queue, 1))) == (1, "a0")


def test_what_two_ask_for_takes_no_place_where_there_is_none() -> None:
    queue = filled([task("a0", "a"), task("a1", "a"), task("b0", "b")], length=3)
    with pytest.raises(Overloaded):
        queue.share("a1", Account("c"))
    queue.share("nothing waits for it", Account("c"))
    assert names(taken(queue, 3)) == "a0 b0 a1"
