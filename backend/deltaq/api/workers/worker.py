"""One worker process, seen from the supervisor: start it, ask it, kill it."""

from __future__ import annotations

import contextlib
import signal
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from multiprocessing import forkserver, get_context
from multiprocessing.connection import Connection
from multiprocessing.context import ForkServerProcess
from threading import Lock

from .job import MOMENT, DeadlineExceeded, GivenUp, Job, NotFast, WorkerDied, WorkerKilled
from .message import PART
from .meter import Meter, processor_clock
from .runner import run

PRELOAD = "deltaq.api.workers.preload"
_CONTEXT = get_context("forkserver")  # forks from a process of one thread; the web process has many
_PROCESSES = Lock()  # multiprocessing keeps a list of children that is not made for several threads
_FORK_SERVER_GONE = 255  # who would have told the exit code; it takes its workers along
_KILLED_FROM_OUTSIDE = frozenset({-signal.SIGKILL, -signal.SIGTERM, _FORK_SERVER_GONE})
LOOK_UP = 0.05  # seconds between two looks at whether anybody still waits; each costs some 20 µs
SHORTEST_LOOK = 0.01  # seconds; a process that gets no processor uses up its time slowly


@dataclass(frozen=True)
class Listener:
    """Who waits for an answer: receives its parts, and may go away. Called from the thread that asks the worker."""

    on_part: Callable[[bytes], object]
    has_gone: Callable[[], bool]


NOBODY = Listener(lambda _part: None, lambda: False)


def _always() -> bool:
    return True


@dataclass(frozen=True)
class Worker:
    """A running process, the pipe to it, and the meter of its processor time; used by one thread only."""

    process: ForkServerProcess
    connection: Connection
    meter: Meter

    @property
    def pid(self) -> int:
        return self.process.pid or 0

    def ask(
        self, request: bytes, job: Job, listener: Listener = NOBODY, may_go_on: Callable[[], bool] = _always
    ) -> bytes:
        """The reply to the request of a job, within its bounds; its parts go to the listener.

        `may_go_on` is asked repeatedly once the job has used more than a moment. Raises DeadlineExceeded, WorkerDied,
        GivenUp when the listener has gone, or NotFast; after an error the worker can only be killed.
        """
        end = time.monotonic() + job.deadline
        self.meter.start()
        try:
            self.connection.send_bytes(request)
            while (left := end - time.monotonic()) > 0.0:
                if listener.has_gone():
                    raise GivenUp("nobody waits for the answer")
                used = self.meter.seconds
                if (unused := job.processor_time - used) <= 0.0:
                    raise DeadlineExceeded(f"no answer within {job.processor_time} s of a processor")
                if used > MOMENT and not may_go_on():
                    raise NotFast(f"no answer within {MOMENT} s of a processor")
                if not self.connection.poll(min(left, LOOK_UP, max(unused / job.threads, SHORTEST_LOOK))):
                    continue
                reply = self.connection.recv_bytes()
                if reply[:1] != PART:
                    return reply
                listener.on_part(reply[1:])
        except (EOFError, OSError):
            raise self.cause_of_death() from None
        raise DeadlineExceeded(f"no answer within {job.deadline} s")

    def cause_of_death(self) -> WorkerDied | DeadlineExceeded:
        """Why the process is gone; exceeding its processor time counts as a deadline."""
        with _PROCESSES:
            self.process.join(1.0)
            code = self.process.exitcode
        if code == -signal.SIGXCPU:
            return DeadlineExceeded("processor time used up")
        kind = WorkerKilled if code in _KILLED_FROM_OUTSIDE else WorkerDied
        return kind(f"the worker process ended with exit code {code}")

    def kill(self) -> None:
        """Kills the process and frees what it held."""
        self.connection.close()
        with _PROCESSES, contextlib.suppress(OSError, ValueError):
            self.process.kill()
            self.process.join(1.0)
            self.process.close()


def start_worker(memory: int, timeout: float, niceness: int = 0) -> Worker:
    """A worker that has reported to be ready. Raises OSError, EOFError or TimeoutError if it does not come up."""
    ours, theirs = _CONTEXT.Pipe()
    process = _CONTEXT.Process(target=run, args=(theirs, memory, niceness), daemon=True, name="deltaq-worker")
    with _PROCESSES:
        process.start()
    theirs.close()
    worker = Worker(process, ours, Meter(processor_clock(process.pid or 0)))
    try:
        if not ours.poll(timeout):
            raise TimeoutError(f"the worker was not ready after {timeout} s")
        ours.recv_bytes()  # its first words are that it is ready
    except BaseException:
        worker.kill()
        raise
    return worker


def start_fork_server(modules: Sequence[str] = (PRELOAD,)) -> None:
    """The process that workers are forked from; it imports these modules once, so that each worker has them at birth.

    Returns at once, and does nothing if it runs already. It ends with the thread that started it (see
    die_with_parent), so that should be the main one.
    """
    _CONTEXT.set_forkserver_preload(list(modules))
    forkserver.ensure_running()
