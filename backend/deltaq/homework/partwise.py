"""Which parts of an answer are right by themselves: components of a vector, equations of a set, frequencies.

The verdict on the whole is exact; what is told of the parts is decided by numbers at the sampling points.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

import sympy as sp

from ..vocabulary import PartOutcome
from .equality import Parts, frequencies
from .equality.frequencies import ROUNDED, number_of
from .sampling import close, defined, echelon
from .task import Task
from .workbook import Workbook


def part_outcomes(workbook: Workbook, task: Task, given: Parts) -> tuple[PartOutcome, ...]:
    """One outcome for each part; nothing where an answer has a single part."""
    decide = DECIDED.get(task.quantity.form)
    return () if decide is None or len(given) < 2 else decide(workbook, task, given)


def part_share(workbook: Workbook, task: Task, given: Parts) -> float:
    """The share of a wrong answer that is right: of components other than zero, equations, frequencies."""
    share = SHARES.get(task.quantity.form)
    return 0.0 if share is None else share(workbook, task, given)


def _share_of_components(workbook: Workbook, task: Task, given: Parts) -> float:
    """What is zero is no work and earns nothing; what should be and is not takes one away."""
    right = workbook.right(task)
    if len(given) != len(right):
        return 0.0
    asked = [k for k, true in enumerate(right) if any(workbook.sampler.values(true))]
    outcomes = _components(workbook, task, given)
    found = sum(outcomes[k] == "correct" for k in asked)
    wrong = sum(told != "correct" for k, told in enumerate(outcomes) if k not in asked)
    return max(0, found - wrong) / max(1, len(asked))


def _share_of_equations(workbook: Workbook, task: Task, given: Parts) -> float:
    """How many independent equations of the set there are among those given; what is too many takes one away."""
    right = workbook.right(task)
    outcomes = _equations(workbook, task, given)
    rows = [workbook.sampler.rows(part)[0] for part, told in zip(given, outcomes, strict=True) if told == "correct"]
    wrong = max(0, len(given) - len(right))
    return max(0.0, (len(echelon(rows)) - wrong) / len(right))


def _share_of_frequencies(workbook: Workbook, task: Task, given: Parts) -> float:
    """How many of the frequencies are among those given, each once."""
    right = workbook.right(task)
    outcomes = _frequencies(workbook, task, given)
    numbers = [number_of(part, workbook.solution) for part in given]
    found = {round(n, 6) for n, told in zip(numbers, outcomes, strict=True) if told == "correct"}
    return min(len(found), len(right)) / max(len(right), len(given))


def _components(workbook: Workbook, task: Task, given: Parts) -> tuple[PartOutcome, ...]:
    pairs = zip(given, workbook.right(task), strict=True)
    return tuple(_equal(*map(workbook.sampler.values, pair)) for pair in pairs)


def _equal(own: tuple[float, ...], right: tuple[float, ...]) -> PartOutcome:
    if not defined(own) or not defined(right):
        return "undecided"
    return "correct" if close(own, right) else "wrong"


def _equations(workbook: Workbook, task: Task, given: Parts) -> tuple[PartOutcome, ...]:
    """An equation belongs to the set if it adds no rank to it."""
    right = [workbook.sampler.rows(part) for part in workbook.right(task)]
    return tuple(_implied(workbook, part, right) for part in given)


def _implied(workbook: Workbook, part: sp.Expr, right: list[tuple[tuple[float, ...], ...]]) -> PartOutcome:
    rows = workbook.sampler.rows(part)
    if not all(map(defined, rows)):
        return "wrong"  # not linear in the accelerations
    if not any(any(row[:-1]) for row in rows):
        return "wrong"  # no acceleration in it
    ranks = (len(echelon([*(each[n] for each in right), row])) for n, row in enumerate(rows))
    return "correct" if all(rank == len(right) for rank in ranks) else "wrong"


def _frequencies(workbook: Workbook, task: Task, given: Parts) -> tuple[PartOutcome, ...]:
    """A number counts at the scene's values; a formula at others as well: √g/ℓ is not √(g/ℓ), though ℓ be 1 m."""
    right = workbook.right(task)
    return tuple(
        "correct" if any(_same_frequency(workbook, part, true) for true in right) else "wrong" for part in given
    )


def _same_frequency(workbook: Workbook, own: sp.Expr, right: sp.Expr) -> bool:
    """By numbers, and exactly where the right one is not real at the sampling point."""
    a, b = (number_of(part, workbook.solution) for part in (own, right))
    if not abs(a - b) <= ROUNDED * abs(b):
        return False
    if not own.free_symbols:
        return True
    mine, theirs = (workbook.sampler.values(part) for part in (own, right))
    if not defined(theirs):
        return frequencies.same((own,), (right,), workbook.solution).equal is True
    return defined(mine) and close(mine, theirs)


DECIDED: Mapping[str, Callable[[Workbook, Task, Parts], tuple[PartOutcome, ...]]] = MappingProxyType(
    {"vector": _components, "equations": _equations, "set": _frequencies}
)

SHARES: Mapping[str, Callable[[Workbook, Task, Parts], float]] = MappingProxyType(
    {"vector": _share_of_components, "equations": _share_of_equations, "set": _share_of_frequencies}
)
