"""Seconds from `deltaq serve` to the first page, the first motion and the last kernel; on a new machine and later.

Run it from the checkout: `python -m tests.benchmarks.bench_start`. A new machine is one with empty caches of kernels
and models. Talks to this machine only. Prints; judges nothing.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager

import httpx

PATIENCE = 240.0
METHODS = ("auto", "rk4", "stormer-verlet", "gauss-4", "radau-5", "newmark")


@contextmanager
def serving(cache: str) -> Iterator[tuple[str, float]]:
    """A service with its caches in a folder: its address, and when it was started."""
    environment = os.environ | {"NUMBA_CACHE_DIR": f"{cache}/kernels"}
    environment.pop("PYTHONDONTWRITEBYTECODE", None)  # a machine keeps the bytecode of the packages installed on it
    start = time.perf_counter()
    command = [sys.executable, "-m", "deltaq.cli", "serve", "--port", "0"]
    process = subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, text=True)
    try:
        assert process.stdout is not None
        found = re.search(r"http://\S+", process.stdout.readline())
        assert found is not None
        yield found[0], start
    finally:
        process.terminate()
        process.wait()


def report(name: str, cache: str) -> None:
    with serving(cache) as (address, start), httpx.Client(base_url=address, timeout=PATIENCE) as client:
        client.get("/")
        page = time.perf_counter() - start
        told = []
        for method in METHODS:
            request = {"scene": "elastic-pendulum", "t_end": 10.0, "method": method, "tolerance": 1e-4}
            client.post("/api/v1/simulations", json=request).raise_for_status()
            told.append(f"{method} {time.perf_counter() - start:.1f}")
    print(f"{name:14} page {page:.1f}   motion by " + "   ".join(told), flush=True)


def main() -> None:
    with tempfile.TemporaryDirectory() as cache:
        for name in ("new machine", "second start", "third start"):
            report(name, cache)


if __name__ == "__main__":
    main()
