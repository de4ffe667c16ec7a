"""Numerical kernels are compiled where the service first runs; simulations wait for them instead of compiling, too."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any

from ..simulation.kernels.marks import declared, is_marked
from ..simulation.library import ENSEMBLES, get_method, kernel_groups
from ..vocabulary import AUTO
from .workers.job import Job, JobError, Preparing
from .workers.kernels import are_compiled
from .workers.pool import Pool

LOGGER = logging.getLogger("deltaq.api")
WARM = Job("deltaq.api.jobs:warm", deadline=300.0, pace="slow")
WARM_LABORATORY = Job("deltaq.api.jobs:warm_laboratory", deadline=300.0, threads=8, pace="slow")
LATE = "the numerical kernels are still being compiled"
PAUSE = 1.0  # seconds between two looks at what is compiled
USUAL = "dop853"  # what `auto` takes nearly always
Tell = Callable[[int, int], object]  # how many kernels there are, and how many there will be


@dataclass(frozen=True)
class Kernels:
    """The kernels of each group, a family of methods or the lanes of ensembles: compiled by the jobs named.

    They are waited for `timeout` seconds at most, by who is not told how many there are.
    """

    warm: Job = WARM
    warm_laboratory: Job = WARM_LABORATORY
    timeout: float = 120.0
    _compiled: dict[str, asyncio.Event] = field(default_factory=dict)  # of what is being compiled
    _left: list[str] = field(default_factory=list)  # what nobody has begun to compile
    _wanted: set[str] = field(default_factory=set)  # what somebody waits for

    async def compile(self, pool: Pool, laboratory: Pool, workers: int) -> None:
        """Compile what is not compiled yet, each family in a worker of its own; so many at a time may be taken.

        What somebody waits for comes first.
        """
        if are_compiled():  # then every worker is born with them
            return
        self._compiled.update({family: asyncio.Event() for family in kernel_groups()})
        self._left.extend(kernel_groups())
        if all(await asyncio.gather(*(self._compile(pool) for _ in range(workers)))):
            await _ran(laboratory, self.warm_laboratory, {})

    async def _compile(self, pool: Pool) -> bool:
        """One after the other, until none is left; whether all worked.

        Jobs go on in either case: they compile for themselves what is missing.
        """
        worked = True
        while self._left:
            family = next((each for each in self._left if each in self._wanted), self._left[0])
            self._left.remove(family)
            try:
                worked &= await _ran(pool, self.warm, {"family": family})
            finally:
                self._compiled[family].set()
        return worked

    def is_compiling(self, method: str) -> bool:
        """Whether the kernels of a method are being compiled. Raises UnknownNameError for one that does not exist."""
        under_way = self._compiled.get(_group_of(method))
        return under_way is not None and not under_way.is_set()

    async def more(self, method: str, known: int) -> int:
        """How many kernels there are, as soon as that is more than was known, or all of a method are there.

        Raises Preparing if that takes too long.
        """
        self._wanted.add(_group_of(method))
        try:
            async with asyncio.timeout(self.timeout):
                while (here := await asyncio.to_thread(_count)) <= known and self.is_compiling(method):  # noqa: ASYNC110  no event tells of files
                    await asyncio.sleep(PAUSE)
        except TimeoutError:
            raise Preparing(LATE) from None
        return here

    async def wait(self, *methods: str, tell: Tell | None = None) -> None:
        """Until the kernels of these methods (or ensembles) are there, all if none is named.

        Where they are not there yet, `tell` hears at once and every second how many of all kernels are, for as long as
        they are being compiled: the deadlines of those jobs are the end of it. Raises Preparing if nobody is told and
        that takes too long, UnknownNameError for a method that does not exist.
        """
        wanted = {_group_of(method) for method in methods}
        self._wanted.update(wanted)
        try:
            async with asyncio.timeout(self.timeout if tell is None else None):
                for family in wanted or kernel_groups():
                    if family in self._compiled:
                        await _come(self._compiled[family], tell)
        except TimeoutError:
            raise Preparing(LATE) from None


async def _come(compiled: asyncio.Event, tell: Tell | None) -> None:
    if tell is None:
        await compiled.wait()
        return
    while not compiled.is_set():
        tell(await asyncio.to_thread(_count), await asyncio.to_thread(lambda: len(list(declared()))))
        with suppress(TimeoutError):
            async with asyncio.timeout(PAUSE):
                await compiled.wait()


def _count() -> int:
    """The number of kernels that there is machine code of."""
    return sum(map(is_marked, declared()))


def _group_of(method: str) -> str:
    return ENSEMBLES if method == ENSEMBLES else get_method(USUAL if method == AUTO else method).family


async def _ran(pool: Pool, job: Job, document: dict[str, Any]) -> bool:
    """Whether a job came to its end."""
    try:
        await pool.run(job, document)
    except JobError as error:
        LOGGER.warning("could not compile kernels %s: %s", document, error)
        return False
    return True
