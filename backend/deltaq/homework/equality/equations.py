"""Equations of motion: equal if they are invertible combinations of one another, with factors that never vanish.

Rows (a₁ … a_f, b) of Σ aᵢ q̈ᵢ + b = 0 span the same space at every state. Sides, signs, factors such as m l and the
solved form make no difference; 0 = 0 and a factor that can be zero do.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import product

import sympy as sp

from ...derivation.compiled import compiled
from ...language.canonical import is_zero
from ..sampling import Sampler, defined, echelon
from ..solution import Solution
from . import Fingerprint, Match, Parts, weakest

NEARLY_A_TURN = 0.9 * 2 * math.pi
SPECIAL = (0.0, math.pi / 2, math.pi, -math.pi / 2, -0.7, 0.9)
MOST_STATES = 400
NOTHING = 1e-12


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

    The remark tells where det X can vanish; undecided where no regular block of A₀ is found, or whether that
    of A is regular.
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
    if equal and _vanishes(factor, determinant, solution):
        return Match(equal=False, remark="factor-vanishes")
    return Match(equal)


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


def _vanishes(above: sp.Expr, below: sp.Expr, solution: Solution) -> bool:
    """Whether above/below is zero or undefined somewhere, by the states where such things happen.

    0/0 tells nothing, nor does a state at which the right equation is undefined.
    """
    positive = {solution.q(p.name): 1.3 + 0.1 * k for k, p in enumerate(solution.scene.parameters) if p.positive}
    slots = {symbol: index for index, symbol in enumerate(above.free_symbols | below.free_symbols)}
    functions = [compiled(part, slots) for part in (above, below)]
    choices = [(positive[symbol],) if symbol in positive else _special(symbol, solution) for symbol in slots]
    pairs = [[function(state) for function in functions] for state in _states(choices)]
    # What is undefined above is told of: NaN is not ≤ anything.
    telling = [(a, b) for a, b in pairs if not math.isnan(b) and not max(abs(a), abs(b)) <= NOTHING]
    ratios = [a / b if abs(b) > NOTHING else math.inf for a, b in telling]
    regular = all(NOTHING <= abs(ratio) <= 1 / NOTHING for ratio in ratios)
    return not regular or len({ratio > 0 for ratio in ratios}) > 1


def _states(choices: Sequence[Sequence[float]]) -> Iterator[Sequence[float]]:
    """Every symbol at its special values: all combinations of few, each by itself of many."""
    if math.prod(map(len, choices)) <= MOST_STATES:
        yield from product(*choices)
        return
    for index, values in enumerate(choices):
        for value in values:
            yield [value if k == index else own[-1] for k, own in enumerate(choices)]


def _special(symbol: sp.Symbol, solution: Solution) -> Sequence[float]:
    """The values at which factors tend to vanish; of a coordinate only those in its range, where it makes sense."""
    found = next((c for c in solution.scene.coordinates if c.name == symbol.name), None)
    if found is None or found.min is None or found.max is None:
        return SPECIAL
    if found.unit == "rad" and found.max - found.min > NEARLY_A_TURN:
        return SPECIAL  # a slider that ends short of ±π bounds where a motion starts, not where it goes
    inside = [value for value in SPECIAL if found.min <= value <= found.max]
    width = found.max - found.min
    return [*inside, found.min + 0.3 * width, found.min + 0.8 * width]
