"""Parts of an ensemble as they are done, by threads of this machine or on a cluster, and all of them together."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from concurrent.futures import Executor, Future, ThreadPoolExecutor, as_completed
from dataclasses import dataclass
from functools import partial
from typing import TypeAlias

import numpy as np

from .ensemble import BLOCK, Ensemble, EnsembleMotion, largest_step, prepare, run_some
from .ensemble_section import Points, Section, points_of
from .ensemble_section import prepare as prepare_sections
from .integration import Flag

OF_CLUSTER = 1024  # motions that are worked out together on a cluster
Found: TypeAlias = tuple[EnsembleMotion, tuple[Points, ...]]
COLUMNS = ("values", "rates", "errors", "worst", "steps", "blind")


@dataclass(frozen=True)
class Part:
    """What came of the motions from the number `first` on."""

    first: int
    motion: EnsembleMotion
    points: tuple[Points, ...] = ()  # in a section, if that is asked for

    def __len__(self) -> int:
        return len(self.motion.outcomes)


def in_parts(
    ensemble: Ensemble, tolerance: float, cluster: Executor | None = None, section: Section | None = None
) -> Iterator[Part]:
    """All motions to a tolerance of their coordinates, some at a time, in the order in which they are done.

    They come with their points in a section, if there is one. Each motion is that of `run_ensemble`. Where a part
    fails, the others come before its error is raised. Large ensembles are worked out on the `cluster` if there is one.
    What is under way ends with the iterator.
    """
    largest, count, flag = largest_step(ensemble), len(ensemble), np.zeros(1, dtype=np.int64)
    run = partial(_run, tolerance=tolerance, largest=largest, section=section)
    if cluster is not None and count > OF_CLUSTER:
        yield from _done(cluster, run, _divided(ensemble, OF_CLUSTER))
        return
    if largest > 0.0:
        prepare(ensemble.problem)  # threads that compile the same at once would all wait as long
    if section is not None:
        prepare_sections(ensemble.problem)
    size, threads = (BLOCK, os.cpu_count() or 1) if largest > 0.0 else (1, 1)  # each by itself may take seconds
    with ThreadPoolExecutor(min(threads, -(-count // size))) as pool:
        try:
            yield from _done(pool, partial(run, flag=flag), _divided(ensemble, size))
        finally:
            flag[0] = 1


def _run(
    ensemble: Ensemble, tolerance: float, largest: float, section: Section | None, flag: Flag | None = None
) -> Found:
    flag = np.zeros(1, dtype=np.int64) if flag is None else flag
    motion = run_some(ensemble, tolerance, largest, flag)
    return motion, () if section is None else points_of(ensemble, section, largest, flag)


def _divided(ensemble: Ensemble, size: int) -> Iterator[tuple[int, Ensemble]]:
    """So many motions each, with the number of the first."""
    count = len(ensemble)
    for first in range(0, count, size):
        yield first, ensemble.chosen(np.arange(first, min(first + size, count)))


def _done(executor: Executor, run: partial[Found], divided: Iterator[tuple[int, Ensemble]]) -> Iterator[Part]:
    """What came of parts, as they are done; then the first error, if any failed."""
    firsts: dict[Future[Found], int] = {executor.submit(run, some): first for first, some in divided}
    error: BaseException | None = None
    try:
        for each in as_completed(list(firsts)):
            first = firsts.pop(each)  # what is told is kept no longer
            if (failed := each.exception()) is None:
                yield Part(first, *each.result())
            error = error or failed
    finally:
        for left in firsts:
            left.cancel()
    if error is not None:
        raise error


def joined(parts: Iterable[Part]) -> Part:
    """All of them in their order."""
    in_order = sorted(parts, key=lambda part: part.first)
    found = [part.motion for part in in_order]
    arrays = {name: np.concatenate([getattr(each, name) for each in found]) for name in COLUMNS}
    outcomes = tuple(one for each in found for one in each.outcomes)
    motion = EnsembleMotion(found[0].times, outcomes=outcomes, **arrays)
    return Part(in_order[0].first, motion, tuple(one for part in in_order for one in part.points))
