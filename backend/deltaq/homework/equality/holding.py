"""Conditions: one that holds wherever the constraints are kept says the same as they do, however it is written."""

from __future__ import annotations

from ..sampling import Sampler, defined
from ..solution import Solution
from . import Fingerprint, Match, Parts, kept_by_constraints

NOTHING = 1e-9


def fingerprint(parts: Parts, sampler: Sampler) -> Fingerprint | None:
    """The values at states that keep the constraints, zero where they are none but for rounding."""
    values = kept_by_constraints.fingerprint(parts, sampler)
    return None if values is None else tuple(0.0 if abs(value) < NOTHING else value for value in values)


def same(given: Parts, right: Parts, solution: Solution) -> Match:
    """Whether both hold at all of these states: seen there, not proved."""
    found = [fingerprint(parts, Sampler(solution)) for parts in (given, right)]
    if not all(each is not None and defined(each) for each in found):
        return Match(equal=None)
    return Match(None if not any(value for each in found for value in each or ()) else False)
