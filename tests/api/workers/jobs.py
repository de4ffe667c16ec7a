"""Jobs for the supervisor's tests: each misbehaves in its own way, in a worker process."""

from __future__ import annotations

import contextlib
import gc
import hashlib
import os
import resource
import signal
import struct
import sys
import threading
import time
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any
from unittest import mock

from deltaq.api.jobs import simulate_at_once
from deltaq.errors import Problem, SceneError, UnknownNameError
from deltaq.simulation.kernels import compiler


def echo(document: Any) -> Any:
    return document


def count(document: Any) -> Any:
    """One part after the other, the last as the answer; a step may fail."""
    for number in range(document["parts"]):
        if number == document.get("fails_at"):
            raise ValueError("no further")
        time.sleep(document.get("pause", 0.0))
        if number == document["parts"] - 1:
            break
        yield {"number": number}
    return {"number": number}


def pid(document: Any) -> Any:
    return {"pid": os.getpid()}


def family(document: Any) -> Any:
    return {"parent": os.getppid()}


def simulate_on_new_machine(document: Any) -> Any:
    """As the service does it while kernels are compiled: none has machine code yet."""
    with mock.patch.object(compiler.Kernel, "__call__", lambda kernel, *given: kernel.function(*given)):
        return simulate_at_once(document)


def simulate_longer_on_new_machine(document: Any) -> Any:
    """The same, as often as the service tries."""
    return simulate_on_new_machine(document)


def sleep(document: Any) -> Any:
    time.sleep(document)
    return {"slept": document}


def wait_at(document: Any) -> Any:
    """Until the file of this name is there."""
    while not Path(document).exists():
        time.sleep(0.005)
    return "open"


def spin(document: Any) -> Any:
    """A computation that no Python signal handler can interrupt."""
    return 10 ** (10**9)


def burn(document: Any) -> Any:
    """So many seconds of processor time on each of some threads, and then some sleep; a mark tells of each begin."""
    if "mark" in document:
        with Path(document["mark"]).open("a", encoding="utf-8") as mark:
            mark.write("x")

    def work() -> None:
        end = time.thread_time() + document["seconds"]
        while time.thread_time() < end:
            hashlib.sha256(bytes(2**20))  # leaves the interpreter to the others

    threads = [threading.Thread(target=work) for _ in range(document.get("threads", 1))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    time.sleep(document.get("sleep", 0.0))
    return document


def ignore_signals(document: Any) -> Any:
    for number in (signal.SIGTERM, signal.SIGINT, signal.SIGALRM):
        signal.signal(number, signal.SIG_IGN)
    while True:
        with contextlib.suppress(BaseException):
            time.sleep(60)


def wrong_scene(document: Any) -> Any:
    raise SceneError(
        Problem("unknown_name", "/bodies/0/mass", 2, 3, {"name": "mas", "suggestion": "m"}),
        Problem("missing", "/title"),
    )


def unknown_name(document: Any) -> Any:
    raise UnknownNameError(Problem("unknown_scene", "/scene", parameters={"name": "x"}))


def divide_by_zero(document: Any) -> Any:
    return 1 / 0


class Unpicklable(Exception):
    def __init__(self, one: Any, two: Any) -> None:
        super().__init__("no way back")
        self.held = lambda: (one, two)

    def __str__(self) -> str:
        raise RuntimeError("not even a text")


def unpicklable(document: Any) -> Any:
    raise Unpicklable(1, 2)


def leave(document: Any) -> Any:
    raise SystemExit(3)


def hard_exit(document: Any) -> Any:
    os._exit(7)


def not_a_number(document: Any) -> Any:
    return {"x": float("nan")}


def not_json(document: Any) -> Any:
    return {"x": object()}


def eat_memory(document: Any) -> Any:
    return len([bytes(2**24) for _ in range(10**6)])


def recurse(document: Any) -> Any:
    return recurse(document)


def leave_nothing(document: Any) -> Any:
    """What comes after it in the same process has no memory left, or no processor time."""
    if document == "memory":
        resource.setrlimit(resource.RLIMIT_AS, (2**20, resource.getrlimit(resource.RLIMIT_AS)[1]))
    else:
        threading.Timer(0.1, os.kill, (os.getpid(), signal.SIGXCPU)).start()


def large(document: Any) -> Any:
    time.sleep(document["late"])
    return "x" * document["size"]


def end_by_signal(document: Any) -> Any:
    os.kill(os.getpid(), document)


def kill_self_once(document: Any) -> Any:
    """Killed from outside the first time, fine the second; the marker file is the memory between the two."""
    marker = Path(document["marker"])
    marker.write_text(marker.read_text() + "x" if marker.exists() else "x")
    if len(marker.read_text()) < document["times"] + 1:
        os.kill(os.getpid(), signal.SIGKILL)
    return {"runs": len(marker.read_text())}


def kill_self_while_replying(document: Any) -> Any:
    """Killed in the middle of the reply the first time, when the length has been sent and a part of the content."""
    marker = Path(document["marker"])
    if not marker.exists():
        marker.touch()
        gc.unfreeze()  # what a worker is born with is set aside
        pipe = next(one for one in gc.get_objects() if isinstance(one, Connection))
        os.write(pipe.fileno(), struct.pack("!i", 1000) + b'+"half of')
        os.kill(os.getpid(), signal.SIGKILL)
    return "whole"


def birth(document: Any) -> Any:
    """What the worker was born with."""

    def threads(pid: int | str) -> int:
        return len(list(Path(f"/proc/{pid}/task").iterdir()))

    libraries = {"sympy", "numba", "symengine", "numpy"}
    return {
        "threads_of_parent": threads(os.getppid()),
        "threads": threads("self"),
        "loaded": sorted(libraries & sys.modules.keys()),
    }


def compile_family(document: Any) -> Any:
    """A moment for each family."""
    time.sleep(0.05)
    return document


def compile_but_newmark(document: Any) -> Any:
    return {} if document["family"] != "newmark" else 1 / 0
