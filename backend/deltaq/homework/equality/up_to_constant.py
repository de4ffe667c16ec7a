"""Potentials: equal up to what does not depend on the coordinates, which no force can tell."""

from __future__ import annotations

from ...language.canonical import is_zero
from ..sampling import Sampler, defined
from ..solution import Solution
from . import Fingerprint, Match, Parts, weakest


def fingerprint(parts: Parts, sampler: Sampler) -> Fingerprint | None:
    """The values less the one at the first point."""
    (part,) = parts
    first, *others = values = sampler.values(part)
    return tuple(value - first for value in others) if defined(values) else None


def same(given: Parts, right: Parts, solution: Solution) -> Match:
    """Whether given − right depends on no coordinate and no rate: its derivatives vanish identically."""
    (own,), (true,) = given, right
    difference = own - true
    moving = difference.free_symbols - {solution.q(p.name) for p in solution.scene.parameters} - {solution.t}
    equal = weakest([is_zero(difference.diff(symbol), solution.symbols) for symbol in moving])
    if not equal or is_zero(difference, solution.symbols):
        return Match(equal)
    return Match(equal, "function-of-time" if difference.has(solution.t) else "constant")
