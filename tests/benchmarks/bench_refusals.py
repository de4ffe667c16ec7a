"""How a service refuses the worst bodies that can be sent to it, and what that costs those who ask for something else.

Run it from the checkout: `python -m tests.benchmarks.bench_refusals [share] [count]`. Sends all bodies of
`tests.api.worst_bodies`, or so great a share of them, one after the other, to a service on this machine; then 5,000
requests of `tests.api.extreme_numbers`, or so many, four at a time. Beside them another client reads its version all
the time. Prints; judges nothing.
"""

from __future__ import annotations

import asyncio
import os
import random
import sys
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from multiprocessing import get_context
from multiprocessing.connection import Connection
from time import perf_counter

import httpx
import numpy as np
from tests.api.extreme_numbers import QUICK, Request, is_wrong, requests
from tests.api.worst_bodies import Worst, worst_bodies
from tests.benchmarks.memory import resident
from tests.serving import Served, served

from deltaq.api.workers.meter import Clock, processor_clock

PAUSE = 0.005  # seconds between two readings
AT_ONCE = 4  # extreme requests
LISTED = 12  # of the slowest and of the largest


@dataclass
class Tally:
    """What came of all bodies, and what the other client saw meanwhile."""

    statuses: Counter[int] = field(default_factory=Counter)
    seconds: list[tuple[float, str]] = field(default_factory=list)
    sizes: list[tuple[int, str]] = field(default_factory=list)
    readings: list[float] = field(default_factory=list)
    quiet: list[float] = field(default_factory=list)
    processor: list[float] = field(default_factory=list)
    memory: list[float] = field(default_factory=list)
    bad: list[str] = field(default_factory=list)

    def __str__(self) -> str:
        refusals, readings = [1e3 * s for s, _ in self.seconds], [1e3 * s for s in self.readings]
        slow = [f"  {1e3 * seconds:7.1f} ms  {name}" for seconds, name in sorted(self.seconds)[-LISTED:]]
        large = [f"  {size / 1e3:7.1f} kB  {name}" for size, name in sorted(self.sizes)[-LISTED:]]
        return "\n".join(
            [
                f"{len(refusals)} requests: {dict(sorted(self.statuses.items()))}",
                f"answered within {told(refusals)}",
                f"refused (4xx) within {told([1e3 * s for s, name in self.seconds if name.startswith('4')])}",
                *slow,
                f"largest answers: {max(self.sizes)[0] / 1e3:.1f} kB",
                *large,
                *([f"processor time of the web process for each {told(self.processor)}"] if self.processor else ()),
                *([f"another's reading before {told([1e3 * s for s in self.quiet])}"] if self.quiet else ()),
                f"another's reading, {len(readings)} times: {told(readings)}",
                f"memory of the web process {self.memory[0]:.0f} MiB, at most {max(self.memory) - self.memory[0]:+.0f}",
                *(f"WRONG {one}" for one in self.bad),
            ]
        )


def told(milliseconds: list[float]) -> str:
    """Half, 99 in a hundred and all of them."""
    p50, p99 = np.percentile(milliseconds, (50, 99))
    return f"p50 {p50:.1f} ms, p99 {p99:.1f} ms, most {max(milliseconds):.1f} ms"


async def send(client: httpx.AsyncClient, worst: Worst, clock: Clock, tally: Tally) -> None:
    """Send one body."""
    content = worst.make()
    begin, used = perf_counter(), clock()
    try:
        answer = await client.post(worst.path, content=content, headers={"Content-Type": worst.media_type})
    except httpx.HTTPError as error:
        tally.bad.append(f"{worst}: {error!r}")
        return
    tally.statuses[answer.status_code] += 1
    tally.processor.append(1e3 * (clock() - used))
    tally.seconds.append((perf_counter() - begin, f"{answer.status_code} {worst}"))
    tally.sizes.append((len(answer.content), f"{answer.status_code} {worst}"))
    if answer.status_code >= 500:
        tally.bad.append(f"{worst}: {answer.status_code}")


def read(address: str, told: Connection) -> None:
    """Read the version until told to stop, in a process that has nothing else to do; then tell how long each took."""
    readings = []
    with httpx.Client(base_url=address, timeout=300) as client:
        while not told.poll(PAUSE):
            begin = perf_counter()
            client.get("/api/v1/version").raise_for_status()
            readings.append(perf_counter() - begin)
    told.send(readings)


@contextmanager
def reader(address: str, readings: list[float]) -> Iterator[None]:
    """Another client that reads."""
    context = get_context("spawn")
    ours, theirs = context.Pipe()
    process = context.Process(target=read, args=(address, theirs))
    process.start()
    try:
        yield
        ours.send("stop")
        readings += ours.recv()
    finally:
        process.kill()
        process.join()


async def watch(service: Served, tally: Tally) -> None:
    """Look at the memory for ever."""
    while True:
        tally.memory.append(resident(service.process.pid))
        await asyncio.sleep(0.02)


async def ask(client: httpx.AsyncClient, left: Iterator[Request], tally: Tally) -> None:
    """Send what is left, one after the other."""
    for path, body in left:
        begin = perf_counter()
        answer = await client.post(path, json=body)
        name = f"{answer.status_code} {path} {str(body)[:120]}"
        tally.statuses[answer.status_code] += 1
        tally.seconds.append((perf_counter() - begin, name))
        tally.sizes.append((len(answer.content), name))
        if is_wrong(answer.status_code):
            tally.bad.append(f"{answer.status_code} {path} {body}")
        if len(tally.seconds) % 500 == 0:
            print(f"{len(tally.seconds)} extreme requests", flush=True)


async def drive(service: Served, share: float, count: int) -> tuple[Tally, Tally]:
    """All worst bodies, or a share of them, then so many extreme requests, while another client reads."""
    draw, clock = random.Random(1), processor_clock(service.process.pid)
    worst, extreme = Tally(), Tally()
    async with httpx.AsyncClient(base_url=service.address, timeout=300) as client:
        document = (await client.get("/api/v1/openapi.json")).json()
        chosen = [one for one in worst_bodies(document) if draw.random() < share]
        draw.shuffle(chosen)
        while (await client.get("/api/v1/ready")).status_code != 200:
            await asyncio.sleep(0.2)
        for small in list(worst_bodies(document, 1000))[::100]:
            await send(client, small, clock, Tally())
        watching = asyncio.create_task(watch(service, worst))
        with reader(service.address, worst.quiet):
            await asyncio.sleep(5.0)
        with reader(service.address, worst.readings):
            await asyncio.sleep(2.0)
            for number, one in enumerate(chosen, 1):
                await send(client, one, clock, worst)
                if number % 500 == 0:
                    print(f"{number} of {len(chosen)}", flush=True)
        watching.cancel()
        watching, left = asyncio.create_task(watch(service, extreme)), requests(count)
        with reader(service.address, extreme.readings):
            await asyncio.sleep(2.0)
            await asyncio.gather(*(ask(client, left, extreme) for _ in range(AT_ONCE)))
        watching.cancel()
    return worst, extreme


def main() -> None:
    share = float(sys.argv[1]) if len(sys.argv) > 1 else 1.0
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 5000
    with served(**QUICK) as service:
        worst, extreme = asyncio.run(drive(service, share, count))
    print(f"WORST BODIES\n{worst}\nEXTREME NUMBERS\n{extreme}")
    print(f"load of the machine {os.getloadavg()[0]:.1f}")


if __name__ == "__main__":
    main()
