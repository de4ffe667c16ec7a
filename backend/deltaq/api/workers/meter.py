"""The processor time of another process."""

from __future__ import annotations

import ctypes
import time
from collections.abc import Callable

Clock = Callable[[], float]


def processor_clock(pid: int) -> Clock:
    """Shows the seconds of processor time that a process and all its threads have used; OSError when it is gone.

    It is a clock of POSIX (clock_getcpuclockid), which costs 5 µs and is exact to the nanosecond. Where there is none,
    as on macOS, the clock on the wall stands for it: a process of one thread has used no more.
    """
    library, number = ctypes.CDLL(None), ctypes.c_int()
    if not hasattr(library, "clock_getcpuclockid") or library.clock_getcpuclockid(pid, ctypes.byref(number)):
        return time.monotonic
    return lambda: time.clock_gettime(number.value)


class Meter:
    """What a process has used since it was last asked for something."""

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        self._begin = self._used = 0.0
        self._looked = time.monotonic()

    def start(self) -> None:
        """Count from here."""
        self._begin = self._read()

    @property
    def seconds(self) -> float:
        """Processor time since the start. Of a process that is gone nobody knows how it spent the time since the last
        look, so all of it counts.
        """
        return self._read() - self._begin

    def _read(self) -> float:
        before, self._looked = self._looked, time.monotonic()
        try:
            self._used = self._clock()
        except OSError:
            self._used += self._looked - before
        return self._used
