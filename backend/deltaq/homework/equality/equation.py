"""One equation of motion: as equations, or solved for its own acceleration with all others eliminated."""

from __future__ import annotations

from ...language.canonical import is_zero
from ..solution import Solution
from . import Match, Parts, equations, weakest
from .equations import fingerprint

__all__ = ["fingerprint", "same", "same_solved"]


def same(given: Parts, right: Parts, solution: Solution) -> Match:
    """Whether it is the equation up to a factor."""
    return equations.same(given, right, solution)


def same_solved(given: Parts, solution: Solution) -> Match:
    """Whether the equation follows from the whole set: with q̈ = −M⁻¹b put in, nothing is left."""
    matrix, rest = equations.system_of(tuple(solution.equation(q) for q in solution.free), solution)
    row, own = equations.system_of(given, solution)
    determinant = matrix.det(method="berkowitz")
    left = own[0, 0] * determinant - (row * matrix.adjugate() * rest)[0, 0]
    equal = weakest([is_zero(left, solution.symbols)])
    return Match(equal, "solved" if equal else "")
