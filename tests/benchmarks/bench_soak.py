"""A hundred thousand requests, as students make them but without a thought in between: does the memory stay flat?

Run it from the checkout: `python -m tests.benchmarks.bench_soak [requests] [clients]`. Serves and asks on this machine
only, with a small cache, so that it is full before memory counts; prints answers by status, requests per second, and
how the memory of the web process and of its workers went. Judges nothing.
"""

from __future__ import annotations

import asyncio
import random
import sys
from collections import Counter
from collections.abc import Iterator
from time import monotonic

import httpx
from tests.benchmarks.bench_traffic import HABITS
from tests.benchmarks.memory import MIB, Memory
from tests.serving import PATIENT, Served, served

REQUESTS, CLIENTS = 100_000, 8
LOOK = 5.0  # seconds between two looks at the memory
CACHE = 8 * MIB
TOLD = 5_000  # requests between two lines on how far it is


async def one_client(client: httpx.AsyncClient, numbers: Iterator[int], statuses: Counter[int], memory: Memory) -> None:
    """Asks as long as there are requests left."""
    for number in numbers:
        draw = random.Random(number)
        _, _, make = draw.choices(HABITS, [habit[0] for habit in HABITS])[0]
        method, path, body = make(draw)
        try:
            statuses[(await client.request(method, path, json=body)).status_code] += 1
        except httpx.TransportError:
            statuses[0] += 1
        if statuses.total() % TOLD == 0:
            print(f"{statuses.total()} requests\n{memory}", file=sys.stderr, flush=True)


async def soak(service: Served, requests: int, clients: int) -> None:
    statuses, memory = Counter[int](), Memory(service.process.pid)
    async with httpx.AsyncClient(base_url=service.address.rstrip("/"), timeout=300) as client:
        while (await client.get("/api/v1/ready")).status_code != 200:
            await asyncio.sleep(0.1)
        begin, numbers = monotonic(), iter(range(requests))
        watching = asyncio.create_task(memory.watch(LOOK, statuses.total))
        await asyncio.gather(*(one_client(client, numbers, statuses, memory) for _ in range(clients)))
        watching.cancel()
    memory.look(statuses.total())
    took = monotonic() - begin
    print(f"{statuses.total()} requests in {took:.0f} s, {statuses.total() / took:.0f} in a second")
    print("answers by status:", dict(sorted(statuses.items())))
    print(memory)


def main() -> None:
    given = [int(argument) for argument in sys.argv[1:]]
    requests, clients = (*given, *(REQUESTS, CLIENTS)[len(given) :])
    with served(cache_size=CACHE, **PATIENT) as service:
        asyncio.run(soak(service, requests, clients))


if __name__ == "__main__":
    main()
