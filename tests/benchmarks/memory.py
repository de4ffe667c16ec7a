"""How much memory a service and its workers hold while it answers, and whether that grows."""

from __future__ import annotations

import asyncio
import os
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

MIB = 2**20
WARM_UP = 0.2  # part of a run in which caches fill and workers come up


def resident(pid: int) -> float:
    """The resident memory of a process in MiB; 0 if it is gone."""
    with suppress(OSError):
        return int(Path(f"/proc/{pid}/statm").read_text(encoding="ascii").split()[1]) * os.sysconf("SC_PAGE_SIZE") / MIB
    return 0.0


def children(pid: int) -> list[int]:
    """The processes that a process has started, whichever of its threads did."""
    found: list[int] = []
    for file in Path(f"/proc/{pid}/task").glob("*/children"):
        with suppress(OSError):
            found += map(int, file.read_text(encoding="ascii").split())
    return found


@dataclass
class Memory:
    """Samples of the web process and of the largest of its workers, by the number of requests answered until then."""

    pid: int
    requests: list[int] = field(default_factory=list)
    server: list[float] = field(default_factory=list)
    workers: list[float] = field(default_factory=list)

    def look(self, requests: int) -> None:
        """Take a sample."""
        workers = [worker for child in children(self.pid) for worker in children(child)]
        self.requests.append(requests)
        self.server.append(resident(self.pid))
        self.workers.append(sum(map(resident, workers)) / max(len(workers), 1))

    def slope(self, values: list[float]) -> float:
        """MiB for each ten thousand requests, by least squares after the warm-up."""
        begin = WARM_UP * self.requests[-1]
        chosen = [(n / 1e4, value) for n, value in zip(self.requests, values, strict=True) if n >= begin]
        return float(np.polyfit(*np.array(chosen).T, 1)[0]) if len(chosen) > 2 else float("nan")

    def __str__(self) -> str:
        return "\n".join(
            f"{name:16} {values[0]:5.0f} → {values[-1]:5.0f} MiB, most {max(values):5.0f}; after the warm-up "
            f"{self.slope(values):+.2f} MiB in 10 000 requests"
            for name, values in (("web process", self.server), ("each worker", self.workers))
        )

    async def watch(self, seconds: float, answered: Callable[[], int]) -> None:
        """Take samples for ever."""
        while True:
            self.look(answered())
            await asyncio.sleep(seconds)
