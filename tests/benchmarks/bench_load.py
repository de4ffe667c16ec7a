"""Three hundred students who click at the very same moment: different simulations, seconds until each has its answer.

Run it from the checkout: `python -m tests.benchmarks.bench_load`. Serves and asks on this machine only, in one process
each; rounds after one that warms. The client only writes requests and reads answers, so that it takes no time from the
service, whose processor seconds are told beside. Prints; judges nothing.
"""

from __future__ import annotations

import asyncio
import json
import os
import re
from collections.abc import AsyncIterator, Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter

import numpy as np
from tests.serving import served

STUDENTS, ROUNDS = 300, 4
SCENES = ("pendulum", "elastic-pendulum", "double-pendulum", "cart-pendulum", "guided-pendulum", "spherical-pendulum")
Connection = tuple[asyncio.StreamReader, asyncio.StreamWriter]


def request(turn: int, student: int) -> bytes:
    """One simulation that nobody else asks for, in HTTP/1.1."""
    question = {
        "scene": SCENES[student % len(SCENES)],
        "parameters": {"g": 9.0 + 1e-3 * student + 0.3 * turn},
        "t_end": 10.0,
        "samples": 301,
        "include": ["coordinates", "positions", "loads", "energy", "error"],
    }
    body = json.dumps(question).encode()
    lines = ("POST /api/v1/simulations HTTP/1.1", "Host: localhost", "Content-Type: application/json")
    head = "\r\n".join((*lines, "Accept-Encoding: gzip", f"Content-Length: {len(body)}", "", ""))
    return head.encode() + body


async def click(connection: Connection, turn: int, student: int) -> tuple[int, float]:
    """The status and the seconds."""
    reader, writer = connection
    start = perf_counter()
    writer.write(request(turn, student))
    head = await reader.readuntil(b"\r\n\r\n")
    length = re.search(rb"content-length: (\d+)", head, re.IGNORECASE)
    await reader.readexactly(int(length[1]) if length else 0)
    return int(head.split(b" ", 2)[1]), perf_counter() - start


@dataclass(frozen=True)
class Round:
    """All have clicked once: seconds of half, of 95 and of 99 in a hundred, and processor seconds of the service."""

    p50: float
    p95: float
    p99: float
    failed: int
    processor: float

    def __str__(self) -> str:
        seconds = f"p50 {self.p50:.2f} s   p95 {self.p95:.2f} s   p99 {self.p99:.2f} s"
        return f"{seconds}   failed {self.failed}   processor {self.processor:.2f} s"


async def rounds(host: str, port: int, server: int) -> AsyncIterator[Round]:
    """One round after the other; the first warms."""
    connections = [await asyncio.open_connection(host, port) for _ in range(STUDENTS)]
    for turn in range(ROUNDS):
        before = processor_seconds(server)
        found = await asyncio.gather(*(click(connections[each], turn, each) for each in range(STUDENTS)))
        p50, p95, p99 = np.percentile([seconds for _, seconds in found], (50, 95, 99))
        failed = sum(status != 200 for status, _ in found)
        yield Round(float(p50), float(p95), float(p99), failed, processor_seconds(server) - before)


def processor_seconds(process: int) -> float:
    """What a process and all that it started have used; zero where the system does not tell."""
    total = 0.0
    with suppress(OSError):
        for each in family(process):
            fields = Path(f"/proc/{each}/stat").read_text().rpartition(")")[2].split()
            total += (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
    return total


def family(process: int) -> Iterator[int]:
    """A process and its descendants."""
    yield process
    for children in Path(f"/proc/{process}/task").glob("*/children"):
        for child in children.read_text().split():
            yield from family(int(child))


async def measured() -> list[Round]:
    """The rounds after the one that warms, told as they come."""
    found = []
    with served() as service:
        async for each in rounds(*service.place, service.process.pid):
            print(f"{each}   load of the machine {os.getloadavg()[0]:.1f}", flush=True)
            found.append(each)
    return found[1:]


def main() -> None:
    asyncio.run(measured())


if __name__ == "__main__":
    main()
