"""The service as a process of its own, at a free port of loopback: one for a test, or one for all tests of a run."""

from __future__ import annotations

import fcntl
import json
import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TextIO

import httpx

# The first simulations on a machine wait for a compiler; and beside others a derivation has little of a processor.
PATIENT = {"derivation_deadline": 120, "simulation_deadline": 300, "queue_patience": 300}
# Seconds until a service that does not answer, or does not come to what is waited for, is called broken: a busy machine
# is not an error, and waiting costs nothing where all is well.
PATIENCE = 240.0
COMMAND = (sys.executable, "-m", "deltaq.cli", "serve", "--port", "0")
ADDRESS = re.compile(r"http://\S+/")


@dataclass(frozen=True)
class Served:
    """A running service, its address, host and port."""

    process: subprocess.Popen[str]
    address: str

    @property
    def place(self) -> tuple[str, int]:
        url = httpx.URL(self.address)
        return url.host, url.port or 80


@contextmanager
def served(**settings: object) -> Iterator[Served]:
    """`deltaq serve` with these settings; killed at the end if it has not ended by itself."""
    environment, quiet = _environment(settings), subprocess.DEVNULL  # a pipe that nobody reads would stop the service
    with subprocess.Popen(COMMAND, env=environment, text=True, stdout=subprocess.PIPE, stderr=quiet) as process:
        try:
            assert process.stdout is not None
            found = ADDRESS.search(process.stdout.readline())
            assert found is not None
            yield Served(process, found[0])
        finally:
            process.kill()


def _environment(settings: dict[str, object]) -> dict[str, str]:
    return os.environ | {f"DELTAQ_{name.upper()}": str(value) for name, value in settings.items()}


@contextmanager
def shared(place: Path, **settings: object) -> Iterator[str]:
    """The address of a service that all processes share which name the same place; none of them may burden or end it.

    Who comes first starts it, who leaves last ends it: a service takes six seconds of a processor until all its workers
    are up. It is nobody's child, so that it outlives the process that started it. Beside `place`, a file with the
    address, stands one that counts the users.
    """
    with _users(place) as users:
        if not users:
            place.unlink(missing_ok=True)
            users.append(_detached(place, settings))
        users.append(os.getpid())
    try:
        yield _address(place)
    finally:
        with _users(place) as users:
            if os.getpid() in users:
                users.remove(os.getpid())
            if len(users) == 1:
                os.kill(users.pop(), signal.SIGKILL)


@contextmanager
def _users(place: Path) -> Iterator[list[int]]:
    """The service's process and those who use it, nobody else changing them meanwhile; empty if there is none.

    Who has died has not left, and is not counted.
    """
    place.parent.mkdir(parents=True, exist_ok=True)
    with place.with_suffix(".users").open("a+", encoding="utf-8") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        service, users = _read(file)[:1], list(filter(lives, _read(file)))
        users = users if users[:1] == service else []
        yield users
        file.truncate(0)
        json.dump(users, file)


def lives(number: int) -> bool:
    """Whether there is a process of this number that has not ended."""
    try:
        state = Path(f"/proc/{number}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()[0]
    except (FileNotFoundError, ProcessLookupError):
        return False
    return state not in "XZ"


def _read(file: TextIO) -> list[int]:
    file.seek(0)
    users: list[int] = json.loads(file.read() or "[]")
    return users


def _detached(place: Path, settings: dict[str, object]) -> int:
    """Starts the service and returns the number of its process; its first line will stand in the file."""
    command = ["sh", "-c", '"$@" >"$0" 2>/dev/null </dev/null & echo $!', str(place), *COMMAND]
    return int(subprocess.run(command, env=_environment(settings), stdout=subprocess.PIPE, check=True).stdout)


def _address(place: Path) -> str:
    end = time.monotonic() + PATIENCE
    while not (found := ADDRESS.search(place.read_text(encoding="utf-8") if place.exists() else "")):
        assert time.monotonic() < end, "the service does not come up"
        time.sleep(0.05)
    return found[0]
