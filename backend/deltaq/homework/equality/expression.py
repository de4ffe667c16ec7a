"""Expressions and vectors: equal in every component, identically in all symbols."""

from __future__ import annotations

from ...language.canonical import is_zero
from ..sampling import Sampler, defined
from ..solution import Solution
from . import Fingerprint, Match, Parts, weakest


def fingerprint(parts: Parts, sampler: Sampler) -> Fingerprint | None:
    """The values of all components at all points."""
    values = tuple(value for part in parts for value in sampler.values(part))
    return values if defined(values) else None


def same(given: Parts, right: Parts, solution: Solution) -> Match:
    """Whether every component of given − right vanishes identically."""
    if len(given) != len(right):
        return Match(equal=False)
    pairs = zip(given, right, strict=True)
    return Match(weakest([is_zero(a - b, solution.symbols) for a, b in pairs]))
