"""Conserved quantities: equal up to a constant factor other than zero and an added constant."""

from __future__ import annotations

import sympy as sp

from ...language.canonical import is_zero
from ..sampling import Sampler, defined
from ..solution import Solution
from . import Fingerprint, Match, Parts, weakest


def fingerprint(parts: Parts, sampler: Sampler) -> Fingerprint | None:
    """Differences between the points, divided by the first; () for what is constant."""
    (part,) = parts
    values = sampler.values(part)
    if not defined(values):
        return None
    start, *others = values
    first, *rest = (value - start for value in others)
    return () if abs(first) <= 1e-9 * max(map(abs, values)) else tuple(step / first for step in rest)


def same(given: Parts, right: Parts, solution: Solution) -> Match:
    """Whether given = c · right + d with c, d depending on parameters alone, c ≠ 0: decided by derivatives."""
    (own,), (true,) = given, right
    factor = _factor(own, true, solution)
    if factor is None:
        return Match(equal=False)
    difference = own - factor * true
    equal = weakest([is_zero(difference.diff(symbol), solution.symbols) for symbol in _moving(difference, solution)])
    return Match(equal, "multiple" if equal and not is_zero(own - true, solution.symbols) else "")


def _moving(value: sp.Basic, solution: Solution) -> list[sp.Symbol]:
    return sorted(value.free_symbols - {solution.q(p.name) for p in solution.scene.parameters}, key=str)


def _factor(given: sp.Expr, right: sp.Expr, solution: Solution) -> sp.Expr | None:
    """given = factor · right + constant: the ratio of slopes at one state, an expression in the parameters."""
    for symbol in _moving(right, solution):
        state = {s: sp.Rational(7 + k, 11) for k, s in enumerate(_moving(sp.Tuple(given, right), solution))}
        above, below = (value.diff(symbol).xreplace(state) for value in (given, right))
        if is_zero(below, solution.symbols) is False:
            return None if is_zero(above, solution.symbols) is not False else above / below
    return None
