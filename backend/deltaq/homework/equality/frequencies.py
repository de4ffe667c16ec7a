"""Eigenfrequencies: the same set of numbers ω > 0, as expressions or as numbers at the scene's values."""

from __future__ import annotations

import sympy as sp

from ...language.canonical import display, is_zero
from ..sampling import Sampler, defined
from ..solution import Solution
from . import Fingerprint, Match, Parts, weakest

ROUNDING = 1e-9
ROUNDED = 5e-3  # how far a number may be off that was written with three digits


def fingerprint(parts: Parts, sampler: Sampler) -> Fingerprint | None:
    """The values at the sampling parameters, in order of size."""
    values = tuple(sorted(sampler.values(part)[0] for part in parts))
    return values if defined(values) and values[0] > ROUNDING else None


def same(given: Parts, right: Parts, solution: Solution) -> Match:
    """Whether the ω, in order of size, agree as numbers, and their squares identically if they are expressions."""
    if len(given) != len(right):
        return Match(equal=False)
    given = tuple(_simple(part, solution) for part in given)
    ordered = [sorted(parts, key=lambda part: number_of(part, solution)) for parts in (given, right)]
    numeric = [_near(a, b, solution) for a, b in zip(*ordered, strict=True)]
    if not all(numeric):
        return Match(equal=False)
    if not any(part.free_symbols for part in given):
        return Match(equal=True, remark="rounded")
    return Match(weakest([is_zero(a**2 - b**2, solution.symbols) for a, b in zip(*ordered, strict=True)]))


def number_of(part: sp.Expr, solution: Solution) -> float:
    """The value at the scene's parameters; NaN if it is not real, or depends on where the system is."""
    value = sp.N(_simple(part, solution).xreplace(dict(solution.parameter_values)))
    return float(value) if value.is_Float or value.is_Rational else float("nan")


def _simple(part: sp.Expr, solution: Solution) -> sp.Expr:
    """The part with sin² + cos² and the like of coordinates done away with."""
    moving = {solution.q(q) for q in solution.coordinates}
    return display(part, solution.symbols) if part.free_symbols & moving else part


def _near(given: sp.Expr, right: sp.Expr, solution: Solution) -> bool:
    a, b = number_of(given, solution), number_of(right, solution)
    return a > 0 and abs(a - b) <= ROUNDED * b
