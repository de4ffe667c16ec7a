"""Answers that a judge of their own decides on: the same expressions say the same, and no number tells more."""

from __future__ import annotations

from ...language.canonical import is_zero
from ..sampling import Sampler
from ..solution import Solution
from . import Fingerprint, Match, Parts, weakest


def fingerprint(_parts: Parts, _sampler: Sampler) -> Fingerprint | None:
    """None: wrong answers to these questions are not found by numbers."""
    return None


def same(given: Parts, right: Parts, solution: Solution) -> Match:
    """Whether two answers are the same, expression by expression."""
    if len(given) != len(right):
        return Match(equal=False)
    return Match(weakest([is_zero(a - b, solution.symbols) for a, b in zip(given, right, strict=True)]))
