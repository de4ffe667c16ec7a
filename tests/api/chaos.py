"""All goes wrong at once, and no answer may be: workers are killed, kept answers damaged, the disk is full, Redis gone.

Run it for long from the checkout: `python -m tests.api.chaos 1000` kills a thousand workers. Loopback only; it ends by
itself, with 1 if an answer was wrong or the service was lost. The disk is a small one in memory, which takes root.
"""

from __future__ import annotations

import asyncio
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import httpx
from tests.serving import PATIENT, Served, served

API = "api/v1"
CLIENTS = 6
ANSWERS_A_KILL = 6  # as many answers lie between two kills: the pace is the service's, on a slow machine, too
MOST_TRIES = 20  # of a question, a second apart
PAUSE = 0.1  # seconds between two kills at least
Question = tuple[str, dict[str, Any]]
QUESTIONS: tuple[Question, ...] = (
    *(("derivations", {"scene": scene}) for scene in ("pendulum", "guided-pendulum", "elastic-pendulum")),
    *(("variations", {"expression": f"{n}*sin(x)*dot(x)^2", "functions": ["x"]}) for n in range(2, 7)),
    *(("simulations", {"scene": "double-pendulum", "t_end": 2.0 + n, "samples": 21}) for n in range(5)),
    *(("expressions", {"scene": "pendulum", "expression": f"m*l^{n}*sin(phi)"}) for n in range(2, 7)),
)


@dataclass
class Tally:
    """What was done to the service, and what came of it."""

    kills: int = 0
    damages: int = 0
    full: int = 0  # times that the disk was full
    gone: int = 0  # times that Redis was killed
    statuses: Counter[int] = field(default_factory=Counter)
    wrong: list[Question] = field(default_factory=list)

    def __str__(self) -> str:
        statuses = ", ".join(f"{count} × {status}" for status, count in sorted(self.statuses.items()))
        done = f"{self.kills} kills, {self.damages} damaged answers, disk full {self.full} ×, Redis gone {self.gone} ×"
        return f"{done}: {statuses}; {len(self.wrong)} wrong"


async def ask(client: httpx.AsyncClient, question: Question) -> tuple[int, Any]:
    """Status and answer, without what may differ from time to time."""
    path, body = question
    response = await client.post(f"{API}/{path}", json=body)
    answer = response.json()
    answer.pop("cost", None)
    return response.status_code, answer


async def insist(client: httpx.AsyncClient, question: Question) -> Any:
    """The answer, asked for again as long as the service says that it is busy: a worker may have died at the end."""
    for _ in range(MOST_TRIES):
        status, answer = await ask(client, question)
        if status != 503:
            break
        await asyncio.sleep(1.0)
    return answer


async def use(client: httpx.AsyncClient, expected: list[Any], tally: Tally) -> None:
    """A client that asks and compares for ever."""
    while True:
        number = random.randrange(len(QUESTIONS))
        status, answer = await ask(client, QUESTIONS[number])
        tally.statuses[status] += 1
        if status == 200 and answer != expected[number]:
            tally.wrong.append(QUESTIONS[number])


def children(pid: int) -> list[int]:
    """The processes that a process has started."""
    found = []
    for status in Path("/proc").glob("[0-9]*/stat"):
        with suppress(OSError):
            if int(status.read_text().rpartition(")")[2].split()[1]) == pid:
                found.append(int(status.parent.name))
    return found


def workers_of(service: Served) -> list[int]:
    """The processes that the fork server has made."""
    return [worker for child in children(service.process.pid) for worker in children(child)]


async def kill(service: Served, wanted: int, tally: Tally) -> None:
    """Kill workers, whatever they do at the moment, until enough are dead."""
    while tally.kills < wanted:
        while tally.statuses.total() < ANSWERS_A_KILL * tally.kills:
            await asyncio.sleep(PAUSE)
        for worker in random.sample(found := workers_of(service), min(1, len(found))):
            with suppress(ProcessLookupError):
                os.kill(worker, signal.SIGKILL)
                tally.kills += 1
        await asyncio.sleep(PAUSE)


async def damage(folder: Path, tally: Tally) -> None:
    """Cut, flip or remove kept answers for ever."""
    while True:
        for file in random.sample(found := list(folder.rglob("*.answer")), min(1, len(found))):
            with suppress(OSError):
                content = bytearray(file.read_bytes())
                place = random.randrange(len(content) or 1)
                content[place : place + 1] = random.choice((b"", b"\0\0", bytes([content[place] ^ 1])))
                file.write_bytes(content) if random.random() < 0.8 else file.unlink()
                tally.damages += 1
        await asyncio.sleep(PAUSE)


async def fill(folder: Path, tally: Tally) -> None:
    """The small disk is full for a second, and has some room for another."""
    ballast = folder / "ballast"
    while True:
        with suppress(OSError), ballast.open("wb", buffering=0) as file:
            while file.write(bytes(2**12)) > 0:
                pass
        tally.full += shutil.disk_usage(folder).free == 0
        await asyncio.sleep(1.0)
        ballast.unlink()
        await asyncio.sleep(1.0)


@contextmanager
def small_disk(folder: Path) -> Iterator[bool]:
    """The folder as a disk of its own, a small one in memory; False where that is not allowed."""
    mount = ["mount", "-t", "tmpfs", "-o", "size=1m,mode=700", "tmpfs", str(folder)]
    mounted = (
        shutil.which("mount") is not None and subprocess.run(mount, check=False, capture_output=True).returncode == 0
    )
    try:
        yield mounted
    finally:
        if mounted:
            subprocess.run(["umount", "--lazy", str(folder)], check=True)


async def come_and_go(socket: Path, tally: Tally) -> None:
    """A Redis that is killed every second, where there is one."""
    server = shutil.which("redis-server")
    while server:
        command = [server, "--port", "0", "--unixsocket", str(socket), "--save", "", "--dir", str(socket.parent)]
        with subprocess.Popen(command, stdout=subprocess.DEVNULL) as redis:
            try:
                await asyncio.sleep(1.0)
            finally:
                redis.kill()
                tally.gone += 1
        await asyncio.sleep(0.5)


async def torment(service: Served, folder: Path, disk: Path | None, kills: int) -> Tally:
    """All of it, with the answers of quieter times to compare with, before and after."""
    tally = Tally()
    async with httpx.AsyncClient(base_url=service.address, timeout=300) as client:
        before = [await ask(client, question) for question in QUESTIONS]
        assert {status for status, _ in before} == {200}
        expected = [answer for _, answer in before]
        others = [use(client, expected, tally) for _ in range(CLIENTS)]
        others += [damage(folder, tally), come_and_go(folder / "redis.socket", tally)]
        others += [fill(disk, tally)] if disk else []
        running = [asyncio.create_task(one) for one in others]
        await kill(service, kills, tally)
        for task in running:
            task.cancel()
        failures = [one for one in await asyncio.gather(*running, return_exceptions=True) if isinstance(one, Exception)]
        after = [await insist(client, question) for question in QUESTIONS]
        tally.wrong += [q for q, answer, right in zip(QUESTIONS, after, expected, strict=True) if answer != right]
    if failures:
        raise failures[0]
    return tally


def run(kills: int) -> Tally:
    """A service of its own, tormented and ended."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        disk = folder / "disk"
        disk.mkdir()
        settings = {"workers": 3, "cache_size": 0, "cache_folder": disk, "redis": f"unix://{folder}/redis.socket"}
        with small_disk(disk) as is_small, served(**settings, **PATIENT) as service:
            return asyncio.run(torment(service, folder, disk if is_small else None, kills))


if __name__ == "__main__":
    found = run(int(sys.argv[1]))
    print(found)
    sys.exit(bool(found.wrong))
