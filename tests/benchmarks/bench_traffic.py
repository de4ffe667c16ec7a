"""A lecture's worth of students at once: pages, derivations, sliders, answers checked, and some nonsense.

Run it from the checkout: `python -m tests.benchmarks.bench_traffic [seconds] [students]`. Each student does something,
thinks for some seconds, and does the next. Serves and asks on this machine only; prints latencies by kind, answers by
status, what the cache did, and how the memory of the web process and of its workers went. Judges nothing.
"""

from __future__ import annotations

import asyncio
import random
import sys
from collections import Counter, defaultdict
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import chain
from time import monotonic, perf_counter
from typing import Any

import httpx
import numpy as np
from tests.benchmarks.memory import MIB, Memory
from tests.serving import Served, served

SECONDS, STUDENTS, THINKING = 60.0, 300, (2.0, 10.0)
SCENES = ("pendulum", "elastic-pendulum", "double-pendulum", "cart-pendulum", "guided-pendulum", "spherical-pendulum")
LANGUAGES = ("de", "en")
LOOK = 2.0  # seconds between two looks at the memory
Draw = Callable[[random.Random], tuple[str, str, Any]]


def post(path: str, body: dict[str, Any]) -> tuple[str, str, Any]:
    return "POST", f"/api/v1/{path}", body


def check(draw: random.Random) -> tuple[str, str, Any]:
    value = draw.choice(("m*l^2*ddot(phi) + m*g*l*sin(phi) = 0", "l*ddot(phi) = g*sin(phi)", "phi = 0"))
    return post("checks", {"scene": "pendulum", "task": "equation:phi", "answer": {"value": value}})


def own_variation(draw: random.Random) -> tuple[str, str, Any]:
    return post("variations", {"expression": f"{draw.randrange(500)}*cos(x)*dot(x)^2", "functions": ["x"]})


def slider(draw: random.Random) -> tuple[str, str, Any]:
    parameters = {"g": round(draw.uniform(1.0, 20.0), 2)}
    return post("simulations", {"scene": draw.choice(SCENES), "parameters": parameters, "t_end": 10.0, "samples": 301})


# What is done how often.
HABITS: tuple[tuple[int, str, Draw], ...] = (
    (2, "page", lambda _: ("GET", "/", None)),
    (2, "scene", lambda draw: ("GET", f"/api/v1/scenes/{draw.choice(SCENES)}", None)),
    (
        4,
        "derivation",
        lambda draw: post("derivations", {"scene": draw.choice(SCENES), "lang": draw.choice(["de", "en"])}),
    ),
    (8, "simulation, own value", slider),
    (2, "variation, own", own_variation),
    (3, "check", check),
    (1, "nonsense", lambda _: post("derivations", {"scene": {"format": 1, "coordinates": "10^10^10"}})),
)


@dataclass
class Record:
    """What came of all requests."""

    seconds: dict[str, list[float]] = field(default_factory=lambda: defaultdict(list))
    statuses: Counter[int] = field(default_factory=Counter)


async def study(client: httpx.AsyncClient, draw: random.Random, end: float, record: Record) -> None:
    """One student."""
    await asyncio.sleep(draw.uniform(0.0, THINKING[1]))
    while monotonic() < end:
        _, kind, make = draw.choices(HABITS, [habit[0] for habit in HABITS])[0]
        method, path, body = make(draw)
        start = perf_counter()
        try:
            status = (await client.request(method, path, json=body)).status_code
        except httpx.TransportError:
            status = 0
        record.seconds[kind].append(perf_counter() - start)
        record.statuses[status] += 1
        await asyncio.sleep(draw.uniform(*THINKING))


async def lecture(service: Served, seconds: float, students: int) -> None:
    address = service.address.rstrip("/")
    limits = httpx.Limits(max_connections=students, max_keepalive_connections=students)
    async with httpx.AsyncClient(base_url=address, timeout=60, limits=limits) as client:
        while (await client.get("/api/v1/ready")).status_code != 200:
            await asyncio.sleep(0.1)
        record, memory, end = Record(), Memory(service.process.pid), monotonic() + seconds
        watching = asyncio.create_task(memory.watch(LOOK, record.statuses.total))
        await asyncio.gather(*(study(client, random.Random(n), end, record) for n in range(students)))
        watching.cancel()
        cache = (await client.get("/api/v1/health")).json()["cache"]
    for kind, found in (*sorted(record.seconds.items()), ("all", list(chain(*record.seconds.values())))):
        p50, p95, p99 = 1000 * np.percentile(found, (50, 95, 99))
        print(f"{kind:24} {len(found):6}   p50 {p50:6.0f} ms   p95 {p95:6.0f} ms   p99 {p99:6.0f} ms")
    print("answers by status:", dict(sorted(record.statuses.items())))
    print(memory)
    print(f"answers kept {cache['bytes'] / MIB:.1f} MiB;", cache)


def main() -> None:
    given = [float(argument) for argument in sys.argv[1:]]
    seconds, students = (*given, *(SECONDS, STUDENTS)[len(given) :])
    with served() as service:
        asyncio.run(lecture(service, seconds, int(students)))


if __name__ == "__main__":
    main()
