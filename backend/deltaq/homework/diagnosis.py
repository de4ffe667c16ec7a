"""Which mistake leads to exactly this answer: found by numbers among the wrong answers, then confirmed exactly."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import islice

import sympy as sp

from .equality import Fingerprint, Parts
from .sampling import close
from .slips import SlippedParts, Slips
from .solution import Solution
from .task import Task
from .workbook import Candidate, Workbook

MOST_NAMED = 4


@dataclass(frozen=True)
class Diagnosis:
    """The misconceptions that explain an answer, the likeliest first; what they are about; a slip besides."""

    misconceptions: tuple[str, ...] = ()
    about: tuple[str, ...] = ()
    slip: SlippedParts | None = None


def diagnose(workbook: Workbook, task: Task, given: Parts) -> Diagnosis:
    """The mistake that leads to exactly this answer: a misconception, else one slip, else both."""
    found = list(islice(_direct(workbook, task, given), MOST_NAMED))
    if found:
        return Diagnosis(tuple(c.solution.id for c in found), tuple(c.solution.about for c in found))
    slips = Slips(workbook.sampler, task.quantity.form, up_to_constant=task.quantity.up_to_constant)
    right = _slip(slips, given, workbook.right(task), task, workbook.solution)
    if right is not None:
        return Diagnosis(slip=right)
    for candidate in workbook.candidates(task) if any(part != 0 for part in given) else ():
        besides = _slip(slips, given, candidate.parts, task, candidate.solution)
        if besides is not None:
            return Diagnosis((candidate.solution.id,), (candidate.solution.about,), besides)
    return Diagnosis()


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


def _slip(slips: Slips, given: Parts, base: Parts, task: Task, solution: Solution) -> SlippedParts | None:
    for slipped in slips.between(given, base):
        if task.quantity.equality.same(given, slipped.parts, solution).equal:
            return slipped
    return None


def own_term(slipped: SlippedParts) -> SlippedParts:
    """The slip with the term as the student wrote it, so that the right term is not revealed."""
    factor = {"sign": -1, "half": sp.Rational(1, 2), "double": 2}.get(slipped.kind, 1)
    return replace(slipped, term=factor * slipped.term)
