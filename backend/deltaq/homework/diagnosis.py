"""Which mistake leads to exactly this answer: the term that is wrong, and the cause where it can be told.

A slip is a change of one term that makes the answer right; a misconception is a road that leads to this answer. A
misconception is named only where both say the same: its road changes the terms that the slip is in. One whose trace in
a single term anything else could have left (a factor 2 in an equation) is named only where the task asks for the very
thing, or where more than one term bears it out.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from .equality import Fingerprint, Parts
from .reading import Reading
from .sampling import Values, close
from .slips import Slip, slip_search
from .task import Task
from .workbook import Candidate, Workbook

MOST_NAMED = 4


@dataclass(frozen=True)
class Diagnosis:
    """The misconceptions that explain an answer, the likeliest first; what they are about; the terms that are wrong."""

    misconceptions: tuple[str, ...] = ()
    about: tuple[str, ...] = ()
    slips: tuple[Slip, ...] = ()


def diagnose(workbook: Workbook, task: Task, reading: Reading, text: str) -> Diagnosis:
    """The mistake that leads to exactly this answer, as far as it can be told."""
    direct = list(_direct(workbook, task, reading.parts))
    slips = slip_search(workbook, task).slips(reading, text, explained=bool(direct))
    found = [c for c in direct if _agrees(workbook, task, c, reading.parts, slips)]
    if not found and all(slip.kind == "factor" for slip in slips):
        # Nobody writes 2/3 by a slip of the pen: a road that leads here says more.
        found = [c for c in direct if _agrees(workbook, task, c, reading.parts, ())]
        slips = () if found else slips
    named = found[:MOST_NAMED]
    return Diagnosis(tuple(c.solution.id for c in named), tuple(c.solution.about for c in named), slips)


def _direct(workbook: Workbook, task: Task, given: Parts) -> Iterator[Candidate]:
    """The candidates that lead to this answer, each misconception once."""
    own = task.quantity.equality.fingerprint(given, workbook.sampler)
    seen: set[str] = set()
    for candidate in workbook.candidates(task) if own else ():
        new = candidate.solution.id not in seen and _alike(own, candidate.fingerprint)
        if new and task.quantity.equality.same(given, candidate.parts, candidate.solution).equal:
            seen.add(candidate.solution.id)
            yield candidate


def _alike(own: Fingerprint | None, other: Fingerprint) -> bool:
    return own is not None and len(own) == len(other) and close(own, other)


def _agrees(workbook: Workbook, task: Task, candidate: Candidate, given: Parts, slips: tuple[Slip, ...]) -> bool:
    """Whether the way to the answer of a misconception leads through the terms in which the slips are."""
    if not slips:
        return True
    evident, traces = candidate.solution.evident, candidate.solution.traces
    if evident is not None and task.quantity.kind not in evident:
        return False
    if traces is not None and not {slip.kind for slip in slips} <= traces:
        return False
    if task.quantity.form not in ("equation", "equations"):
        return True
    return all(_compared_alike(workbook, slip, given, candidate.parts) for slip in slips if slip.scale)


def _compared_alike(workbook: Workbook, slip: Slip, given: Parts, faulty: Parts) -> bool:
    """Whether the equation is as many times the misconception's as it is the right one, but for the slip."""
    scales = (_scale(workbook.sampler.rows(given[slip.part]), workbook.sampler.rows(part)) for part in faulty)
    return any(scale is not None and close(scale, slip.scale) for scale in scales)


def _scale(own: tuple[Values, ...], other: tuple[Values, ...]) -> Values | None:
    """The factor of one equation over another at every point; None where it is none."""
    factors = []
    for a, b in zip(own, other, strict=True):
        column = max(range(len(b)), key=lambda k: abs(b[k]))
        factor = a[column] / b[column] if b[column] else math.nan
        if not close(a, [factor * entry for entry in b]):
            return None
        factors.append(factor)
    return tuple(factors)
