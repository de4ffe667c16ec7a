"""One worker process, seen from the supervisor: start it, ask it, kill it."""

from __future__ import annotations

import contextlib
import signal
from collections.abc import Sequence
from dataclasses import dataclass
from multiprocessing import get_context
from multiprocessing.connection import Connection
from multiprocessing.context import ForkServerProcess
from threading import Lock

from .job import DeadlineExceeded, WorkerDied
from .message import READY
from .runner import run

_CONTEXT = get_context("forkserver")  # forks from a process of one thread; the web process has many
_PROCESSES = Lock()  # multiprocessing keeps a list of children that is not made for several threads
_FORK_SERVER_GONE = 255  # who would have told the exit code; it takes its workers along
_KILLED_FROM_OUTSIDE = frozenset({-signal.SIGKILL, -signal.SIGTERM, _FORK_SERVER_GONE})


@dataclass(frozen=True)
class Worker:
    """A running process and the pipe to it; used by one thread only."""

    process: ForkServerProcess
    connection: Connection

    @property
    def pid(self) -> int:
        return self.process.pid or 0

    def ask(self, request: bytes, deadline: float) -> bytes:
        """The reply, within `deadline` seconds, or DeadlineExceeded or WorkerDied; after an error only kill it."""
        try:
            self.connection.send_bytes(request)
            if self.connection.poll(deadline):
                return self.connection.recv_bytes()
        except (EOFError, OSError):
            raise self.cause_of_death() from None
        raise DeadlineExceeded(f"no answer within {deadline} s")

    def cause_of_death(self) -> WorkerDied | DeadlineExceeded:
        """Why the process is gone; its bound on processor time is a deadline too."""
        with _PROCESSES:
            self.process.join(1.0)
            code = self.process.exitcode
        if code == -signal.SIGXCPU:
            return DeadlineExceeded("processor time used up")
        return WorkerDied(f"the worker process ended with exit code {code}", repeatable=code in _KILLED_FROM_OUTSIDE)

    def kill(self) -> None:
        """End the process at once and free what it held."""
        self.connection.close()
        with _PROCESSES, contextlib.suppress(OSError, ValueError):
            self.process.kill()
            self.process.join(1.0)
            self.process.close()


def start_worker(memory: int, timeout: float) -> Worker:
    """A worker that has said it is ready; OSError, EOFError or TimeoutError if it does not come up."""
    ours, theirs = _CONTEXT.Pipe()
    process = _CONTEXT.Process(target=run, args=(theirs, memory), daemon=True, name="deltaq-worker")
    with _PROCESSES:
        process.start()
    theirs.close()
    worker = Worker(process, ours)
    try:
        if not ours.poll(timeout):
            raise TimeoutError(f"the worker was not ready after {timeout} s")
        if ours.recv_bytes() != READY:
            raise OSError("the worker began with something else")
    except BaseException:
        worker.kill()
        raise
    return worker


def preload(modules: Sequence[str]) -> None:
    """Modules that the fork server imports once, so that each worker has them at birth. To be called before a start."""
    _CONTEXT.set_forkserver_preload(list(modules))
