"""Bounds that the operating system keeps for a worker, whatever the worker does."""

from __future__ import annotations

import ctypes
import math
import os
import resource
import signal
import sys
import time
from contextlib import suppress
from pathlib import Path

_PR_SET_PDEATHSIG = 1


def die_with_parent() -> None:
    """Linux kills this process when its parent ends, even in the middle of a C call.

    The parent of a worker is the fork server, whose parent is the web process (see also keep_only). Elsewhere an idle
    worker sees its pipe close, and a busy one has its bound on processor time.
    """
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)


def keep_only(*descriptors: int) -> None:
    """Close all files but the standard streams and those named.

    A child of the fork server inherits the write end of the pipe by whose closing the fork server notices that the
    web process has ended; with it open, an orphan would keep its own parent alive.
    """
    first = 3
    for last in (*sorted(descriptors), os.sysconf("SC_OPEN_MAX")):
        os.closerange(first, last)
        first = last + 1


def die_first() -> None:
    """When the memory of a machine or container is exhausted, Linux kills a worker, not the service (proc(5))."""
    with suppress(OSError):
        Path("/proc/self/oom_score_adj").write_text("1000", encoding="ascii")


def step_back(niceness: int) -> None:
    """Lowers the priority of this process by `niceness`, 19 at most (nice(2)), so that the service answers first."""
    os.nice(niceness)


def bound_memory(size: int) -> None:
    """Bounds the address space in bytes; beyond, allocations raise MemoryError. Call it after the large imports."""
    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (size if hard == resource.RLIM_INFINITY else min(size, hard), hard))


def bound_processor_time(seconds: float) -> None:
    """Bounds the processor time from now on, in seconds; beyond, the kernel ends the process.

    That holds also when the supervisor is gone.
    """
    _, hard = resource.getrlimit(resource.RLIMIT_CPU)
    allowed = math.ceil(time.process_time() + seconds) + 1
    resource.setrlimit(resource.RLIMIT_CPU, (allowed if hard == resource.RLIM_INFINITY else min(allowed, hard), hard))
