"""Numerical kernels are compiled where the service first runs; simulations wait for them instead of compiling, too."""

from __future__ import annotations

import asyncio
import logging
from dataclasses import dataclass, field
from typing import Any

from ..simulation.library import ENSEMBLES, get_method, kernel_groups
from ..vocabulary import AUTO
from .workers.job import Job, JobError, Overloaded
from .workers.kernels import are_compiled
from .workers.pool import Pool

LOGGER = logging.getLogger("deltaq.api")
WARM = Job("deltaq.api.jobs:warm", deadline=300.0, pace="slow")
WARM_LABORATORY = Job("deltaq.api.jobs:warm_laboratory", deadline=300.0, threads=8, pace="slow")
USUAL = "dop853"  # what `auto` takes nearly always


@dataclass(frozen=True)
class Kernels:
    """The kernels of each group, a family of methods or the lanes of ensembles: compiled by the jobs named.

    They are waited for `timeout` seconds at most.
    """

    warm: Job = WARM
    warm_laboratory: Job = WARM_LABORATORY
    timeout: float = 120.0
    _compiled: dict[str, asyncio.Event] = field(default_factory=dict)  # of what is being compiled

    async def compile(self, pool: Pool, laboratory: Pool, workers: int) -> None:
        """Compile what is not compiled yet, each family in a worker of its own; so many at a time may be taken."""
        if are_compiled():  # then every worker is born with them
            return
        self._compiled.update({family: asyncio.Event() for family in kernel_groups()})
        taken = asyncio.Semaphore(workers)
        jobs = [self._compile(family, pool, taken) for family in kernel_groups()]
        if all(await asyncio.gather(*jobs)):
            await _ran(laboratory, self.warm_laboratory, {})

    async def _compile(self, family: str, pool: Pool, taken: asyncio.Semaphore) -> bool:
        """Whether it worked. Jobs go on in either case: they compile for themselves what is missing."""
        try:
            async with taken:
                return await _ran(pool, self.warm, {"family": family})
        finally:
            self._compiled[family].set()

    def is_compiling(self, method: str) -> bool:
        """Whether the kernels of a method are being compiled. Raises UnknownNameError for one that does not exist."""
        under_way = self._compiled.get(_group_of(method))
        return under_way is not None and not under_way.is_set()

    async def wait(self, *methods: str) -> None:
        """Until the kernels of these methods (or ensembles) are there, all if none is named.

        Raises Overloaded if that takes too long, UnknownNameError for a method that does not exist.
        """
        wanted = {_group_of(method) for method in methods}
        try:
            async with asyncio.timeout(self.timeout):
                for family in wanted or kernel_groups():
                    if family in self._compiled:
                        await self._compiled[family].wait()
        except TimeoutError:
            raise Overloaded("the numerical kernels are still being compiled") from None


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
