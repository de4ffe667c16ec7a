"""The loop of a worker process: read a request, run its function, write the answer or the error as data."""

from __future__ import annotations

import gc
import json
import os
import signal
from collections.abc import Generator, Iterator
from importlib import import_module
from multiprocessing.connection import Connection
from typing import Any

from ...errors import MOST_PROBLEMS, InputError
from .limits import bound_memory, bound_processor_time, die_first, die_with_parent, keep_only, step_back
from .message import PART, READY, Failure, encode_answer, encode_error, problem_data
from .traces import trace_of


def run(connection: Connection, memory: int, niceness: int = 0) -> None:
    """Serve requests until the other end of the pipe is closed."""
    keep_only(connection.fileno())
    die_with_parent()
    die_first()
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the server, which then closes the pipe
    bound_memory(memory)
    step_back(niceness)
    collect_rarely()
    connection.send_bytes(READY)
    while True:
        try:
            request = connection.recv_bytes()
        except (EOFError, OSError):
            os._exit(0)
        for message in replies_to(request):
            connection.send_bytes(message)


def collect_rarely() -> None:
    """Makes garbage collection rare: libraries are never garbage, and most objects of a derivation live as long as it.

    A full collection comes after 200 000 objects, so that at most some 20 MB of garbage are left.
    """
    gc.freeze()
    gc.set_threshold(10_000, 10, 2)


def replies_to(request: bytes) -> Iterator[bytes]:
    """The parts of the answer to one request, and the answer; every exception becomes data."""
    try:
        target, seconds, document = json.loads(request)
        bound_processor_time(seconds)
        found = function_of(target)(document)
        yield encode_answer((yield from _parts(found)) if isinstance(found, Generator) else found)
    except InputError as error:
        problems = tuple(problem_data(problem) for problem in error.problems[: MOST_PROBLEMS + 1])
        yield encode_error(Failure(type(error).__name__, problems=problems))
    except BaseException as error:  # noqa: BLE001  a worker answers whatever happens
        yield encode_error(failure_of(error))


def _parts(found: Generator[Any, None, Any]) -> Generator[bytes, None, Any]:
    """Each part as soon as it is there; returns the answer."""
    while True:
        try:
            part = next(found)
        except StopIteration as end:
            return end.value
        yield encode_answer(part, PART)


def failure_of(error: BaseException) -> Failure:
    """An exception that is our bug, as data; also one whose text cannot be made."""
    kind = type(error).__name__
    try:
        return Failure(kind, f"{kind}: {error}"[:1000], trace_of(error))
    except BaseException:  # noqa: BLE001  its __str__ raises
        return Failure(kind, kind)


def function_of(target: str) -> Any:
    """The function named `package.module:function`."""
    module, _, name = target.partition(":")
    return getattr(import_module(module), name)
