"""Beside a client with the worst jobs that are legal: how long others wait; and a class that runs thirty experiments.

Run it from the checkout: `python -m tests.benchmarks.bench_fairness [greedy | class]`, both if neither is named. Serves
and asks on this machine only; clients are told apart by the address that a trusted proxy on loopback forwards. Prints;
judges nothing.
"""

from __future__ import annotations

import asyncio
import itertools
import json
import os
import sys
from collections import Counter
from collections.abc import Callable, Coroutine, Iterator
from dataclasses import dataclass, field
from time import perf_counter
from typing import Any

import httpx
import numpy as np
from tests.serving import Served, served

SECONDS = 60.0  # for which the greedy client goes on
BEFORE = 5.0  # seconds that it is alone
OTHERS, THINKING = 4, 0.5  # clients beside it, and seconds between two requests of each
CLASS = 30
LINKS = 12  # the longest chain there is
Question = tuple[str, dict[str, Any]]
EXPERIMENTS: tuple[tuple[str, dict[str, Any]], ...] = (
    ("work-precision", {}),
    ("convergence", {}),
    ("energy-drift", {"steps": 20_000}),
    ("stability", {}),
    ("chaos", {}),
    ("fidelity", {}),
)
SCENES = ("double-pendulum", "elastic-pendulum", "cart-pendulum", "pendulum", "guided-pendulum")


def chain(number: int) -> dict[str, Any]:
    """The longest chain, with a value that nobody asked for before."""
    return {"scene": "chain-pendulum", "parameters": {"n": LINKS, "g": 9.0 + 1e-4 * number}}


def check(number: int, line: int) -> dict[str, Any]:
    """A wrong answer of its own to a long task."""
    wrong = f"{line + 2}*m*l^2*ddot(phi{1 + line % LINKS}) + m*g*l*sin(phi1) = {line}"
    return {**chain(number), "task": f"equation:phi{1 + line % LINKS}", "answer": {"value": wrong}}


def greed(number: int) -> Iterator[Question]:
    """The worst that one may ask for, none of it known already."""
    checks = [check(number, line) for line in range(64)]
    lines = [{"task": one["task"], "answer": one["answer"]} for one in checks[:24]]
    yield "checks/batch", {"checks": checks}
    yield "derivations", chain(number)
    yield "simulations", {**chain(number), "t_end": 1000.0, "tolerance": 1e-12}
    yield "checks/lines", {**chain(number), "lines": lines}
    yield "tasks/stack", chain(number)
    yield "exports/latex", chain(number)
    yield "experiments/chaos", {"scene": "double-pendulum", "t_end": 20.0 + 1e-3 * number, "map": True}


def as_seen_in_a_lecture(number: int) -> Iterator[Question]:
    """Two batches and two derivations of the longest chain."""
    for each in range(2):
        yield "checks/batch", {"checks": [check(2 * number + each, line) for line in range(64)]}
        yield "derivations", chain(2 * number + each)


@dataclass
class Told:
    """Seconds of every request by what it was, and how each ended."""

    seconds: dict[str, list[float]] = field(default_factory=dict)
    statuses: dict[str, Counter[int]] = field(default_factory=dict)
    refused: list[float] = field(default_factory=list)  # seconds until a 503

    def add(self, kind: str, status: int, seconds: float) -> None:
        self.seconds.setdefault(kind, []).append(seconds)
        self.statuses.setdefault(kind, Counter())[status] += 1
        if status == httpx.codes.SERVICE_UNAVAILABLE:
            self.refused.append(seconds)

    def __str__(self) -> str:
        lines = []
        for kind, found in sorted(self.seconds.items()):
            p50, p99 = np.percentile(found, (50, 99))
            ends = dict(sorted(self.statuses[kind].items()))
            lines.append(f"{kind:34} p50 {p50:7.3f} s   p99 {p99:7.3f} s   most {max(found):7.3f} s   {ends}")
        late = f"latest refusal after {max(self.refused):.1f} s" if self.refused else "nothing refused"
        return "\n".join((*lines, late))


def client_at(service: Served, address: str) -> httpx.AsyncClient:
    """A client that comes from an address."""
    headers, limits = {"X-Forwarded-For": address}, httpx.Limits(max_connections=None)
    return httpx.AsyncClient(base_url=service.address, headers=headers, timeout=900, limits=limits)


async def asked(
    client: httpx.AsyncClient, told: Told, kind: str, path: str, body: dict[str, Any] | None = None
) -> None:
    """One request and what became of it."""
    begin = perf_counter()
    response = await (client.get(path) if body is None else client.post(path, json=body))
    told.add(kind, response.status_code, perf_counter() - begin)


async def greedy(service: Served, told: Told, wanted: Callable[[int], Iterator[Question]]) -> None:
    """A client that asks for all it can think of at once, and again as soon as one is answered."""

    async def again_and_again(which: int, client: httpx.AsyncClient) -> None:
        for number in itertools.count(which, 1000):
            path, body = list(wanted(number))[which]
            await asked(client, told, f"greedy {path}", f"api/v1/{path}", body)
            await asyncio.sleep(0.2)

    async with client_at(service, "203.0.113.1") as client:
        await asyncio.gather(*(again_and_again(which, client) for which in range(len(list(wanted(0))))))


def wishes(g: float) -> Iterator[tuple[str, str, dict[str, Any] | None]]:
    """What another client wants; what is computed, with a value that nobody asked for before."""
    pendulum = {"scene": "pendulum", "parameters": {"g": g}}
    yield "other reads version", "api/v1/version", None
    yield "other reads scene", "api/v1/scenes/pendulum", None
    yield "other reads page", "", None
    yield "other simulates pendulum", "api/v1/simulations", pendulum | {"t_end": 10.0}
    yield "other derives pendulum", "api/v1/derivations", pendulum


async def other(service: Served, told: Told, which: int) -> None:
    """A client that reads, and looks at motions of a pendulum, each with a value of its own."""
    async with client_at(service, f"198.51.100.{which}") as client:
        for number in itertools.count():
            for kind, path, body in wishes(9.0 + 1e-2 * which + 1e-4 * number):
                await asked(client, told, kind, path, body)
            await asyncio.sleep(THINKING)


async def until(seconds: float, *endless: Coroutine[Any, Any, None]) -> None:
    """Let them go on for so long."""
    running = [asyncio.ensure_future(one) for one in endless]
    done, _ = await asyncio.wait(running, timeout=seconds, return_when=asyncio.FIRST_EXCEPTION)
    for one in running:
        one.cancel()
    await asyncio.gather(*(one for one in running if one not in done), return_exceptions=True)
    for one in done:
        one.result()


async def beside_a_greedy_client(service: Served, wanted: Callable[[int], Iterator[Question]]) -> None:
    """What it takes others, before there is a client that asks for the worst, and beside it."""
    greed, before, beside = Told(), Told(), Told()
    await until(SECONDS / 3, *others(service, before, 1))
    begun = asyncio.ensure_future(greedy(service, greed, wanted))
    await asyncio.sleep(BEFORE)
    await until(SECONDS, *others(service, beside, 1 + OTHERS))
    begun.cancel()
    await asyncio.gather(begun, return_exceptions=True)
    print(f"\nwithout a greedy client\n{before}")
    print(f"beside one: {wanted.__name__}, load of the machine {os.getloadavg()[0]:.1f}\n{greed}\n{beside}", flush=True)


def others(service: Served, told: Told, first: int) -> Iterator[Coroutine[Any, Any, None]]:
    """Some other clients, numbered from the first."""
    return (other(service, told, first + each) for each in range(OTHERS))


@dataclass
class Watched:
    """An experiment as its stream told it: how it ended, seconds, and each time what was said of the waiting."""

    end: str
    seconds: float
    began: float
    places: list[tuple[float, dict[str, Any]]]

    def __str__(self) -> str:
        told = "".join(f"place {place['place']}, {place['seconds']:.0f} s" for _, place in self.places[:1])
        return f"{self.end:8} begun after {self.began:6.1f} s, over after {self.seconds:6.1f} s; told first: {told}"


async def watched(service: Served, student: int) -> Watched:
    """One experiment, watched from an address of its own."""
    name, more = EXPERIMENTS[student % len(EXPERIMENTS)]
    question = {"scene": SCENES[student % len(SCENES)], "parameters": {"g": 9.5 + 1e-3 * student}, "t_end": 5.0, **more}
    places: list[tuple[float, dict[str, Any]]] = []
    begin, began, kind = perf_counter(), 0.0, ""
    headers = {"Accept": "text/event-stream"}
    async with (
        client_at(service, f"192.0.2.{1 + student}") as client,
        client.stream("POST", f"api/v1/experiments/{name}", json=question, headers=headers) as response,
    ):
        async for line in response.aiter_lines():
            field, _, value = line.partition(": ")
            now = perf_counter() - begin
            if field == "event":
                kind = value
            elif field == "data" and kind == "waiting":
                places.append((now, json.loads(value)))
            elif field == "data" and kind == "part":
                began = began or now
            elif field == "data" and kind == "problem":
                print(value[:200])
    return Watched(kind, perf_counter() - begin, began, places)


async def experiments_of_a_class(service: Served) -> None:
    """All begin theirs at the same moment."""
    found = await asyncio.gather(*(watched(service, student) for student in range(CLASS)))
    for one in sorted(found, key=lambda one: one.seconds):
        print(one)
    ends = Counter(one.end for one in found)
    print(f"\na class of {CLASS} experiments: {dict(ends)}, the last after {max(one.seconds for one in found):.0f} s")


async def ready(service: Served) -> None:
    """Until it computes."""
    async with client_at(service, "192.0.2.254") as client:
        while (await client.get("api/v1/ready")).status_code != httpx.codes.OK:
            await asyncio.sleep(0.2)
        small = {"scene": "pendulum", "t_end": 1.0}  # waits until all kernels are compiled
        while (await client.post("api/v1/experiments/convergence", json=small)).status_code != httpx.codes.OK:
            await asyncio.sleep(1.0)


def main() -> None:
    wanted = set(sys.argv[1:]) or {"greedy", "class"}
    with served(trusted_proxies="127.0.0.1") as service:
        asyncio.run(ready(service))
        if "class" in wanted:
            asyncio.run(experiments_of_a_class(service))
    for kind in (as_seen_in_a_lecture, greed) if "greedy" in wanted else ():
        with served(trusted_proxies="127.0.0.1") as service:
            asyncio.run(ready(service))
            asyncio.run(beside_a_greedy_client(service, kind))


if __name__ == "__main__":
    main()
