"""The service as a process of its own, at a free port of loopback."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

import httpx

# The first simulations on a machine wait for a compiler.
PATIENT = {"simulation_deadline": 300, "queue_patience": 300}
# Seconds until a service that does not answer, or does not come to what is waited for, is called broken: a busy machine
# is not an error, and waiting costs nothing where all is well.
PATIENCE = 240.0


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
    given = {f"DELTAQ_{name.upper()}": str(value) for name, value in settings.items()}
    command = [sys.executable, "-m", "deltaq.cli", "serve", "--port", "0"]
    environment, quiet = os.environ | given, subprocess.DEVNULL  # a pipe that nobody reads would stop the service
    with subprocess.Popen(command, env=environment, text=True, stdout=subprocess.PIPE, stderr=quiet) as process:
        try:
            assert process.stdout is not None
            found = re.search(r"http://\S+/", process.stdout.readline())
            assert found is not None
            yield Served(process, found[0])
        finally:
            process.kill()
