"""Numbers for formulas: what each evaluates to at a point, in ball arithmetic, without symbolic differentiation."""

from __future__ import annotations

import math
from collections.abc import Callable

import sympy as sp
from flint import arb, arb_mat

from .formula import (
    AtEquilibrium,
    Determinant,
    Dot,
    Equation,
    Explicit,
    Formula,
    FunctionFormula,
    Gateaux,
    Given,
    Inserted,
    Integral,
    Jacobian,
    MatrixTimes,
    Named,
    Partial,
    Plus,
    Power,
    Rate,
    Rounded,
    Shifted,
    Stack,
    Substituted,
    Times,
    Value,
)
from .function_evaluation import evaluate_functions
from .points import STEP, Point, along_motion, moved, pair, shifted, varied
from .program import number
from .quadrature import integral
from .tree_evaluation import tree_value

Numbers = tuple[arb, ...]  # one for a scalar, several for a vector or, row by row, a matrix
Evaluate = Callable[[Formula], Numbers]


def evaluate(formula: Formula, point: Point) -> Numbers:  # noqa: PLR0912 - one case for each kind
    """The formula's components at the point. Not finite where it is not defined there."""

    def at(other: Point) -> Evaluate:
        return lambda part: evaluate(part, other)

    match formula:
        case Given(trees):
            return tuple(tree_value(tree, point) for tree in trees)
        case Explicit() | Named() | Rounded():
            return tuple(number(part, point) for part in formula.parts)
        case Partial(of, by):
            return difference(at, of, pair(point, by.name, lambda h: shifted(point, {by.name: h})))
        case Rate(of):
            return difference(at, of, pair(point, Rate, lambda h: along_motion(point, h)))
        case Gateaux(of):
            return difference(at, of, pair(point, Gateaux, lambda h: varied(point, h)))
        case Shifted(value, h):
            return difference(at, Explicit(value), pair(point, (h.name, 0), lambda size: moved(point, {h.name: size})))
        case Times(factors):
            return _product([evaluate(factor, point) for factor in factors])
        case Dot(left, right):
            pairs = zip(evaluate(left, point), evaluate(right, point), strict=True)
            return (sum((a * b for a, b in pairs), arb(0)),)
        case Plus(terms):
            return _sum([tuple(term.sign * part for part in evaluate(term.formula, point)) for term in terms])
        case Integral(of, material):
            return integral(lambda inside: evaluate(of, inside), material, point, number)
        case FunctionFormula():
            return evaluate_functions(formula, point, evaluate, number)
        case Equation(left, right):
            return _sum([evaluate(left, point), tuple(-part for part in evaluate(right, point))])
        case Substituted(of, values) | AtEquilibrium(of, values) | Inserted(of, values):
            return evaluate(of, moved(point, {symbol.name: number(value, point) for symbol, value in values.items()}))
        case Stack() | MatrixTimes() | Jacobian() | Determinant() | Power():
            return _of_matrix(formula, point)


def _of_matrix(formula: Stack | MatrixTimes | Jacobian | Determinant | Power, point: Point) -> Numbers:
    """Vectors and matrices, row by row."""
    match formula:
        case Stack(rows):
            return tuple(part for row in rows for part in evaluate(row, point))
        case MatrixTimes(matrix, vector):
            return matrix_times(evaluate(matrix, point), evaluate(vector, point))
        case Jacobian(of, by):
            columns = [evaluate(Partial(of, q), point) for q in by]
            return tuple(part for row in zip(*columns, strict=True) for part in row)
        case Determinant(of):
            return (determinant(evaluate(of, point)),)
        case Power(of, exponent):
            return tuple(part**exponent for part in evaluate(of, point))


def components(value: Value, point: Point) -> Numbers:
    """The numbers of a vector or an expression."""
    parts = value.flat() if isinstance(value, sp.MatrixBase) else [value]
    return tuple(number(part, point) for part in parts)


def difference(at: Callable[[Point], Evaluate], of: Formula, beside: tuple[Point, ...]) -> Numbers:
    """The derivative of a formula along a curve of points, as a central difference."""
    ahead, behind = (at(point)(of) for point in beside)
    return tuple((a - b) / (2 * STEP) for a, b in zip(ahead, behind, strict=True))


def matrix_times(matrix: Numbers, vector: Numbers) -> Numbers:
    """The product of a matrix, given row by row, and a vector."""
    size = len(vector)
    rows = (matrix[start : start + size] for start in range(0, len(matrix), size))
    return tuple(sum((a * b for a, b in zip(row, vector, strict=True)), arb(0)) for row in rows)


def determinant(matrix: Numbers) -> arb:
    """The determinant of a square matrix, given row by row."""
    size = math.isqrt(len(matrix))
    return arb_mat(size, size, list(matrix)).det()


def _product(factors: list[Numbers]) -> Numbers:
    """Scalars times at most one vector."""
    vector = next((factor for factor in factors if len(factor) > 1), (arb(1),))
    scalar = math.prod((factor[0] for factor in factors if len(factor) == 1), start=arb(1))
    return tuple(scalar * part for part in vector)


def _sum(terms: list[Numbers]) -> Numbers:
    return tuple(sum(parts, arb(0)) for parts in zip(*terms, strict=True))
