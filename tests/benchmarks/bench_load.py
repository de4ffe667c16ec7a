"""Three hundred students who click at the very same moment: different simulations, seconds until each has its answer.

Run it from the checkout: `python -m tests.benchmarks.bench_load`. Serves and asks on this machine only, in one process
each; three rounds after one that warms. Prints; judges nothing.
"""

from __future__ import annotations

import asyncio
import os
import re
import subprocess
import sys
from time import perf_counter

import httpx
import numpy as np

STUDENTS, ROUNDS, PATIENCE = 300, 4, 60.0
SCENES = ("pendulum", "elastic-pendulum", "double-pendulum", "cart-pendulum", "guided-pendulum", "spherical-pendulum")


async def click(client: httpx.AsyncClient, turn: int, student: int) -> tuple[int, float]:
    """One simulation that nobody else asks for: the status and the seconds."""
    request = {
        "scene": SCENES[student % len(SCENES)],
        "parameters": {"g": 9.0 + 1e-3 * student + 0.3 * turn},
        "t_end": 10.0,
        "samples": 301,
        "include": ["coordinates", "positions", "loads", "energy", "error"],
    }
    start = perf_counter()
    response = await client.post("/api/v1/simulations", json=request)
    return response.status_code, perf_counter() - start


async def rounds(address: str) -> None:
    limits = httpx.Limits(max_connections=STUDENTS, max_keepalive_connections=STUDENTS)
    async with httpx.AsyncClient(base_url=address, timeout=PATIENCE, limits=limits) as client:
        for turn in range(ROUNDS):
            found = await asyncio.gather(*(click(client, turn, student) for student in range(STUDENTS)))
            seconds = np.array([each for _, each in found])
            failed = sum(status != 200 for status, _ in found)
            p50, p95, p99 = np.percentile(seconds, (50, 95, 99))
            label = "warming" if turn == 0 else f"round {turn}"
            print(f"{label:10} p50 {p50:.2f} s   p95 {p95:.2f} s   p99 {p99:.2f} s   failed {failed}", flush=True)


def main() -> None:
    command = [sys.executable, "-m", "deltaq.cli", "serve", "--port", "0"]
    with subprocess.Popen(command, env=dict(os.environ), stdout=subprocess.PIPE, text=True) as server:
        assert server.stdout is not None
        found = re.search(r"http://\S+", server.stdout.readline())
        assert found is not None
        try:
            asyncio.run(rounds(found[0]))
        finally:
            server.terminate()


if __name__ == "__main__":
    main()
