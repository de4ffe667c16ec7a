"""Equations of motion: equal if they are invertible combinations of one another, with factors that never vanish.

Rows (a₁ … a_f, b) of Σ aᵢ q̈ᵢ + b = 0 span the same space at every state. Sides, signs, factors such as m l and the
solved form make no difference; 0 = 0 and a factor that can be zero do, except what all terms of the right equation
have in common (`division`).
"""

from __future__ import annotations

import sympy as sp

from ...language.canonical import is_zero
from ..sampling import Sampler, defined, echelon
from ..solution import Solution
from . import Fingerprint, Match, Parts, weakest
from .division import Division


def fingerprint(parts: Parts, sampler: Sampler) -> Fingerprint | None:
    """The reduced row echelon form of (A, b) at every point, which all invertible combinations share."""
    rows = [sampler.rows(part) for part in parts]
    if not all(defined(row) for each in rows for row in each):
        return None
    reduced = [echelon([each[point] for each in rows]) for point in range(len(sampler.points))]
    if any(len(each) < len(parts) or not any(each[-1][:-1]) for each in reduced):
        return ()  # dependent rows, or one without any acceleration
    return tuple(entry for each in reduced for row in each for entry in row)


def same(given: Parts, right: Parts, solution: Solution) -> Match:
    """Whether A q̈ + b = 0 is an invertible combination of the right equations: X A₀ = A, X b₀ = b with det X ≠ 0.

    The remark tells that det X can vanish, or that something was divided out; undecided where no regular block of A₀ is
    found, or whether that of A is regular.
    """
    if len(given) != len(right):
        return Match(equal=False)
    matrix, rest = system_of(right, solution)
    own, own_rest = system_of(given, solution)
    if own.free_symbols & {solution.acceleration(q) for q in solution.free}:
        return Match(equal=False)
    columns = _pivots(matrix, solution)
    if columns is None:
        return Match(equal=None)
    square, given_square = matrix[:, columns], own[:, columns]
    determinant, factor = square.det(method="berkowitz"), given_square.det(method="berkowitz")
    singular = is_zero(factor, solution.symbols)
    if singular is not False:
        return Match(equal=False if singular else None)
    # own = X · right with X = given_square · square⁻¹: cleared of the determinant, so that nothing is divided.
    combined = given_square * square.adjugate()
    whole, own_whole = matrix.row_join(rest), own.row_join(own_rest)
    equal = weakest([is_zero(entry, solution.symbols) for entry in determinant * own_whole - combined * whole])
    return _divided(Division(given_square, square, whole, solution)) if equal else Match(equal)


def _divided(division: Division) -> Match:
    divisors = division.divided()
    if divisors is None:
        return Match(equal=False, remark="factor-vanishes")
    return Match(equal=True, remark="divided" if divisors else "", nonzero=divisors)


def system_of(parts: Parts, solution: Solution) -> tuple[sp.Matrix, sp.Matrix]:
    """The matrix A and the column b of residuals A q̈ + b."""
    accelerations = [solution.acceleration(q) for q in solution.free]
    still = dict.fromkeys(accelerations, solution.zero)
    matrix = sp.Matrix([[part.diff(a) for a in accelerations] for part in parts])
    return matrix, sp.Matrix([part.xreplace(still) for part in parts])


def _pivots(matrix: sp.Matrix, solution: Solution) -> list[int] | None:
    """Columns whose square block is regular; all of them for the complete set of equations."""
    rows, columns = matrix.shape
    if rows == columns:
        return list(range(columns))
    if rows == 1:
        return next(([k] for k in range(columns) if is_zero(matrix[0, k], solution.symbols) is False), None)
    return None
