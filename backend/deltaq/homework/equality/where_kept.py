"""Expressions that count where constraints are kept; without constraints, identically in all symbols."""

from __future__ import annotations

from typing import cast

from ..sampling import Sampler
from ..solution import Solution
from . import Equality, Fingerprint, Match, Parts, expression, kept_by_constraints


def fingerprint(parts: Parts, sampler: Sampler) -> Fingerprint | None:
    """The values at states that keep the constraints, or at all points."""
    return _equality(sampler.solution).fingerprint(parts, sampler)


def same(given: Parts, right: Parts, solution: Solution) -> Match:
    """Whether both are equal wherever the constraints are kept, or identically."""
    return _equality(solution).same(given, right, solution)


def _equality(solution: Solution) -> Equality:
    return cast("Equality", kept_by_constraints if solution.conditions else expression)
