"""Numbers for formulas about functions.

A point holds each function's value, rate and acceleration at the time t. They determine a parabola, which is the test
function: `along_motion` gives its value at any other time. So a point is a jet of test functions, for the directions
δx as well, and an integral over the time is Gauss quadrature along them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import sympy as sp
from flint import arb

from .formula import (
    AtTime,
    Boundary,
    Called,
    Directional,
    Each,
    Formula,
    FunctionFormula,
    LimitOfQuotient,
    MassIntegral,
    Ratio,
    Summed,
)
from .points import STEP, Point, along_motion, moved
from .quadrature import integral

FEW = 3  # nodes for a body of which only the linearity of the integral is used: sums have it, however few the terms
Numbers = tuple[arb, ...]
Evaluate = Callable[[Formula, Point], Numbers]
Number = Callable[[sp.Expr, Point], arb]


def evaluate_functions(  # noqa: PLR0911 - one case for each kind
    formula: FunctionFormula, point: Point, evaluate: Evaluate, number: Number
) -> Numbers:
    """The components of the formula at the point; no formula is differentiated symbolically."""
    match formula:
        case Called(_, of):
            return evaluate(of, point)
        case Directional(of, along):
            ahead, behind = (evaluate(of, _moved(point, along, h, number)) for h in (STEP, -STEP))
            return _quotient(ahead, behind, 2 * STEP)
        case LimitOfQuotient(of, along):
            return _quotient(evaluate(of, _moved(point, along, STEP, number)), evaluate(of, point), STEP)
        case AtTime(of, time):
            return evaluate(of, _at(point, number(time, point)))
        case Boundary(of, lower, upper):
            end, start = (evaluate(of, _at(point, number(time, point))) for time in (upper, lower))
            return _quotient(end, start, arb(1))
        case MassIntegral(of, _, _, bounds, weight):
            return integral(
                lambda at: tuple(number(weight, at) * v for v in evaluate(of, at)), (bounds,), point, number, FEW
            )
        case Ratio(numerator, denominator):
            return (evaluate(numerator, point)[0] / evaluate(denominator, point)[0],)
        case Summed(_, terms):
            values = [evaluate(term, point) for term in terms]
            return tuple(sum(parts, arb(0)) for parts in zip(*values, strict=True))
        case Each(_, instances):
            return tuple(part for instance in instances for part in evaluate(instance, point))
    raise TypeError(f"no value for {type(formula).__name__}")


def _quotient(first: Numbers, second: Numbers, by: arb) -> Numbers:
    return tuple((a - b) / by for a, b in zip(first, second, strict=True))


def _moved(point: Point, along: Mapping[sp.Symbol, sp.Expr], h: arb, number: Number) -> Point:
    """x + h v; symbols that only writing knows, such as a vector as a whole, have no value to be moved."""
    return moved(point, {s.name: point[s.name] + h * number(v, point) for s, v in along.items() if s.name in point})


def _at(point: Point, time: arb) -> Point:
    """The test functions at another time."""
    return along_motion(point, time - point["t"])
